// SPDX-License-Identifier: Apache-2.0
// A flat floor of many triangles is a half-space to what meets it away from its rim, and no more
// than that: beside the rim it ends.
#include <random>

#include <gtest/gtest.h>

#include "../box_mesh.hpp"
#include "geometry/plain_nodes.hpp"
#include "shapes_for_tests.hpp"

namespace carom::testing {
namespace {

using Eigen::Vector3d;

/// 4 m x 4 m in cells of 0.1 m at z = 0, turned into the slope `pose` by whoever places it; with a
/// box far off, so that it is no convex body.
Mesh floor_of_triangles() {
  constexpr int n = 40;
  TriangleMesh m;
  m.vertices.resize((n + 1) * (n + 1), 3);
  m.faces.resize(2 * n * n, 3);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) m.vertices.row(i * (n + 1) + j) << 0.1 * i - 2, 0.1 * j - 2, 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      m.faces.row(2 * (i * n + j)) << a, b, b + 1;
      m.faces.row(2 * (i * n + j) + 1) << a, b + 1, a + 1;
    }
  return Mesh(joined(m, carom::box_mesh({20, 20, 20}, {21, 21, 21})));
}

double deepest(const std::vector<Manifold>& found, Vector3d& normal) {
  double least = std::numeric_limits<double>::infinity();
  for (const Manifold& m : found)
    for (int k = 0; k < m.count; ++k)
      if (m.points[k].separation < least) least = m.points[k].separation, normal = m.normal;
  return least;
}

TEST(AMeshFloor, IsAPlaneAwayFromItsRim) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> place(-1, 1);
  const Shape mesh = floor_of_triangles(), plane = Plane{};
  const TriangleMesh knot = carom::box_mesh({-0.1, -0.2, -0.15}, {0.1, 0.2, 0.15});
  const std::vector<Shape> bodies = {
      Box{{0.3, 0.4, 0.2}},
      Sphere{0.2},
      Capsule{0.1, 0.3},
      Cylinder{0.15, 0.3},
      Cone{0.2, 0.3},
      Ellipsoid{{0.1, 0.2, 0.3}},
      ConvexHull(knot.vertices),
      Mesh(joined(joined(knot, carom::box_mesh({0.3, -0.1, -0.1}, {0.4, 0.1, 0.1})),
                  carom::box_mesh({-0.4, -0.1, -0.1}, {-0.3, 0.1, 0.1})))};
  for (int i = 0; i < 400; ++i) {
    const Shape& body = bodies[i % bodies.size()];
    Pose at = random_pose(random, 0);
    at.position = {place(random), place(random), 0.3 * std::abs(place(random))};
    const Pose slope = random_pose(random, 3);
    Pose there{slope.orientation * at.position + slope.position,
               slope.orientation * at.orientation};
    std::vector<Manifold> one, two;
    collide(mesh, slope, body, there, 0.02, one);
    collide(plane, slope, body, there, 0.02, two);
    Vector3d n1 = Vector3d::Zero(), n2 = Vector3d::Zero();
    const double by_mesh = deepest(one, n1), by_plane = deepest(two, n2);
    // A sheet holds a body on the side of its centre, a plane always on its own.
    if (at.position.z() < 0.05) continue;
    ASSERT_EQ(std::isfinite(by_mesh), std::isfinite(by_plane)) << i;
    if (!std::isfinite(by_plane)) continue;
    EXPECT_NEAR(by_mesh, by_plane, 1e-12) << i;
    EXPECT_LT((n1 - n2).norm(), 1e-12) << i;
  }
}

TEST(AMeshFloor, EndsAtItsRim) {
  const Shape mesh = floor_of_triangles();
  std::vector<Manifold> out;
  collide(mesh, Pose{}, Shape{Sphere{0.2}}, Pose{.position = {2.15, 0, 0.1}}, 0.02, out);
  Vector3d n;
  // To the rim at x = 2: not straight down.
  EXPECT_NEAR(deepest(out, n), std::hypot(0.15, 0.1) - 0.2, 1e-12);
  EXPECT_NEAR(n.x(), 0.15 / std::hypot(0.15, 0.1), 1e-12);
  out.clear();
  collide(mesh, Pose{}, Shape{Box{{0.2, 0.2, 0.2}}}, Pose{.position = {2.2, 0, 0.05}}, 0.02, out);
  EXPECT_TRUE(out.empty());  // beside it
}

TEST(ALonePlane, HasNoEdgeAndNoBend) {
  const Mesh mesh = floor_of_triangles();
  const MeshSurface& s = *mesh.surface;
  EXPECT_GE(lone_plane(s, {{-1, -1, -0.1}, {1, 1, 0.1}}), 0);
  EXPECT_EQ(lone_plane(s, {{-1, -1, -0.1}, {2.5, 1, 0.1}}), -1);       // the rim
  EXPECT_EQ(lone_plane(s, {{-1, -1, 0.1}, {1, 1, 0.3}}), -1);          // nothing
  EXPECT_EQ(lone_plane(s, {{20.2, 20.2, 19}, {20.4, 20.4, 22}}), -1);  // two faces of the box
}

}  // namespace
}  // namespace carom::testing
