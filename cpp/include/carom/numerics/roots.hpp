// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "carom/numerics/tolerance.hpp"

namespace carom {

/// How a root search ended. The lecture: "stop after a fixed number of iterations", and say so.
enum class RootStatus : std::uint8_t {
  converged,        ///< every bracket is at most RootOptions::width wide, or f is exactly 0
  cap,              ///< the iteration cap came first; the bracket's middle is returned
  stagnated,        ///< the bracket's middle is one of its ends: x + dx == x, no finer double
  zero_polynomial,  ///< all coefficients are 0: every t is a root, none is listed
};

enum class RootMethod : std::uint8_t {
  exact,    ///< the lecture's route with exact signs: the number of roots is never wrong
  lecture,  ///< in plain doubles: signs closer to 0 than rounding count as 0
};

struct RootOptions {
  RootMethod method = RootMethod::exact;
  double width = tolerance::root_width;  ///< of the final bracket, fraction of [0, 1]
  int max_iterations = 64;               ///< per root
};

/// Roots in [0, 1], ascending, a multiple root once; unused entries are NaN.
struct CubicRoots {
  std::array<double, 3> root{std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::quiet_NaN()};
  int count = 0;
  int iterations = 0;  ///< function values spent on brackets, all roots together
  RootStatus status = RootStatus::converged;
};

/// Real roots in [0, 1] of c[0] + c[1] t + c[2] t^2 + c[3] t^3: the derivative's quadratic gives
/// the extrema, end points and extrema give the brackets, secant and bisection the roots.
///
/// With RootMethod::exact the count is exact for the coefficients as given and each root is within
/// `width` (at least 2^-52). With RootMethod::lecture a double root may be missed or doubled.
/// @throws InvalidInput for coefficients that are not finite, width not > 0, max_iterations < 1
/// Source: lecture notes, "Moving triangles equation".
[[nodiscard]] CubicRoots cubic_roots(const std::array<double, 4>& c,
                                     const RootOptions& options = {});

}  // namespace carom
