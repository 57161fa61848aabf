// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/contacts.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "carom/geometry/mesh_surface.hpp"

#include "narrow/shapes_for_tests.hpp"

using namespace carom;
using namespace carom::testing;
using Eigen::Vector3d;

namespace {

// Coordinates here are a few metres, carried through two frames of 16 operations each: 64 u = 7e-15
// of them. A thousand times that is still a nanometre's millionth.
constexpr double exact = 1e-12;

Pose at(double x, double y, double z) {
  return {Vector3d(x, y, z), Eigen::Quaterniond::Identity()};
}

}  // namespace

TEST(BoxOnPlane, StandsOnItsFourCorners) {
  const auto all = contacts(Plane{}, {}, Box{{2, 1, 1}}, at(3, 0, 0.499), 0.01);
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].count, 4);
  EXPECT_NEAR((all[0].normal - Vector3d::UnitZ()).norm(), 0, exact);
  for (const auto& p : all[0].points) {
    EXPECT_NEAR(p.separation, -0.001, exact);
    EXPECT_NEAR(p.position.z(), -0.0005, exact);
    EXPECT_NEAR(std::abs(p.position.x() - 3), 1, exact);
  }
}

TEST(BoxOnBox, CarriesTheOverlapOfTheFaces) {
  // The upper box is shifted by 0.3, 0.2: their faces share 0.7 x 0.8.
  const auto all = contacts(Box{}, {}, Box{}, at(0.3, 0.2, 0.99), 0.01);
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].count, 4);
  EXPECT_NEAR(all[0].normal.z(), 1, exact);
  Aabb patch;
  for (const auto& p : all[0].points) {
    EXPECT_NEAR(p.separation, -0.01, exact);
    patch.extend(p.position);
  }
  EXPECT_NEAR((patch.lower - Vector3d(-0.2, -0.3, 0.495)).norm(), 0, exact);
  EXPECT_NEAR((patch.upper - Vector3d(0.5, 0.5, 0.495)).norm(), 0, exact);
}

TEST(BoxOnBox, NamesItsPointsTheSameAfterASmallSlide) {
  const auto before = collide(Box{}, {}, Box{}, at(0.3, 0.2, 0.99), 0.01);
  const auto after = collide(Box{}, {}, Box{}, at(0.3001, 0.2002, 0.9901), 0.01);
  ASSERT_EQ(before.count, 4);
  for (int i = 0; i < 4; ++i) {
    const auto same =
        std::ranges::find(after.points, before.points[i].feature, &ContactPoint::feature);
    ASSERT_NE(same, after.points.end());
    EXPECT_LT((same->position - before.points[i].position).norm(), 3e-4);
  }
}

TEST(BoxOnBox, CrossedEdgesMeetInOnePoint) {
  // Both boxes stand on an edge, turned a quarter against each other: edges along x and y cross.
  const double r = std::sqrt(0.5);
  Pose below, above;
  below.orientation = rotation_exponential(Vector3d(M_PI / 4, 0, 0));
  above.orientation = rotation_exponential(Vector3d(0, M_PI / 4, 0));
  above.position = {0.1, 0.2, 2 * r - 0.004};
  const auto m = collide(Box{}, below, Box{}, above, 0.01);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.normal.z(), 1, exact);
  EXPECT_NEAR(m.points[0].separation, -0.004, exact);
  EXPECT_NEAR((m.points[0].position - Vector3d(0.1, 0, r - 0.002)).norm(), 0, exact);
}

TEST(BoxOnBox, DepthIsTheLeastTranslationThatSeparates) {
  // Reference: the same question put to the support functions of the Minkowski difference over all
  // fifteen axes, by dense projection of the corners.
  std::mt19937_64 random(5);
  int overlapping = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Box a{random_vector(random).cwiseAbs() + Vector3d::Constant(0.1)},
        b{random_vector(random).cwiseAbs() + Vector3d::Constant(0.1)};
    const Pose pa = random_pose(random, 0.5), pb = random_pose(random, 0.5);
    const Eigen::Matrix3d A = pa.orientation.toRotationMatrix(),
                          B = pb.orientation.toRotationMatrix();
    std::vector<Vector3d> axes;
    for (int i = 0; i < 3; ++i) {
      axes.push_back(A.col(i));
      axes.push_back(B.col(i));
      for (int j = 0; j < 3; ++j) axes.push_back(A.col(i).cross(B.col(j)).normalized());
    }
    double gap = -std::numeric_limits<double>::infinity();
    for (const Vector3d& n : axes)
      gap = std::max(gap, std::abs(n.dot(pb.position - pa.position)) -
                              0.5 * ((A.transpose() * n).cwiseAbs().dot(a.extents) +
                                     (B.transpose() * n).cwiseAbs().dot(b.extents)));
    const auto m = collide(a, pa, b, pb, 0.0);
    if (gap > 1e-9) {
      EXPECT_EQ(m.count, 0);
      continue;
    }
    ++overlapping;
    ASSERT_GT(m.count, 0) << "trial " << trial << " gap " << gap;
    double least = 0;
    for (int k = 0; k < m.count; ++k) least = std::min(least, m.points[k].separation);
    EXPECT_NEAR(least, gap, 1e-9) << "trial " << trial;
  }
  EXPECT_GT(overlapping, 500);
}

TEST(MeshBox, GivesThePrimitiveBoxContacts) {
  std::mt19937_64 random(7);
  int met = 0, differ = 0;
  for (int n : {1, 3})
    for (int trial = 0; trial < 300; ++trial) {
      const Vector3d extents = random_vector(random).cwiseAbs() + Vector3d::Constant(0.2);
      const Box other{random_vector(random).cwiseAbs() + Vector3d::Constant(0.2)};
      const Pose pa = random_pose(random, 0.5), pb = random_pose(random, 0.5);
      static Mesh mesh[2];
      mesh[0] = Mesh(box_mesh(extents, n));
      ASSERT_TRUE(mesh[0].surface->polytope);
      ASSERT_EQ(mesh[0].surface->polytope->face_count(), 6);
      const auto by_box = collide(Box{extents}, pa, other, pb, 0.02);
      const auto by_mesh = collide(mesh[0], pa, other, pb, 0.02);
      ASSERT_EQ(by_box.count == 0, by_mesh.count == 0) << "trial " << trial;
      if (by_box.count == 0) continue;
      ++met;
      EXPECT_NEAR(deepest({by_box}), deepest({by_mesh}), 1e-9);
      if (by_box.count != by_mesh.count) {  // an edge at exactly the angle where it counts as flat
        ++differ;
        continue;
      }
      EXPECT_LT((by_box.normal - by_mesh.normal).norm(), 1e-9);
      for (int i = 0; i < by_box.count; ++i) {
        double nearest = 1;
        for (int k = 0; k < by_mesh.count; ++k)
          nearest = std::min(
              nearest, (by_box.points[i].position - by_mesh.points[k].position).norm() +
                           std::abs(by_box.points[i].separation - by_mesh.points[k].separation));
        EXPECT_LT(nearest, 1e-9) << "trial " << trial << " point " << i;
      }
    }
  EXPECT_GT(met, 100);
  EXPECT_LE(differ, met / 50);
}

TEST(BallOnMesh, MeetsTheThreeFacesOfACorner) {
  // The inner corner of a room made of three slabs as one mesh is the notch of the L block.
  const Mesh block(l_block());
  EXPECT_FALSE(block.surface->polytope);
  EXPECT_EQ(block.surface->faults.to_string(), "");
  EXPECT_NEAR(block.surface->volume, 3, exact);
  const auto all = contacts(block, {}, Sphere{0.2}, at(0.19, 0.195, 0.5), 0.01);
  ASSERT_EQ(all.size(), 2u);  // both walls of the notch
  EXPECT_NEAR(deepest(all), -0.01, exact);
  for (const Manifold& m : all) EXPECT_NEAR(std::max(m.normal.x(), m.normal.y()), 1, exact);
}

TEST(BallOnMesh, FeelsNoInternalEdge) {
  const Mesh floor(box_mesh({4, 4, 1}, 4));
  for (int i = 0; i < 2000; ++i) {
    const double x = -1.5 + i * 0.0015;
    const auto all = contacts(floor, {}, Sphere{0.3}, at(x, x / 3, 0.799), 0.01);
    ASSERT_EQ(all.size(), 1u) << x;
    EXPECT_EQ(all[0].normal, Vector3d::UnitZ());
    EXPECT_NEAR(all[0].points[0].separation, -0.001, exact);
  }
}

TEST(BoxOnMesh, StandsOnANonConvexMeshAsOnAPlane) {
  const Mesh block(l_block());
  // Over the corner x, y < 0 of the block: the whole bottom face lies on it.
  const auto all = contacts(block, {}, Box{{0.6, 0.5, 0.4}}, at(-0.5, -0.5, 1.199), 0.01);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].count, 4);
  EXPECT_NEAR(all[0].normal.z(), 1, exact);
  EXPECT_NEAR(deepest(all), -0.001, exact);
}

TEST(BoxOnMesh, HangsOverANotchByTheCrossingsOfItsEdges) {
  const Mesh block(l_block());
  // Centred over the notch's corner: three quarters of the face are carried.
  const auto all = contacts(block, {}, Box{{0.6, 0.6, 0.4}}, at(0, 0, 1.199), 0.01);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].count, 4);
  Vector3d mean = Vector3d::Zero();
  for (const auto& p : all[0].points) {
    EXPECT_NEAR(p.separation, -0.001, exact);
    mean += 0.25 * p.position;
    EXPECT_FALSE(p.position.x() > exact && p.position.y() > exact);
  }
}

TEST(MeshOnMesh, TwoBlocksStackWithFourPoints) {
  const Mesh block(l_block());
  const auto all = contacts(block, {}, block, at(0, 0, 0.999), 0.01);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].count, 4);
  EXPECT_NEAR(all[0].normal.z(), 1, exact);
  EXPECT_NEAR(deepest(all), -0.001, exact);
}

TEST(MeshOnPlane, LandsOnItsLowestVertices) {
  const Mesh block(l_block());
  const auto all = contacts(Plane{}, {}, block, at(0, 0, 0.002), 0.01);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].count, 4);
  EXPECT_NEAR(deepest(all), 0.002, exact);
}

TEST(Pairs, SeenFromTheOtherShapeAreTheSame) {
  std::mt19937_64 random(11);
  const std::vector<Shape> shapes{Sphere{0.4}, Box{{0.5, 0.7, 0.9}}, Plane{{0.1, 0.2, 1}, 0.1},
                                  Mesh(box_mesh({0.6, 0.6, 0.8}, 2)), Mesh(l_block())};
  int met = 0;
  for (int trial = 0; trial < 400; ++trial)
    for (const Shape& a : shapes)
      for (const Shape& b : shapes) {
        if (std::holds_alternative<Plane>(a) && std::holds_alternative<Plane>(b)) continue;
        const Pose pa = random_pose(random, 0.7), pb = random_pose(random, 0.7);
        const auto ab = contacts(a, pa, b, pb, 0.02), ba = contacts(b, pb, a, pa, 0.02);
        ASSERT_EQ(ab.empty(), ba.empty()) << name_of(a) << ' ' << name_of(b);
        if (ab.empty()) continue;
        ++met;
        EXPECT_NEAR(deepest(ab), deepest(ba), 1e-9) << name_of(a) << ' ' << name_of(b);
      }
  EXPECT_GT(met, 1000);
}
