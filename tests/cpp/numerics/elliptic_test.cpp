// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/elliptic.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {
constexpr double u = tolerance::unit_roundoff;

TEST(Elliptic, CarlsonsOwnCheckValues) {
  // B. C. Carlson 1995, section 3; 14 digits are printed there.
  EXPECT_NEAR(carlson_rf(1, 2, 0), 1.3110287771461, 1e-13);
  EXPECT_NEAR(carlson_rf(2, 3, 4), 0.58408284167715, 1e-14);
  EXPECT_NEAR(carlson_rf(0.5, 1, 0), 1.8540746773014, 1e-13);
  EXPECT_NEAR(carlson_rj(0, 1, 2, 3), 0.77688623778582, 1e-14);
  EXPECT_NEAR(carlson_rj(2, 3, 4, 5), 0.14297579667157, 1e-14);
}

TEST(Elliptic, JacobiFunctionsInvertTheirIntegral) {
  for (const double m1 : {1.0, 0.9, 0.5, 1e-3, 1e-9, 1e-20, 1e-200}) {
    const double k = quarter_period(m1);
    for (const double share : {-1.7, -0.9, -0.3, 0.0, 1e-9, 0.4, 0.999, 1.0, 1.2, 1.999}) {
      const double at = share * k;
      const Jacobi f = jacobi_any(at, m1);
      EXPECT_NEAR(f.sn * f.sn + f.cn * f.cn, 1, 8 * u);
      EXPECT_NEAR(f.dn * f.dn + (1 - m1) * f.sn * f.sn, 1, 8 * u);
      // K grows like ln(16/m1)/2: its rounding, and that of `at`, is relative
      EXPECT_NEAR(jacobi_argument(f, m1), at, 16 * u * (1 + k)) << m1 << ' ' << share;
    }
  }
}

TEST(Elliptic, LimitsAreTrigonometricAndHyperbolic) {
  const Jacobi circle = jacobi(0.7, 1), line = jacobi(0.7, 0);
  EXPECT_NEAR(circle.sn, std::sin(0.7), 2 * u);
  EXPECT_NEAR(circle.cn, std::cos(0.7), 2 * u);
  EXPECT_NEAR(line.sn, std::tanh(0.7), 2 * u);
  EXPECT_NEAR(line.cn, 1 / std::cosh(0.7), 2 * u);
}

TEST(Elliptic, ThirdKindHasItsClosedForms) {
  const double pi = std::numbers::pi;
  // m = 0: integral of 1 / (1 + nu sin^2) = atan(sqrt(1 + nu) tan u) / sqrt(1 + nu)
  for (const double nu : {0.0, 0.25, 1.0})
    for (const double x : {0.3, 1.2, -0.8})
      EXPECT_NEAR(integral_third(x, 1, nu),
                  std::atan(std::sqrt(1 + nu) * std::tan(x)) / std::sqrt(1 + nu), 8 * u);
  EXPECT_NEAR(integral_third(10 * pi, 1, 1), 10 * pi / std::sqrt(2.0), 10 * pi * 8 * u);
  // m -> 1 continues into the hyperbolic form
  EXPECT_NEAR(integral_third(3, 1e-30, 0.5), integral_third(3, 0, 0.5), 32 * u);
  // nu = 0: the argument itself
  EXPECT_NEAR(integral_third(12.5, 0.3, 0), 12.5, 32 * 12.5 * u);
}

}  // namespace
}  // namespace carom
