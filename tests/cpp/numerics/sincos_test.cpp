// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/sincos.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

double worst_error(double x) {
  double s, c;
  sincos_any(x, s, c);
  const auto wide = static_cast<long double>(x);  // 64 bits: 2^-11 of what is judged
  return static_cast<double>(std::max(std::abs(std::sin(wide) - static_cast<long double>(s)),
                                      std::abs(std::cos(wide) - static_cast<long double>(c))));
}

TEST(SinCos, ErrsByLessThanTwoRoundings) {
  std::mt19937_64 random(1);
  double worst = 0;
  for (const double range : {1e-9, 1e-3, 0.8, 7.0, 1e3, sincos_limit}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int i = 0; i < 20000; ++i) worst = std::max(worst, worst_error(uniform(random)));
  }
  EXPECT_LE(worst, 2 * tolerance::unit_roundoff);
}

TEST(SinCos, HoldsAtMultiplesOfAQuarterTurn) {
  for (int k = -1048575; k <= 1048575; k += 1237) {
    const double x = static_cast<double>(k) * 1.5707963267948966;
    EXPECT_LE(worst_error(x), 2 * tolerance::unit_roundoff) << k;
  }
}

TEST(SinCos, EachLaneGivesTheBitsOfALoneDouble) {
  using Pair = double __attribute__((vector_size(16)));
  for (double x = -50; x < 50; x += 0.37) {
    double s, c;
    Pair vs, vc;
    sincos(x, s, c);
    sincos(Pair{x, -2 * x}, vs, vc);
    EXPECT_EQ(vs[0], s);
    EXPECT_EQ(vc[0], c);
  }
}

TEST(SinCos, ZeroAndHugeAndNotANumber) {
  double s, c;
  sincos_any(0, s, c);
  EXPECT_EQ(s, 0);
  EXPECT_EQ(c, 1);
  EXPECT_LE(worst_error(1e15), 2 * tolerance::unit_roundoff);
  sincos_any(std::nan(""), s, c);
  EXPECT_TRUE(std::isnan(s) && std::isnan(c));
}

}  // namespace
}  // namespace carom
