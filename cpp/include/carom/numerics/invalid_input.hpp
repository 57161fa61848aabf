// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace carom {

/// Input that cannot be used, refused before anything changes.
///
/// The message names the field, the value with its unit, the rule it breaks and what to do instead,
/// as in "crate.mass: -2 kg, must be > 0; give density instead or set static". ValueError in
/// Python.
class InvalidInput : public std::invalid_argument {
 public:
  InvalidInput(std::string_view field, std::string_view value, std::string_view rule,
               std::string_view remedy = {});

  std::string field, value, rule, remedy;
};

/// Formats a value and its unit for a message: 4 significant digits.
template <class T>
[[nodiscard]] std::string with_unit(const T& value, std::string_view unit) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  if (!unit.empty()) out << ' ' << unit;
  return out.str();
}

/// Refuses NaN and anything that is not > 0. @throws InvalidInput
void require_positive(double value, std::string_view field, std::string_view unit,
                      std::string_view remedy = {});

/// Refuses NaN and anything that is not >= 0. @throws InvalidInput
void require_non_negative(double value, std::string_view field, std::string_view unit,
                          std::string_view remedy = {});

/// Refuses NaN and infinities. @throws InvalidInput
void require_finite(double value, std::string_view field, std::string_view unit = {});

}  // namespace carom
