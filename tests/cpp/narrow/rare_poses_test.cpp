// SPDX-License-Identifier: Apache-2.0
// Poses at which a contact was once missing or wildly deep, each with its closed form.
#include <numbers>

#include <gtest/gtest.h>

#include "carom/geometry/mesh_surface.hpp"
#include "carom/narrow/contacts.hpp"

#include "box_mesh.hpp"

namespace carom {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const Quaterniond about_x(AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()));

struct Deepest {
  double separation = std::numeric_limits<double>::infinity();
  Vector3d normal = Vector3d::Zero();
  int points = 0;
};

Deepest deepest(const Shape& a, const Shape& b, const Pose& at) {
  std::vector<Manifold> all;
  collide(a, Pose{}, b, at, 0.02, all);
  Deepest out;
  for (const Manifold& m : all)
    for (int k = 0; k < m.count; ++k, ++out.points)
      if (m.points[k].separation < out.separation)
        out.separation = m.points[k].separation, out.normal = m.normal;
  return out;
}

TEST(ABall, MeetsTheFirstVertexOfAMesh) {
  TriangleMesh roof;
  roof.vertices.resize(5, 3);
  roof.vertices << 0, 0, 0.2, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0;
  roof.faces.resize(4, 3);
  roof.faces << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1;
  const Shape sheet = Mesh(roof);
  for (const double z : {0.3, 0.25, 0.22})
    EXPECT_NEAR(deepest(sheet, Sphere{0.1}, {.position = {0, 0, z}}).separation, z - 0.3, 1e-15);
}

// Along x the distance of their axes less both radii.
TEST(CrossedRods, WithTheirMiddlesInLineAreAsDeepAsTheirRadiiSay) {
  for (const double r : {0.1, 0.01, 0.001})
    for (const double share : {0.9, 0.95, 0.99}) {
      const Shape rod = Cylinder{r, 1};
      const Deepest d = deepest(rod, rod, {{2 * r * share, 0, 0}, about_x});
      EXPECT_NEAR(d.separation, 2 * r * (share - 1), 1e-12) << r << " " << share;
      EXPECT_NEAR(d.normal.x(), 1, 1e-9);
    }
}

TEST(ACone, StandsOnARoundTable) {
  const Shape table = Cylinder{1, 0.03}, cone = Cone{0.05, 0.1};
  // Its centre of mass lies a quarter of its height over its base.
  for (const double x : {0.0, 0.2, 0.4, 0.6}) {
    const Deepest d = deepest(table, cone, {.position = {x, 0, 0.015 + 0.025 - 1e-6}});
    EXPECT_NEAR(d.separation, -1e-6, 1e-12) << x;
    EXPECT_NEAR(d.normal.z(), 1, 1e-9) << x;
  }
}

TEST(Capsules, WhoseCoresCrossAreDeepByTheirRadii) {
  const Shape capsule = Capsule{0.1, 1};
  EXPECT_NEAR(
      deepest(capsule, capsule,
              {{0.2, 0, 0}, Quaterniond(AngleAxisd(std::numbers::pi / 2, Vector3d::UnitY()))})
          .separation,
      -0.2, 1e-12);
  EXPECT_NEAR(deepest(capsule, Sphere{0.1}, {.position = {0, 0, 0.2}}).separation, -0.2, 1e-12);
}

// The face of the hull most along the axis does not hold its lowest corner, 5 cm under the top.
TEST(AHull, MeetsABoxWithItsLowestCorner) {
  TriangleMesh::Vertices v(4, 3);
  v << 0.01, 0.21, -0.12, -0.06, 0.02, -0.07, -0.14, -0.04, 0.07, -0.08, -0.13, 0.1;
  for (const Shape& hull : {Shape(ConvexHull(v)), Shape(Mesh(ConvexHull(v).surface->mesh))})
    EXPECT_NEAR(deepest(Box{{0.2, 0.2, 0.2}}, hull, {.position = {-0.01, -0.21, 0.17}}).separation,
                0.17 - 0.12 - 0.1, 1e-12);
}

// However long the slab: a box on its edge, near the slab's own, just touches it.
TEST(ABoxOnItsEdge, TouchesASlabOfAnyLength) {
  const double turn = std::numbers::pi / 4 + 0.1, h = 0.05 * (std::cos(turn) + std::sin(turn));
  for (const double length : {10.0, 100.0, 1000.0}) {
    const Pose at{{length / 2 - 0.001, 0, 0.5 + h},
                  Quaterniond(AngleAxisd(turn, Vector3d::UnitY()))};
    const Deepest d = deepest(Box{{length, length, 1}}, Box{{0.1, 0.1, 0.1}}, at);
    EXPECT_NEAR(d.separation, 0, 1e-12 * length) << length;
  }
}

// A rod on end, deeper in a rough ground than it is thick. The ground lies from 0 to 1 mm.
TEST(ANeedle, IsHeldByAHeightFieldHoweverDeepItStands) {
  HeightField::Heights heights(5, 5);
  for (int i = 0; i < 25; ++i) heights(i / 5, i % 5) = 1e-3 * (i * 7 % 10) / 10;
  const Shape field = HeightField(heights, 0.1);
  for (const double depth : {0.008, 0.012, 0.1}) {
    const Deepest d = deepest(field, Cylinder{0.01, 1}, {.position = {0.23, 0.22, 0.5 - depth}});
    EXPECT_GT(d.points, 0) << depth;
    EXPECT_LT(d.separation, -depth + 1e-12) << depth;
    EXPECT_GT(d.separation, -depth - 1e-3) << depth;
  }
}

}  // namespace
}  // namespace carom
