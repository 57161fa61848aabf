// SPDX-License-Identifier: Apache-2.0
// A curved body over a ridge of a mesh: where it is thinner than the ridge is deep in it, the
// shortest way out is to a side, and that side is not open.
#include <cmath>

#include <gtest/gtest.h>

#include "carom/narrow/contacts.hpp"

#include "../box_mesh.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// A prism along y whose ridge lies on the y axis, both sides falling by 0.2 rad. Alone it is
/// convex and one body; with a box far off it is a surface of faces and edges.
Mesh roof(bool convex) {
  const double x = 2, z = -2 * std::tan(0.2);
  TriangleMesh m;
  m.vertices.resize(6, 3);
  m.vertices << 0, -2, 0, 0, 2, 0, x, -2, z, x, 2, z, -x, -2, z, -x, 2, z;
  m.faces.resize(8, 3);
  m.faces << 0, 2, 3, 0, 3, 1, 1, 5, 4, 1, 4, 0, 0, 4, 2, 1, 3, 5, 2, 4, 5, 2, 5, 3;
  if (!convex) m = joined(m, box_mesh({20, 20, 20}, {21, 21, 21}));
  return Mesh(std::move(m));
}

/// A cone that lies with its side level, `depth` below the ridge, its apex `beyond` the ridge.
Pose lying(const Cone& cone, double depth, double beyond) {
  const double half = std::atan(cone.radius / cone.length);  // between axis and side
  Pose pose;  // the axis from the base to the apex: along x, rising from the level side by `half`
  pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2 + half, Vector3d::UnitY()));
  const Vector3d apex = pose.orientation * Vector3d(0, 0, 0.75 * cone.length);
  pose.position = Vector3d(beyond, 0.1, -depth) - apex;
  return pose;
}

class ARidge : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(OneBodyAndSurface, ARidge, ::testing::Bool());

TEST_P(ARidge, HoldsATipThinnerThanItIsDeep) {
  const Shape roof_shape = roof(GetParam());
  const Cone cone{0.15, 0.34};
  for (const double beyond : {0.01, 0.03, 0.1, 0.2})
    for (const double depth : {-5e-3, 1e-6, 1e-3, 5e-3, 0.02}) {
      std::vector<Manifold> out;
      collide(roof_shape, Pose{}, Shape{cone}, lying(cone, depth, beyond), 0.02, out);
      const ContactPoint* deepest = nullptr;
      Vector3d normal;
      for (const Manifold& m : out)
        for (int k = 0; k < m.count; ++k)
          if (!deepest || m.points[k].separation < deepest->separation)
            deepest = &m.points[k], normal = m.normal;
      ASSERT_NE(deepest, nullptr) << beyond << ' ' << depth;
      // The level side over the ridge: upwards, by the depth.
      EXPECT_NEAR(deepest->separation, -depth, 1e-9) << beyond;
      EXPECT_NEAR(normal.z(), 1, 1e-9) << beyond << ' ' << depth;
      EXPECT_NEAR(deepest->position.x(), 0, 1e-6);
      EXPECT_NEAR(deepest->position.y(), 0.1, 1e-6);
    }
}

TEST_P(ARidge, HoldsACylinderAlongItAtBothEnds) {
  const Shape roof_shape = roof(GetParam());
  const Cylinder cylinder{0.1, 0.5};
  Pose pose{.position = {0, 0.2, 0.099}};
  pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
  std::vector<Manifold> out;
  collide(roof_shape, Pose{}, Shape{cylinder}, pose, 0.02, out);
  ASSERT_EQ(out.size(), 1u);
  ASSERT_EQ(out[0].count, 2);
  double low = 1, high = -1;
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(out[0].points[k].separation, -1e-3, 1e-9);
    low = std::min(low, out[0].points[k].position.y());
    high = std::max(high, out[0].points[k].position.y());
  }
  EXPECT_NEAR(low, -0.05, 1e-9);
  EXPECT_NEAR(high, 0.45, 1e-9);
}

}  // namespace
}  // namespace carom
