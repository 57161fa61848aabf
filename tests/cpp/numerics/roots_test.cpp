// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/roots.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

class Roots : public testing::TestWithParam<RootMethod> {};

TEST_P(Roots, OfAFactoredCubicAreItsFactors) {
  // (t - 0.25)(t - 0.5)(t - 0.75), dyadic: the coefficients are exact
  const CubicRoots r = cubic_roots({-0.09375, 0.6875, -1.5, 1}, {.method = GetParam()});
  ASSERT_EQ(r.count, 3);
  EXPECT_EQ(r.status, RootStatus::converged);
  // value error 6u (sum of terms 0.8) over the smallest slope 1/16, plus the bracket's half width
  const double allowed = 100 * tolerance::unit_roundoff + tolerance::root_width;
  EXPECT_NEAR(r.root[0], 0.25, allowed);
  EXPECT_NEAR(r.root[1], 0.5, allowed);
  EXPECT_NEAR(r.root[2], 0.75, allowed);
}

TEST_P(Roots, FindADoubleRootOnce) {
  const CubicRoots r = cubic_roots({0.25, -0.75, 0, 1}, {.method = GetParam()});  // (t-.5)^2 (t+1)
  ASSERT_EQ(r.count, 1);
  EXPECT_NEAR(r.root[0], 0.5, 1e-8);  // sqrt(u): all that doubles can say of a double root
  EXPECT_TRUE(std::isnan(r.root[1]));
}

TEST_P(Roots, WithATinyLeadingCoefficientAreThoseOfTheQuadratic) {
  const CubicRoots r = cubic_roots({0.125, -1, 1, 1e-300}, {.method = GetParam()});
  ASSERT_EQ(r.count, 2);
  // value error 6u (1) over the slope 0.7 at the roots, plus the bracket's half width
  const double allowed = 10 * tolerance::unit_roundoff + tolerance::root_width;
  EXPECT_NEAR(r.root[0], (1 - std::sqrt(0.5)) / 2, allowed);
  EXPECT_NEAR(r.root[1], (1 + std::sqrt(0.5)) / 2, allowed);
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, Roots,
                         testing::Values(RootMethod::exact, RootMethod::lecture),
                         [](const auto& row) {
                           return row.param == RootMethod::exact ? "exact" : "lecture";
                         });

TEST(RootSearch, TellsHowItEnded) {
  const std::array<double, 4> c{-0.3, 1, 1, 1};
  RootOptions options{.method = RootMethod::lecture};
  EXPECT_EQ(cubic_roots(c, options).status, RootStatus::converged);
  options.max_iterations = 2;
  EXPECT_EQ(cubic_roots(c, options).status, RootStatus::cap);
  // no double's square is 1/2, and none lies inside so narrow a bracket: x + dx == x
  options = {.method = RootMethod::lecture, .width = 1e-18, .max_iterations = 1000};
  const CubicRoots stagnated = cubic_roots({-0.5, 0, 1, 0}, options);
  EXPECT_EQ(stagnated.status, RootStatus::stagnated);
  EXPECT_LT(stagnated.iterations, 200);
  EXPECT_EQ(cubic_roots({0, 0, 0, 0}).status, RootStatus::zero_polynomial);
}

TEST(RootSearch, RefusesWhatCannotBeSolved) {
  EXPECT_THROW((void)cubic_roots({NAN, 0, 0, 1}), InvalidInput);
  EXPECT_THROW((void)cubic_roots({1, 0, 0, 1}, {.width = 0}), InvalidInput);
  EXPECT_THROW((void)cubic_roots({1, 0, 0, 1}, {.max_iterations = 0}), InvalidInput);
}

}  // namespace
}  // namespace carom
