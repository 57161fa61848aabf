// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/interior_normal.hpp"

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

using namespace carom;
using Eigen::Vector3d;

namespace {

/// Cube of 1 m: exact distance.
SdfGrid cube() {
  const auto distance = [](const Vector3d& p) {
    const Vector3d q = p.cwiseAbs() - Vector3d::Constant(0.5);
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  };
  return SdfGrid::from_function(distance, {Vector3d::Constant(-0.5), Vector3d::Constant(0.5)},
                                0.02);
}

}  // namespace

TEST(InteriorNormal, TakesTheFaceTheParticleCameThroughAtACorner) {
  const SdfGrid grid = cube();
  // Down through the top, 0.1 from the side wall, 0.15 deep: the side is nearer than the top. Five
  // cells from the edge, where the grid no longer feels it.
  const Vector3d from(0.4, 0.013, 0.6), to(0.4, 0.013, 0.35);
  Vector3d plain;
  (void)grid.sample(to, plain);
  EXPECT_GT(plain.normalized().x(), 0.99);  // the plain gradient: sideways, along no motion
  NormalCounts counts;
  const InteriorNormal n = interior_normal(grid, from, to, counts);
  EXPECT_EQ(n.source, NormalSource::swept_hit);
  EXPECT_NEAR(n.normal.z(), 1, 1e-6);
  EXPECT_NEAR(n.depth, 0.15, 1e-6);
  EXPECT_EQ(counts.swept_hit, 1);
  EXPECT_EQ(counts.gradient, 0);
}

TEST(InteriorNormal, TakesTheGradientWhereItLeadsBack) {
  NormalCounts counts;
  const auto n = interior_normal(cube(), {0.1, 0.07, 0.6}, {0.1, 0.07, 0.45}, counts);
  EXPECT_EQ(n.source, NormalSource::gradient);
  EXPECT_NEAR(n.normal.z(), 1, 1e-9);
  EXPECT_NEAR(n.depth, 0.05, 1e-9);
}

TEST(InteriorNormal, TurnsBackWhatWasInsideAllAlong) {
  NormalCounts counts;
  const auto n = interior_normal(cube(), {0.3, 0, 0}, {-0.1, 0, 0}, counts, {.gradient = false});
  EXPECT_EQ(n.source, NormalSource::velocity);
  EXPECT_EQ(n.normal, Vector3d::UnitX());
  EXPECT_EQ(counts.velocity, 1);
  EXPECT_THROW((void)interior_normal(cube(), {0, 0, 0}, {0, 0, 0}, counts), InvalidInput);
}

TEST(Repulsion, BoundedNeverLeavesFasterThanItsCap) {
  // 10 cm deep at 1/60 s asks for 6 m/s: unbounded it is added in full, energy and all.
  EXPECT_DOUBLE_EQ(repulsion_speed(0.1, 0.0, 1.0 / 60, false, 1.0), 6.0);
  EXPECT_DOUBLE_EQ(repulsion_speed(0.1, 0.0, 1.0 / 60, true, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(repulsion_speed(0.1, 0.75, 1.0 / 60, true, 1.0), 0.25);
  EXPECT_DOUBLE_EQ(repulsion_speed(0.1, 7.0, 1.0 / 60, true, 1.0), 0.0);
}
