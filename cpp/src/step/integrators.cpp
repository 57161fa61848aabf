// SPDX-License-Identifier: Apache-2.0
#include "carom/step/integrators.hpp"

#include <algorithm>
#include <string>

#include "carom/numerics/invalid_input.hpp"

namespace carom {

Integrator integrator_named(std::string_view name) {
  const auto found = std::find(METHODS.begin(), METHODS.end(), name);
  if (found != METHODS.end()) return static_cast<Integrator>(found - METHODS.begin());
  std::string all;
  for (const std::string_view method : METHODS) all.append(all.empty() ? "" : ", ").append(method);
  throw InvalidInput("integrator", name, "must be one of " + all, "symmetric_top is the default");
}

int order_of(Integrator method) {
  switch (method) {
    case Integrator::lecture_gram_schmidt:
    case Integrator::lecture_polar:
    case Integrator::lecture_exponential:
    case Integrator::lecture_quaternion:
    case Integrator::lecture_quaternion_sqrt:
      return 1;
    case Integrator::midpoint:
    case Integrator::implicit_midpoint:
    case Integrator::cayley:
    case Integrator::symmetric_top:
      return 2;
    case Integrator::symmetric_top_4:
      return 4;
    case Integrator::taylor:
    case Integrator::exact:
      return 0;
  }
  return 0;
}

}  // namespace carom
