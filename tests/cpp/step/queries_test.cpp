// SPDX-License-Identifier: Apache-2.0
#include "carom/step/queries.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

#include "narrow/shapes_for_tests.hpp"

using namespace carom;
using namespace carom::testing;
using Eigen::Vector3d;

namespace {

constexpr double exact = 1e-9;  // casts end within cast_gap (1e-10 of the size) of the surface

Pose at(double x, double y, double z) {
  return {Vector3d(x, y, z), Eigen::Quaterniond::Identity()};
}

Scene row_of_shapes() {
  Scene scene;
  const auto add = [&](Shape shape, double x) {
    BodyDefinition body;
    body.shape = std::move(shape);
    body.pose = at(x, 0, 0);
    body.is_static = true;
    scene.add(body);
  };
  add(Sphere{0.5}, 0);
  add(Box{{1, 1, 1}}, 2);
  add(Capsule{0.25, 0.5}, 4);
  add(Cylinder{0.5, 1}, 6);
  add(Cone{0.5, 1}, 8);
  add(Ellipsoid{{0.5, 0.5, 0.5}}, 10);
  add(Mesh(l_block()), 13);
  add(Plane{{0, 0, 1}, -2}, 0);
  return scene;
}

}  // namespace

TEST(Rays, MeetEachShapeAtItsHeight) {
  const Simulation simulation(row_of_shapes());
  const SceneQueries queries(simulation);
  const double x[] = {0.3, 2.2, 4.1, 6.3, 8.0, 10.3, 12.5, 15.5};
  const double top[] = {std::sqrt(0.25 - 0.09),
                        0.5,
                        0.25 + std::sqrt(0.0625 - 0.01),
                        0.5,
                        0.75,
                        std::sqrt(0.25 - 0.09),
                        1,
                        -2};
  for (int i = 0; i < 8; ++i) {
    const BodyHit hit = queries.ray({x[i], 0, 5}, {0, 0, -2}, 100);
    EXPECT_EQ(hit.row, i);
    EXPECT_NEAR(hit.cast.distance, 5 - top[i], exact) << i;
    EXPECT_GT(hit.cast.normal.z(), 0) << i;
  }
  EXPECT_EQ(queries.ray({0, 0, 5}, {0, 0, 1}, 100).row, -1);
  EXPECT_EQ(queries.ray({0.3, 0, 5}, {0, 0, -1}, 4).row, -1);
  EXPECT_THROW((void)queries.ray({0, 0, 0}, {0, 0, 0}, 1), InvalidInput);
}

TEST(ShapeCasts, StopAtFirstContact) {
  const Simulation simulation(row_of_shapes());
  const SceneQueries queries(simulation);
  // A ball of 0.2 over the box stands at 0.7; over the sphere's side it follows sqrt(0.7^2 - x^2).
  const BodyHit box = queries.shape(Sphere{0.2}, at(2, 0, 3), {0, 0, -1}, 100);
  EXPECT_EQ(box.row, 1);
  EXPECT_NEAR(box.cast.distance, 2.3, exact);
  const BodyHit ball = queries.shape(Sphere{0.2}, at(0.3, 0, 3), {0, 0, -1}, 100);
  EXPECT_EQ(ball.row, 0);
  EXPECT_NEAR(ball.cast.distance, 3 - std::sqrt(0.49 - 0.09), 1e-8);
  EXPECT_LE(ball.cast.distance, 3 - std::sqrt(0.49 - 0.09) + 1e-12);  // never beyond
}

TEST(Overlaps, NameTheBodiesTouched) {
  const Simulation simulation(row_of_shapes());
  const SceneQueries queries(simulation);
  EXPECT_EQ(queries.overlaps(Box{{2.2, 0.1, 0.1}}, at(1, 0, 0)), (std::vector<int>{0, 1}));
  EXPECT_EQ(queries.overlaps(Sphere{0.1}, at(20, 0, -2.05)), (std::vector<int>{7}));
  EXPECT_TRUE(queries.overlaps(Sphere{0.1}, at(20, 0, 3)).empty());
}

TEST(Queries, ReachAnyDistanceUnlessTold) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const Simulation simulation(row_of_shapes());
  const SceneQueries queries(simulation);
  // The first body is a ball of 0.5 m about the origin.
  EXPECT_NEAR(queries.ray({0, 1e6, 0}, {0, -1, 0}, inf).cast.distance, 1e6 - 0.5, 1e-9);
  EXPECT_NEAR(queries.shape(Sphere{0.1}, at(0, 1e3, 0), {0, -1, 0}, inf).cast.distance, 1e3 - 0.6,
              1e-9);
  Scene lone;
  BodyDefinition ball;
  ball.shape = Sphere{0.5};
  ball.is_static = true;
  lone.add(ball);
  const Simulation alone(std::move(lone));
  EXPECT_NEAR(SceneQueries(alone).closest({0, 1e6, 0}, inf).distance, 1e6 - 0.5, 1e-9);
  for (const double bad : {-1.0, -inf, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW((void)queries.ray({0, 5, 0}, {0, -1, 0}, bad), InvalidInput);
    EXPECT_THROW((void)queries.shape(Sphere{0.1}, at(0, 5, 0), {0, -1, 0}, bad), InvalidInput);
    EXPECT_THROW((void)queries.closest({0, 5, 0}, bad), InvalidInput);
  }
}

TEST(ClosestPoints, GiveDistanceAndBody) {
  const Simulation simulation(row_of_shapes());
  const SceneQueries queries(simulation);
  const BodyPoint side = queries.closest({0, 0.8, 0}, 10);
  EXPECT_EQ(side.row, 0);
  EXPECT_NEAR(side.distance, 0.3, exact);
  EXPECT_NEAR((side.point - Vector3d(0, 0.5, 0)).norm(), 0, exact);
  const BodyPoint inside = queries.closest({2.4, 0, 0}, 10);
  EXPECT_EQ(inside.row, 1);
  EXPECT_NEAR(inside.distance, -0.1, exact);
}

TEST(Segments, GiveTheShareOfTheWay) {
  const Simulation simulation(row_of_shapes());
  const SceneQueries queries(simulation);
  const BodyHit hit = queries.segment({2, 0, 2.5}, {2, 0, -1.5});  // the box's top lies at 0.5
  EXPECT_EQ(hit.row, 1);
  EXPECT_NEAR(hit.cast.distance, 0.5, exact);
  EXPECT_EQ(queries.segment({2, 0, 2.5}, {2, 0, 0.501}).row, -1);
  const BodyHit inside = queries.segment({2, 0, 0}, {2, 0, 0});  // of no length, in the box
  EXPECT_EQ(inside.row, 1);
  EXPECT_EQ(inside.cast.distance, 0);
}

TEST(SceneQueries, AskOnlyTheGroupsNamed) {
  Scene scene = row_of_shapes();
  scene.bodies[1].groups = 4;
  const Simulation simulation(scene);
  EXPECT_EQ(SceneQueries(simulation, 4).ray({2, 0, 5}, {0, 0, -1}, 100).row, 1);
  EXPECT_EQ(SceneQueries(simulation, 1).ray({2, 0, 5}, {0, 0, -1}, 100).row, 7);  // the plane
  EXPECT_EQ(SceneQueries(simulation, 2).ray({2, 0, 5}, {0, 0, -1}, 100).row, -1);
}

TEST(ClosestToShape, NamesBodyAndBothPoints) {
  const Simulation simulation(row_of_shapes());
  const SceneQueries queries(simulation);
  const NearestBody near = queries.closest(Sphere{0.2}, at(2, 1.5, 0), 10);
  EXPECT_EQ(near.row, 1);
  EXPECT_NEAR(near.points.distance, 0.8, exact);
  EXPECT_NEAR((near.points.point_a - Vector3d(2, 0.5, 0)).norm(), 0, exact);
  EXPECT_NEAR((near.points.point_b - Vector3d(2, 1.3, 0)).norm(), 0, exact);
  EXPECT_EQ(queries.closest(Sphere{0.2}, at(2, 1.5, 5), 0.5).row, -1);
}

TEST(ContactList, HoldsEveryBodyTouched) {
  const Simulation simulation(row_of_shapes());
  const SceneQueries queries(simulation);
  // A bar across, its ends 0.02 m inside the ball and the box.
  const auto found = queries.contacts(Box{{1.04, 0.4, 0.4}}, at(1, 0, 0), 0.0);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].row, 0);
  EXPECT_EQ(found[1].row, 1);
  EXPECT_NEAR(found[0].manifold.normal.x(), 1, exact);   // from the ball to the bar
  EXPECT_NEAR(found[1].manifold.normal.x(), -1, exact);  // from the box to the left
}

TEST(SceneQueries, AgreeWithAskingEveryBody) {
  // The tree only leaves out what cannot be met: the answers are those of a plain loop.
  std::mt19937_64 random(31);
  Scene scene;
  for (int i = 0; i < 60; ++i) {
    BodyDefinition body;
    body.shape = i % 3 == 0   ? Shape(Sphere{0.2})
                 : i % 3 == 1 ? Shape(Box{{0.3, 0.4, 0.5}})
                              : Shape(Capsule{0.1, 0.5});
    body.pose = random_pose(random, 2);
    body.is_static = true;
    scene.add(body);
  }
  const Simulation simulation(scene);
  const SceneQueries queries(simulation);
  int hits = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d from = random_vector(random, 3), way = random_vector(random, 3);
    const Vector3d d = way.normalized();
    CastHit best;
    int row = -1;
    double nearest = 1e9;
    int nearest_row = -1;
    for (int i = 0; i < 60; ++i) {
      const Pose pose = simulation.states().pose(i);
      const CastHit hit = ray_cast(scene.bodies[i].shape, pose, from, d, 100);
      if (hit.hit && hit.distance < best.distance) best = hit, row = i;
      const double gap =
          closest_points(scene.bodies[i].shape, pose, Sphere{0}, {from, {1, 0, 0, 0}}, 100)
              .distance;
      if (gap < nearest) nearest = gap, nearest_row = i;
    }
    const BodyHit hit = queries.ray(from, way, std::numeric_limits<double>::infinity());
    ASSERT_EQ(hit.row, row);
    if (row >= 0) {
      EXPECT_NEAR(hit.cast.distance, best.distance, exact);
      ++hits;
    }
    const BodyPoint point = queries.closest(from, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(point.distance, nearest, exact);
    EXPECT_EQ(point.row, nearest_row);
  }
  EXPECT_GT(hits, 20);
}
