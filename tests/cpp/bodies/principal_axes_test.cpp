// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/principal_axes.hpp"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "bodies/near.hpp"

namespace carom {
namespace {

constexpr double u = tolerance::unit_roundoff;

Eigen::Matrix3d diagonal(double a, double b, double c) {
  return Eigen::Vector3d(a, b, c).asDiagonal();
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& I, const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d R = q.toRotationMatrix();
  const Eigen::Matrix3d T = R * I * R.transpose();
  return 0.5 * (T + T.transpose());
}

class HardTensor : public testing::TestWithParam<Eigen::Vector3d> {};

TEST_P(HardTensor, IsRebuiltFromItsAxesInAnyFrame) {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
            .normalized();
    const Eigen::Matrix3d I = turned(GetParam().asDiagonal(), q);
    const PrincipalAxes p = principal_axes(I);
    const Eigen::Matrix3d Q = p.rotation();
    const double largest = GetParam().maxCoeff();
    // about 15 plane rotations of 4 u each, the way to a quaternion and back 8 u, the products 8 u
    EXPECT_TRUE(near(Q * p.moments.asDiagonal() * Q.transpose(), I, 80 * u * largest));
    // the quaternion's length is off by 2 u, so R R^T by 8 u; entries and product 4 u each, twice
    EXPECT_TRUE(near(Q * Q.transpose(), Eigen::Matrix3d::Identity(), 24 * u));
    EXPECT_NEAR(Q.determinant(), 1, 24 * u);  // a reflection would give -1
    EXPECT_LE(p.moments[0], p.moments[1]);
    EXPECT_LE(p.moments[1], p.moments[2]);
    EXPECT_GE(p.moments[0], 0);
    Eigen::Vector3d sorted = GetParam();
    std::sort(sorted.begin(), sorted.end());
    EXPECT_TRUE(near(p.moments, sorted, 80 * u * largest));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, HardTensor,
                         testing::Values(Eigen::Vector3d(3, 2, 1), Eigen::Vector3d(1, 1, 1),
                                         Eigen::Vector3d(1, 1, 2), Eigen::Vector3d(1, 1, 1e-12),
                                         Eigen::Vector3d(1, 1 + 1e-15, 1 - 1e-15),
                                         Eigen::Vector3d(0, 5, 5), Eigen::Vector3d(0, 0, 0),
                                         Eigen::Vector3d(1e-300, 2e-300, 2e-300),
                                         Eigen::Vector3d(1e300, 1e300, 1e300)));

TEST(PrincipalAxes, OfADiagonalTensorKeepEveryBit) {
  const PrincipalAxes p = principal_axes(diagonal(0.3, 1e-17, 0.1));
  EXPECT_EQ(p.moments, Eigen::Vector3d(1e-17, 0.1, 0.3));
  const PrincipalAxes cube = principal_axes(diagonal(0.1, 0.1, 0.1));
  EXPECT_EQ(cube.rotation(), Eigen::Matrix3d::Identity());
}

TEST(Rank, IsThreeForASolidTwoForARodNoneForAPoint) {
  EXPECT_EQ(inertia_rank(diagonal(1, 2, 2.5)), 3);
  EXPECT_EQ(inertia_rank(diagonal(1, 1, 0)), 2);
  EXPECT_EQ(inertia_rank(Eigen::Matrix3d::Zero()), 0);
  EXPECT_EQ(inertia_rank(diagonal(1, 1, 1e-12)), 3);  // thin, but it resists
}

TEST(Rank, OfARodSurvivesTurningItsFrame) {
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Matrix3d I = diagonal(1, 1, 0);
    for (int k = 0; k < 3; ++k)  // three changes of frame, as a compound of compounds makes them
      I = turned(I,
                 Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
                     .normalized());
    worst = std::max(worst, principal_axes(I).moments[0]);
    ASSERT_EQ(inertia_rank(I), 2);
  }
  // Ten times less would miss rods: their rounding reaches this far.
  EXPECT_GT(worst, tolerance::inertia_rank / 20);
  // Ten times more would take away a moment that is there.
  EXPECT_EQ(inertia_rank(diagonal(1, 1, 3 * tolerance::inertia_rank)), 3);
}

TEST(Inverse, IsTheMoorePenroseInverse) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized();
  for (const Eigen::Matrix3d& D : {diagonal(1, 2, 2.5), diagonal(2, 2, 0), diagonal(0, 0, 0)}) {
    const Eigen::Matrix3d I = turned(D, q);
    const Eigen::Matrix3d J = inverse_inertia(I);
    // Penrose's four conditions; condition number 2.5, some 40 roundings
    EXPECT_TRUE(near(I * J * I, I, 100 * u));
    EXPECT_TRUE(near(J * I * J, J, 100 * u));
    EXPECT_TRUE(near((I * J).transpose(), I * J, 100 * u));
    EXPECT_TRUE(near((J * I).transpose(), J * I, 100 * u));
  }
}

TEST(Rod, HasNoInverseAboutItsAxis) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 2) / 3;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity() - axis * axis.transpose();
  EXPECT_TRUE(near(inverse_inertia(I) * axis, Eigen::Vector3d::Zero(), 20 * u));
  EXPECT_TRUE(inverse_inertia(I).allFinite());
}

TEST(ImpossibleTensor, IsRefusedJustBeyondAFlatPlate) {
  EXPECT_NO_THROW((void)physical_inertia(diagonal(1, 2, 3), "inertia"));  // a flat plate
  EXPECT_NO_THROW((void)physical_inertia(diagonal(1, 2, 3 * (1 + 0.2e-12)), "inertia"));
  EXPECT_THROW((void)physical_inertia(diagonal(1, 2, 3 * (1 + 5e-12)), "inertia"), InvalidInput);
  EXPECT_THROW((void)physical_inertia(diagonal(1, 1, 5), "inertia"), InvalidInput);
  EXPECT_THROW((void)physical_inertia(diagonal(0, 0, 1), "inertia"), InvalidInput);
  EXPECT_THROW((void)physical_inertia(diagonal(-1, 2, 2), "inertia"), InvalidInput);
  EXPECT_NO_THROW((void)physical_inertia(diagonal(0, 1, 1), "inertia"));  // a rod
}

TEST(ImpossibleTensor, IsNeverAPlateInATurnedFrame) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine))
            .normalized();
    EXPECT_NO_THROW((void)physical_inertia(turned(diagonal(1, 2, 3), q), "inertia"));
    EXPECT_THROW((void)physical_inertia(turned(diagonal(1, 2, 3 + 3e-11), q), "inertia"),
                 InvalidInput);
  }
}

TEST(ImpossibleTensor, MustBeSymmetricAndFinite) {
  Eigen::Matrix3d I = diagonal(2, 2, 2);
  I(0, 1) = 1e-10;  // the 9 digits of a text file
  EXPECT_EQ(physical_inertia(I, "inertia")(1, 0), 0.5e-10);
  I(0, 1) = 1e-6;
  EXPECT_THROW((void)physical_inertia(I, "inertia"), InvalidInput);
  I(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)physical_inertia(I, "inertia"), InvalidInput);
}

}  // namespace
}  // namespace carom
