// SPDX-License-Identifier: Apache-2.0
// Hostile places and sizes: touching exactly, deep overlap, one centre, needles, sheets, a size
// ratio of 1e6, 1e6 m from the origin. Whatever is asked, the answer is finite, few points carry
// it, its normal is a unit vector, and no search stops at its cap unseen.
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "carom/geometry/frame.hpp"
#include "carom/geometry/sdf.hpp"
#include "carom/geometry/separation.hpp"
#include "carom/narrow/contacts.hpp"

#include "narrow/shapes_for_tests.hpp"

using namespace carom;
using namespace carom::testing;
using Eigen::Vector3d;

namespace {

Mesh sheet() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 2, 3;
  return Mesh(mesh);
}

Shape ball_grid() {
  const auto ball = [](const Vector3d& p) { return p.norm() - 0.4; };
  return Sdf{std::make_shared<const SdfGrid>(
      SdfGrid::from_function(ball, {Vector3d::Constant(-0.4), Vector3d::Constant(0.4)}, 0.05))};
}

/// Each kind of shape at a common size, all symmetric about their origin but the compound.
std::vector<Shape> common() {
  TriangleMesh::Vertices beads(2, 3), octahedron(6, 3);
  beads << -0.2, 0, 0, 0.2, 0, 0;
  octahedron << 0.5, 0, 0, -0.5, 0, 0, 0, 0.5, 0, 0, -0.5, 0, 0, 0, 0.5, 0, 0, -0.5;
  return {Sphere{0.5},
          Box{},
          Capsule{0.3, 0.5},
          Cylinder{0.4, 1.0},
          Cone{0.4, 1.0},
          Ellipsoid{{0.3, 0.4, 0.5}},
          ConvexHull(octahedron),
          Mesh(box_mesh({1, 1, 1}, 2)),
          Mesh(l_block()),
          sheet(),
          ball_grid(),
          HeightField(HeightField::Heights::Zero(3, 3), 1.0),
          ParticleSet{beads, 0.2},
          Compound({{Box{{0.5, 0.5, 0.5}}, {}},
                    {Sphere{0.2}, {Vector3d(0.3, 0, 0), Eigen::Quaterniond::Identity()}}})};
}

/// Thin, flat, small and large ones.
std::vector<Shape> extreme() {
  TriangleMesh::Vertices splinter(4, 3);
  splinter << 0, 0, 0, 1, 0, 0, 0.5, 1e-4, 0, 0.5, 0, 1e-4;
  return {Box{{1, 1e-6, 1e-6}},
          Box{{1, 1, 1e-9}},
          Capsule{1e-6, 1},
          Cylinder{1e-6, 1},
          Cylinder{1, 1e-6},
          Cone{1e-6, 1},
          Cone{1, 1e-6},
          Ellipsoid{{1, 1e-4, 1e-4}},
          Ellipsoid{{1, 1, 1e-4}},
          ConvexHull(splinter),
          Sphere{1e-6},
          Sphere{1e3},
          Box{{1e3, 1e3, 1e3}},
          Box{{1e-3, 1e-3, 1e-3}},
          Mesh(box_mesh({1, 1, 1e-6}, 2))};
}

bool is_static(const Shape& s) {
  return std::holds_alternative<Plane>(s) || std::holds_alternative<HeightField>(s);
}

double bounding(const Shape& s) {
  return bounding_radius(s);
}

void expect_sound(const Shape& a, const Pose& pa, const Shape& b, const Pose& pb,
                  const char* where) {
  const auto all = contacts(a, pa, b, pb, 0.02);
  const double most = bounding(a) + bounding(b) + (pa.position - pb.position).norm();
  for (const Manifold& m : all) {
    ASSERT_GE(m.count, 1) << where << name_of(a) << ' ' << name_of(b);
    ASSERT_LE(m.count, 4);
    ASSERT_TRUE(m.normal.allFinite()) << where << name_of(a) << ' ' << name_of(b);
    ASSERT_NEAR(m.normal.norm(), 1, 1e-9) << where << name_of(a) << ' ' << name_of(b);
    for (int k = 0; k < m.count; ++k) {
      ASSERT_TRUE(m.points[k].position.allFinite()) << where << name_of(a) << ' ' << name_of(b);
      ASSERT_TRUE(std::isfinite(m.points[k].separation)) << where << name_of(a) << name_of(b);
      ASSERT_LE(m.points[k].separation, 0.02 + 1e-12);
      ASSERT_GE(m.points[k].separation, -2 * most) << where << name_of(a) << ' ' << name_of(b);
    }
  }
}

void every_pair(const std::vector<Shape>& as, const std::vector<Shape>& bs,
                const std::function<void(const Shape&, const Shape&)>& test) {
  for (const Shape& a : as)
    for (const Shape& b : bs)
      if (!(is_static(a) && is_static(b))) test(a, b);
}

}  // namespace

TEST(Hostile, OneCentreAndOnePose) {
  const auto all = common();
  every_pair(all, all, [](const Shape& a, const Shape& b) {
    for (const Vector3d& turn :
         {Vector3d(0, 0, 0), Vector3d(0.3, 0.2, 0.1), Vector3d(0, 0, M_PI)}) {
      const Pose tilted{Vector3d::Zero(), rotation_exponential(turn)};
      expect_sound(a, {}, b, tilted, "one centre: ");
      if (!std::holds_alternative<HeightField>(a) && !std::holds_alternative<HeightField>(b) &&
          !std::holds_alternative<Mesh>(a) && !std::holds_alternative<Mesh>(b)) {
        EXPECT_LT(deepest(contacts(a, {}, b, tilted, 0)), 0) << name_of(a) << ' ' << name_of(b);
      }
    }
  });
}

TEST(Hostile, TouchingExactlyIsFoundAndIsZero) {
  // Set against one another along x, y and z by their own support: the gap is 0 to rounding. The
  // distance grid is as right as its error.
  const std::vector<Shape> solids{Sphere{0.5},
                                  Box{},
                                  Capsule{0.3, 0.5},
                                  Cylinder{0.4, 1.0},
                                  Ellipsoid{{0.3, 0.4, 0.5}},
                                  Mesh(box_mesh({1, 1, 1}, 2))};
  every_pair(solids, solids, [](const Shape& a, const Shape& b) {
    for (int axis = 0; axis < 3; ++axis) {
      Pose beside;
      beside.position[axis] = bounds(a, {}).upper[axis] - bounds(b, {}).lower[axis];
      const auto touch = contacts(a, {}, b, beside, 1e-9);
      ASSERT_FALSE(touch.empty()) << name_of(a) << ' ' << name_of(b) << ' ' << axis;
      // A few roundings of coordinates of a metre, and the refinement's own end, 1e-10.
      EXPECT_NEAR(deepest(touch), 0, 1e-9) << name_of(a) << ' ' << name_of(b) << ' ' << axis;
      EXPECT_NEAR(touch[0].normal[axis], 1, 1e-6) << name_of(a) << ' ' << name_of(b);
    }
  });
}

TEST(Hostile, NeedlesPlatesSplintersAndGiants) {
  std::mt19937_64 random(41);
  const auto thin = extreme();
  auto all = common();
  all.insert(all.end(), thin.begin(), thin.end());
  for (int trial = 0; trial < 6; ++trial)
    every_pair(thin, all, [&](const Shape& a, const Shape& b) {
      const double size = trial % 2 ? 0.3 : 0.02;
      const Pose pa = random_pose(random, size), pb = random_pose(random, size);
      expect_sound(a, pa, b, pb, "thin: ");
      expect_sound(b, pb, a, pa, "thin: ");
    });
}

TEST(Hostile, ASizeRatioOfAMillionKeepsTheDepth) {
  // A 1 mm ball and a 1 mm box on a 1 km box and in a 1 km ball: the plane of its face answers.
  for (const double gap : {-1e-4, 1e-4}) {
    const Box large{{1e3, 1e3, 1e3}};
    const Pose over{Vector3d(12.3, -45.6, 500 + 5e-4 + gap), Eigen::Quaterniond::Identity()};
    // Coordinates of 500 m: 64 u of them.
    const double rounding = 64 * 500 * 0x1p-53;
    EXPECT_NEAR(deepest(contacts(large, {}, Sphere{5e-4}, over, 1e-3)), gap, rounding);
    EXPECT_NEAR(deepest(contacts(large, {}, Box{{1e-3, 1e-3, 1e-3}}, over, 1e-3)), gap, rounding);
    EXPECT_NEAR(deepest(contacts(Mesh(box_mesh({1e3, 1e3, 1e3}, 3)), {}, Box{{1e-3, 1e-3, 1e-3}},
                                 over, 1e-3)),
                gap, rounding);
    const Pose top{Vector3d(0, 0, 1000 + 5e-4 + gap), Eigen::Quaterniond::Identity()};
    EXPECT_NEAR(deepest(contacts(Sphere{1e3}, {}, Sphere{5e-4}, top, 1e-3)), gap, 2 * rounding);
  }
}

TEST(Hostile, AMillionMetresFromTheOriginNothingChanges) {
  // Shifted by a power of two, so that what is lost is the positions' own rounding, 2^-33 of a
  // metre at 2^20 m: 1.2e-10 a coordinate, and the depth follows them one to one.
  const Vector3d far(0x1p20, -0x1p20, 0x1p20);
  const double rounding = 16 * 0x1p-33;
  std::mt19937_64 random(43);
  const auto all = common();
  int met = 0;
  for (int trial = 0; trial < 6; ++trial)
    every_pair(all, all, [&](const Shape& a, const Shape& b) {
      Pose pa = random_pose(random, 0.2), pb = random_pose(random, 0.6);
      // Positions that survive the shift exactly.
      for (Pose* p : {&pa, &pb}) p->position = ((p->position + far) - far).eval();
      const auto here = contacts(a, pa, b, pb, 0.02);
      pa.position += far, pb.position += far;
      const auto there = contacts(a, pa, b, pb, 0.02);
      ASSERT_EQ(here.empty(), there.empty()) << name_of(a) << ' ' << name_of(b);
      if (here.empty()) return;
      ++met;
      EXPECT_NEAR(deepest(here), deepest(there), rounding) << name_of(a) << ' ' << name_of(b);
    });
  EXPECT_GT(met, 300);
}

TEST(Hostile, NoSearchStopsAtItsCapUnseen) {
  // separation() says when it stops at its cap. Over every pair of convex shapes, at gaps from a
  // metre to one part in 1e12, through touching, to concentric, it never does.
  std::mt19937_64 random(47);
  std::vector<Shape> all;
  for (const auto& list : {common(), extreme()})
    for (const Shape& s : list)
      if (convex_of(s)) all.push_back(s);
  int capped = 0, asked = 0, most = 0;
  std::string worst;
  for (const Shape& a : all)
    for (const Shape& b : all) {
      const Convex ca = *convex_of(a), cb = *convex_of(b);
      for (int trial = 0; trial < 12; ++trial) {
        const Pose pa = random_pose(random, 1e-3);
        Pose pb = random_pose(random, 1);
        const double scale = std::pow(10.0, -trial);
        pb.position *= trial == 11 ? 0 : scale;
        const Separation s = separation(ca, cb, relative(Frame(pa), Frame(pb)), 1e9);
        ++asked;
        most = std::max(most, s.iterations);
        EXPECT_TRUE(std::isfinite(s.distance));
        if (s.status == SeparationStatus::iteration_limit) {
          ++capped;
          worst = std::string(name_of(a)) + ' ' + std::string(name_of(b)) + " trial " +
                  std::to_string(trial);
        }
      }
    }
  EXPECT_EQ(capped, 0) << "of " << asked << ", most iterations " << most << ", " << worst;
}
