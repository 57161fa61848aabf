// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/mass_properties.hpp"

#include <algorithm>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "bodies/near.hpp"

namespace carom {
namespace {

constexpr double u = tolerance::unit_roundoff;
const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();

MassProperties box_at(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  return MassProperties::box(upper - lower, 1.0).transformed(same, 0.5 * (lower + upper));
}

TEST(Union, OfTwoHalvesIsTheWhole) {
  const MassProperties whole = box_at({0, 0, 0}, {4, 2, 1});
  const MassProperties halves = box_at({0, 0, 0}, {1, 2, 1}) + box_at({1, 0, 0}, {4, 2, 1});
  EXPECT_EQ(halves.mass, 8);
  EXPECT_TRUE(near(halves.com, whole.com, 2 * u * 4));
  EXPECT_TRUE(near(halves.inertia, whole.inertia, 8 * u * whole.inertia.norm()));
}

TEST(Union, AddsTheParallelAxisTermThatTheNotesMarkZero) {
  // Two points of 1 and 2 kg, 3 m apart: M1 (X1-X)*^T (X1-X)* of both is mu d^2 = 2/3 * 9 = 6.
  const MassProperties two =
      MassProperties::point({0, 0, 0}, 1) + MassProperties::point({3, 0, 0}, 2);
  EXPECT_TRUE(near(two.inertia, Eigen::Vector3d(0, 6, 6).asDiagonal().toDenseMatrix(), 8 * u * 6));
  EXPECT_EQ(two.com, Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(inertia_rank(two.inertia), 2);
}

TEST(Union, CommutesToTheLastBit) {
  const MassProperties a = MassProperties::cone(0.3, 0.7, 411).transformed(same, {1, 0.1, -3});
  const MassProperties b = MassProperties::capsule(0.1, 2, 7800).transformed(same, {-5, 0.7, 1e3});
  EXPECT_EQ((a + b).mass, (b + a).mass);
  EXPECT_EQ((a + b).com, (b + a).com);
  EXPECT_EQ((a + b).inertia, (b + a).inertia);
}

TEST(Union, OfTenThousandPartsDoesNotDependOnTheirOrder) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> place(-1, 1), size(-3, 0);
  std::vector<MassProperties> parts;
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3d at(place(engine), place(engine), place(engine));
    parts.push_back(MassProperties::sphere(std::pow(10, size(engine)), 1000).transformed(same, at));
  }
  const MassProperties one = MassProperties::combined(parts);
  std::shuffle(parts.begin(), parts.end(), engine);
  const MassProperties other = MassProperties::combined(parts);
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return a.mass > b.mass; });
  const MassProperties largest_first = MassProperties::combined(parts);
  for (const MassProperties& p : {other, largest_first}) {
    // 1e-13 is asked for; double-double sums leave the last rounding, 1 u, or none
    EXPECT_NEAR(p.mass, one.mass, 2 * u * one.mass);
    EXPECT_TRUE(near(p.com, one.com, 2 * u));
    EXPECT_TRUE(near(p.inertia, one.inertia, 4 * u * one.inertia.maxCoeff()));
  }
}

TEST(Union, FarFromTheOriginKeepsItsDigits) {
  // Powers of two: the same parts at the origin and 2^20 m away are exactly alike.
  const Eigen::Vector3d far = Eigen::Vector3d::Constant(0x1p20);
  const MassProperties a = box_at({0, 0, 0}, {1, 2, 1}), b = box_at({1, 0, 0}, {4, 2, 1});
  const MassProperties near_by = a + b;
  const MassProperties away = a.transformed(same, far) + b.transformed(same, far);
  EXPECT_TRUE(near(away.inertia, near_by.inertia, 4 * u * near_by.inertia.norm()));
}

TEST(Union, KeepsALightPartBesideAHeavyOne) {
  // Masses 1 and 1e12 at distance 1: mu = 1 / (1 + 1e-12), in closed form.
  const MassProperties two =
      MassProperties::point({0, 0, 0}, 1e12) + MassProperties::point({0, 0, 1}, 1);
  EXPECT_NEAR(two.inertia(0, 0), 1 / (1 + 1e-12), 4 * u);
}

TEST(Frame, ChangeGoesThereAndBack) {
  const MassProperties body = MassProperties::box({1, 2, 3}, 700).transformed(same, {4, 5, 6});
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.1, 0.7, -0.3, 0.2).normalized().toRotationMatrix();
  const Eigen::Vector3d t(-3, 1, 8);
  const MassProperties back = body.transformed(R, t).transformed(R.transpose(), -R.transpose() * t);
  EXPECT_TRUE(near(back.com, body.com, 16 * u * 10));
  EXPECT_TRUE(near(back.inertia, body.inertia, 40 * u * body.inertia.norm()));
  EXPECT_TRUE(near(body.transformed(R, t).com, R * body.com + t, 0));
}

TEST(Frame, OfInertiaIsNotTheInverseTheNotesPrint) {
  // "I(t) = R I_body^-1 R^T" must read I(t)^-1: a point mass turned by hand tells them apart.
  const MassProperties two =
      MassProperties::point({2, 0, 0}, 1) + MassProperties::point({-2, 0, 0}, 1);
  Eigen::Matrix3d R;  // x to y
  R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const MassProperties by_hand =
      MassProperties::point({0, 2, 0}, 1) + MassProperties::point({0, -2, 0}, 1);
  EXPECT_EQ(two.transformed(R, Eigen::Vector3d::Zero()).inertia, by_hand.inertia);
}

TEST(Frame, RefusesWhatIsNoRotation) {
  const MassProperties ball = MassProperties::sphere(1, 1);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  Eigen::Matrix3d mirror = same;  // R R^T = 1 admits it; det = +1 does not
  mirror(2, 2) = -1;
  EXPECT_THROW((void)ball.transformed(mirror, none), InvalidInput);
  EXPECT_THROW((void)ball.transformed(2 * same, none), InvalidInput);
  EXPECT_THROW((void)ball.transformed(same, {0, 0, std::nan("")}), InvalidInput);
}

TEST(Factory, RefusesSizesThatAreNone) {
  EXPECT_THROW((void)MassProperties::sphere(0, 1), InvalidInput);
  EXPECT_THROW((void)MassProperties::sphere(1, -1), InvalidInput);
  EXPECT_THROW((void)MassProperties::sphere(1e200, 1), InvalidInput);  // mass beyond doubles
  EXPECT_THROW((void)MassProperties::torus(1, 2, 1), InvalidInput);
  EXPECT_THROW((void)MassProperties::tube(2, 1, 1, 1), InvalidInput);
  EXPECT_THROW((void)MassProperties::combined({}), InvalidInput);
  EXPECT_THROW((void)MassProperties::checked(0, {0, 0, 0}, same), InvalidInput);
}

TEST(Factory, OfAThinWallDoesNotCancel) {
  // Wall 2^-30 of the radius: mass 4 pi (1 - t + t^2/3) t to rounding, in closed form.
  const double t = 0x1p-30;
  const MassProperties wall = MassProperties::hollow_sphere(1 - t, 1, 1);
  const double mass = 4 * std::numbers::pi * t * (1 - t + t * t / 3);
  EXPECT_NEAR(wall.mass, mass, 8 * u * mass);
  EXPECT_NEAR(wall.inertia(0, 0), 2.0 / 3 * mass, 2 * t * mass);
}

TEST(Factory, OfAShapeIsThatOfItsKind) {
  EXPECT_EQ(mass_properties(Shape(Box{{1, 2, 3}}), 5).inertia,
            MassProperties::box({1, 2, 3}, 5).inertia);
  EXPECT_THROW((void)mass_properties(Shape(Plane{}), 5), InvalidInput);
}

}  // namespace
}  // namespace carom
