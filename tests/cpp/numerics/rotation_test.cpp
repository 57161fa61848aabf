// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/rotation.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

class HardRotation : public testing::TestWithParam<Eigen::Vector3d> {};

TEST_P(HardRotation, LogarithmUndoesExponential) {
  const Eigen::Vector3d phi = GetParam();
  const Eigen::Quaterniond q = rotation_exponential(phi);
  // norm, sin, cos, atan2, each a few ulp, and the angle enters twice
  const double allowed = 16 * tolerance::unit_roundoff * (1 + phi.norm());
  EXPECT_NEAR(q.norm(), 1, 4 * tolerance::unit_roundoff);
  EXPECT_LE((rotation_logarithm(q) - phi).norm(), allowed);
  EXPECT_LE((rotation_logarithm(Eigen::Quaterniond(-q.coeffs())) - phi).norm(), allowed);
}

INSTANTIATE_TEST_SUITE_P(NearZeroAndNearPi, HardRotation,
                         testing::Values(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e-300, 0, 0),
                                         Eigen::Vector3d(1e-9, -1e-9, 0),
                                         Eigen::Vector3d(0.3, 0.2, -0.7),
                                         Eigen::Vector3d(0, std::numbers::pi - 1e-9, 0),
                                         Eigen::Vector3d(0, 0, 3.1)));

TEST(Rotation, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a(1, 2, 3), b(-4, 5, 6);
  EXPECT_EQ(skew(a) * b, a.cross(b));  // small integers: exact
}

TEST(Rotation, RefusesAQuaternionThatIsNone) {
  EXPECT_THROW((void)unit_quaternion({0, 0, 0, 0}, "orientation"), InvalidInput);
  EXPECT_THROW((void)unit_quaternion({0, 0, 0, 1.01}, "orientation"), InvalidInput);
  EXPECT_THROW((void)unit_quaternion({0, 0, std::nan(""), 1}, "orientation"), InvalidInput);
  EXPECT_EQ(unit_quaternion({0, 0, 0, 1.0005}, "orientation").w(), 1);
}

}  // namespace
}  // namespace carom
