// SPDX-License-Identifier: Apache-2.0
// Open meshes: sheets of no thickness hold a body on the side its centre lies on, whatever way
// their faces are wound. Closed meshes stay solid.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/sdf.hpp"
#include "carom/narrow/contacts.hpp"
#include "carom/narrow/queries.hpp"
#include "carom/step/simulation.hpp"

#include "narrow/shapes_for_tests.hpp"

using namespace carom;
using namespace carom::testing;
using Eigen::Vector3d;

namespace {

// Coordinates of a metre through two frames, 64 u; a thousand times that.
constexpr double exact = 1e-12;

/// n x n cells in the plane z = 0, 4 m wide; faces look up, or down.
Mesh sheet(int n, bool up) {
  TriangleMesh mesh;
  mesh.vertices.resize((n + 1) * (n + 1), 3);
  mesh.faces.resize(2 * n * n, 3);
  int row = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      mesh.vertices.row(i * (n + 1) + j) << 4.0 * i / n - 2, 4.0 * j / n - 2, 0;
      if (i == n || j == n) continue;
      const int a = i * (n + 1) + j, b = a + n + 1, c = b + 1, d = a + 1;
      mesh.faces.row(row++) << a, b, c;
      mesh.faces.row(row++) << a, c, d;
    }
  if (!up) mesh.faces.col(1).swap(mesh.faces.col(2));
  return Mesh(mesh);
}

struct Body {
  const char* name;
  Shape shape;
  double below;  // m, how far the body reaches down from its origin
};

/// Every kind of moving body.
std::vector<Body> bodies() {
  const auto ball = [](const Vector3d& p) { return p.norm() - 0.3; };
  TriangleMesh::Vertices octahedron(6, 3), beads(3, 3);
  octahedron << 0.3, 0, 0, -0.3, 0, 0, 0, 0.3, 0, 0, -0.3, 0, 0, 0, 0.3, 0, 0, -0.3;
  beads << -0.3, 0, 0, 0, 0.3, 0, 0.3, 0, 0;
  return {
      {"sphere", Sphere{0.3}, 0.3},
      {"box", Box{{0.5, 0.4, 0.6}}, 0.3},
      {"capsule", Capsule{0.2, 0.2}, 0.3},
      {"cylinder", Cylinder{0.2, 0.6}, 0.3},
      {"cone", Cone{0.2, 1.2}, 0.3},
      {"ellipsoid", Ellipsoid{{0.2, 0.4, 0.3}}, 0.3},
      {"hull", ConvexHull(octahedron), 0.3},
      {"mesh_box", Mesh(box_mesh({0.5, 0.4, 0.6}, 2)), 0.3},
      {"sdf",
       Sdf{std::make_shared<const SdfGrid>(SdfGrid::from_function(
           ball, {Vector3d::Constant(-0.3), Vector3d::Constant(0.3)}, 0.03))},
       0.3},
      {"particles", ParticleSet{beads, 0.1}, 0.1},
      {"compound",
       Compound({{Box{{0.2, 0.2, 0.6}}, {}},
                 {Sphere{0.1}, {Vector3d(0.3, 0, 0), Eigen::Quaterniond::Identity()}}}),
       0.3},
  };
}

/// Half a turn about x: what lay on the sheet lies under it.
Pose turned_under(const Pose& pose) {
  const Eigen::Quaterniond half(0, 1, 0, 0);
  return {half * pose.position, half * pose.orientation};
}

}  // namespace

TEST(Sheet, HoldsEveryShapeFromBothSides) {
  for (const int cells : {1, 5})
    for (const bool up : {true, false})
      for (const Body& body : bodies()) {
        const Mesh floor = sheet(cells, up);
        ASSERT_TRUE(floor.surface->back);
        for (const double gap : {-0.02, 0.005}) {
          const Pose over{Vector3d(0.13, 0.07, body.below + gap), Eigen::Quaterniond::Identity()};
          for (const bool under : {false, true}) {
            const auto all =
                contacts(floor, {}, body.shape, under ? turned_under(over) : over, 0.01);
            ASSERT_FALSE(all.empty()) << body.name << (under ? " under" : " over");
            // A distance grid is as right as its error; of a ball on cells of a tenth: 1e-5.
            const double near = std::string_view(body.name) == "sdf" ? 1e-4 : exact;
            EXPECT_NEAR(deepest(all), gap, near) << body.name << (under ? " under" : " over");
            for (const Manifold& m : all)
              EXPECT_NEAR(m.normal.z(), under ? -1 : 1, near) << body.name << " up " << up;
          }
        }
      }
}

TEST(Sheet, IsNotMetBeyondItsRim) {
  const Mesh floor = sheet(2, true);
  const auto at = [](double x, double z) {
    return Pose{Vector3d(x, 0, z), Eigen::Quaterniond::Identity()};
  };
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(contacts(floor, {}, Sphere{0.3}, at(2.31, side * 0.1), 0.0).empty());
    EXPECT_TRUE(contacts(floor, {}, Box{{0.6, 0.6, 0.6}}, at(2.31, side * 0.1), 0.0).empty());
    // A ball over the rim: the rim holds it, along the way from the rim to its centre.
    const auto rim = contacts(floor, {}, Sphere{0.3}, at(2.1, side * 0.2), 0.0);
    ASSERT_EQ(rim.size(), 1u);
    EXPECT_NEAR(deepest(rim), std::hypot(0.1, 0.2) - 0.3, exact);
    EXPECT_NEAR(rim[0].normal.dot(Vector3d(0.1, 0, side * 0.2).normalized()), 1, exact);
  }
}

TEST(Sheet, LetsTheSideChangeOnlyWhereTheCentrePasses) {
  const Mesh floor = sheet(3, true);
  for (double z = 0.29; z > -0.295; z -= 0.01) {
    if (std::abs(z) < 1e-9) continue;
    const Pose pose{Vector3d(0.2, 0.1, z), Eigen::Quaterniond::Identity()};
    for (const Shape& shape : {Shape(Sphere{0.3}), Shape(Box{{0.6, 0.6, 0.6}})}) {
      const auto all = contacts(floor, {}, shape, pose, 0.0);
      ASSERT_FALSE(all.empty()) << z;
      EXPECT_EQ(all[0].normal.z() > 0, z > 0) << z;
      EXPECT_NEAR(deepest(all), std::abs(z) - 0.3, exact) << name_of(shape) << ' ' << z;
    }
  }
}

TEST(Sheet, IsSeenFromTheOtherShapeAlike) {
  const Mesh floor = sheet(3, false);
  for (const Body& body : bodies())
    for (const double z : {0.05, -0.05}) {
      const Pose pose{Vector3d(0.2, 0.1, z), rotation_exponential({0.3, 0.2, 0.1})};
      const auto ab = contacts(floor, {}, body.shape, pose, 0.02),
                 ba = contacts(body.shape, pose, floor, {}, 0.02);
      ASSERT_EQ(ab.empty(), ba.empty()) << body.name;
      if (ab.empty()) continue;
      EXPECT_NEAR(deepest(ab), deepest(ba), exact) << body.name;
    }
}

TEST(Sheet, HasNoInsideForQuestions) {
  const Mesh floor = sheet(2, true);
  const Pose below{Vector3d(0.1, 0.2, -0.5), Eigen::Quaterniond::Identity()};
  EXPECT_NEAR(closest_points(floor, {}, Sphere{0.1}, below, 10).distance, 0.4, exact);
}

TEST(ClosedMesh, StaysSolid) {
  // A slab of 0.2 m: what is inside it leaves by the nearer face, and it has no second side.
  const Mesh slab(box_mesh({2, 2, 0.2}, 2));
  EXPECT_FALSE(slab.surface->back);
  const Mesh block(l_block());
  EXPECT_FALSE(block.surface->back);
  const Pose inside{Vector3d(-0.5, -0.5, 0.9), Eigen::Quaterniond::Identity()};
  EXPECT_NEAR(deepest(contacts(block, {}, Sphere{0.05}, inside, 0)), -0.15, exact);
  const HeightField hills(HeightField::Heights::Zero(3, 3), 1.0);
  EXPECT_FALSE(hills.surface->back);  // solid below
  const Pose buried{Vector3d(1.1, 1.2, -0.5), Eigen::Quaterniond::Identity()};
  EXPECT_NEAR(deepest(contacts(hills, {}, Sphere{0.1}, buried, 0)), -0.6, exact);
}

TEST(Sheet, CarriesABallAndABoxFromEitherSide) {
  for (const bool up : {true, false})
    for (const double g : {-9.81, 9.81}) {
      Scene scene;
      scene.add({.name = "sheet", .shape = sheet(5, up), .is_static = true});
      const double side = g < 0 ? 1 : -1;
      scene.add(
          {.name = "ball", .shape = Sphere{0.1}, .pose = {.position = {0.51, 0.13, side * 1.0}}});
      scene.add({.name = "box",
                 .shape = Box{{0.2, 0.2, 0.2}},
                 .pose = {.position = {-0.53, 0.11, side * 1.0}}});
      scene.effects.emplace_back(UniformGravity{{0, 0, g}});
      Simulation simulation(scene);
      simulation.advance(3.0);
      for (const int row : {1, 2})  // the solver's own sink is bounded by tolerance::soft_sink
        EXPECT_NEAR(simulation.states().position[row].z(), side * 0.1, 5e-4)
            << "up " << up << " g " << g << " row " << row;
    }
}

// A capsule stands in a pyramid of three sheets upside down: its lower end is about equally near to
// all of them. Were it held by the nearest alone, it would be pushed through the other two.
TEST(Sheet, ACornerHoldsTheEndOfACapsuleWithEverySide) {
  TriangleMesh m;
  m.vertices.resize(4, 3);
  m.vertices << 0, 0, 0, 2, 0, 1, -1, 1.8, 1, -1, -1.7, 1;
  m.faces.resize(3, 3);
  m.faces << 0, 1, 2, 0, 2, 3, 0, 3, 1;
  const Shape pyramid = Mesh(m), capsule = Capsule{0.1, 0.5};
  const MeshSurface& surface = *std::get<Mesh>(pyramid).surface;
  for (const Vector3d& aside :
       {Vector3d(0, 0, 0), Vector3d(1e-3, 0, 0), Vector3d(-1e-3, 2e-3, 0)}) {
    const Vector3d end = Vector3d(0, 0, 0.13) + aside;
    std::vector<Manifold> found;
    collide(pyramid, {}, capsule, {.position = end + Vector3d(0, 0, 0.25)}, 0.05, found);
    for (int f = 0; f < 3; ++f) {
      const Vector3d n = surface.face_normals[f];
      const double gap = n.dot(end) - 0.1;
      ASSERT_LT(gap, 0.05);
      const bool held = std::ranges::any_of(found, [&](const Manifold& manifold) {
        return (manifold.normal - n).norm() < exact &&
               std::abs(manifold.points[0].separation - gap) < exact;
      });
      EXPECT_TRUE(held) << f;
    }
  }
}
