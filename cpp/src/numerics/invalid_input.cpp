// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/invalid_input.hpp"

#include <cmath>

namespace carom {
namespace {
std::string sentence(std::string_view field, std::string_view value, std::string_view rule,
                     std::string_view remedy) {
  std::string text(field);
  text.append(": ").append(value).append(", ").append(rule);
  if (!remedy.empty()) text.append("; ").append(remedy);
  return text;
}
}  // namespace

InvalidInput::InvalidInput(std::string_view field_, std::string_view value_, std::string_view rule_,
                           std::string_view remedy_)
    : std::invalid_argument(sentence(field_, value_, rule_, remedy_)),
      field(field_),
      value(value_),
      rule(rule_),
      remedy(remedy_) {}

void require_positive(double value, std::string_view field, std::string_view unit,
                      std::string_view remedy) {
  if (!(value > 0) || !std::isfinite(value))
    throw InvalidInput(field, with_unit(value, unit), "must be finite and > 0", remedy);
}

void require_non_negative(double value, std::string_view field, std::string_view unit,
                          std::string_view remedy) {
  if (!(value >= 0) || !std::isfinite(value))
    throw InvalidInput(field, with_unit(value, unit), "must be finite and >= 0", remedy);
}

void require_finite(double value, std::string_view field, std::string_view unit) {
  if (!std::isfinite(value)) throw InvalidInput(field, with_unit(value, unit), "must be finite");
}

}  // namespace carom
