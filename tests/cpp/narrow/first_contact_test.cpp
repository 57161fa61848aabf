// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/first_contact.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "carom/narrow/queries.hpp"
#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"

#include "shapes_for_tests.hpp"

namespace carom::testing {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Status = FirstContact::Status;
constexpr double pi = std::numbers::pi;
// A contact is called at a gap between sweep_clear and half as much again, and what rounding adds.
constexpr double clear = tolerance::sweep_clear;

BodyPath path_of(const Vector3d& at, const Vector3d& v = Vector3d::Zero(),
                 const Vector3d& a = Vector3d::Zero(), const Vector3d& w = Vector3d::Zero(),
                 const Quaterniond& q = Quaterniond::Identity()) {
  BodyPath path;
  path.centre = at;
  path.velocity = v;
  path.acceleration = a;
  path.arcs = {{0, q, w}};
  return path;
}

Mesh sheet(double half) {  // without thickness, in the plane x = 0, normals towards +x
  TriangleMesh m;
  m.vertices.resize(4, 3);
  m.vertices << 0, -half, -half, 0, half, -half, 0, half, half, 0, -half, half;
  m.faces.resize(2, 3);
  m.faces << 0, 1, 2, 0, 2, 3;
  return Mesh(m);
}

TEST(FirstContact, ABulletMeetsAWallAtTheTimeOfItsGap) {
  const Shape wall = Box{{0.01, 4, 4}}, ball = Sphere{0.05};
  for (const double speed : {1.0, 1e3, 1e4}) {
    const FirstContact r =
        first_contact(wall, path_of({0, 0, 0}), ball, path_of({-2, 0.3, 0.2}, {speed, 0, 0}), 0, 2);
    ASSERT_EQ(r.status, Status::contact);
    const double gap = 2 - 0.005 - 0.05;
    EXPECT_LE(r.time, gap / speed);
    EXPECT_GE(r.time, (gap - 1.51 * clear) / speed);
    EXPECT_NEAR(r.normal.x(), -1, 1e-9);
    EXPECT_LE(r.queries, 4);
  }
}

TEST(FirstContact, AThrownBallMeetsTheFloorWhereItsParabolaDoes) {
  const Shape floor = Plane{}, ball = Sphere{0.1};
  const double height = 2, up = 3, g = 9.81;  // 0 = h - r + v t - g t^2 / 2
  const double exact = (up + std::sqrt(up * up + 2 * g * (height - 0.1))) / g;
  const FirstContact r = first_contact(floor, path_of({0, 0, 0}), ball,
                                       path_of({0, 0, height}, {5, 0, up}, {0, 0, -g}), 0, 10);
  ASSERT_EQ(r.status, Status::contact);
  EXPECT_LE(r.time, exact);
  const double speed = std::sqrt(up * up + 2 * g * (height - 0.1));
  EXPECT_GE(r.time, exact - 1.51 * clear / speed);
}

TEST(FirstContact, ASheetHoldsFromBothSides) {
  const Shape wall = sheet(2), ball = Sphere{0.05};
  for (const double side : {-1.0, 1.0}) {
    const FirstContact r = first_contact(wall, path_of({0, 0, 0}), ball,
                                         path_of({side, 0.3, 0.2}, {-side * 100, 0, 0}), 0, 1);
    ASSERT_EQ(r.status, Status::contact) << side;
    EXPECT_NEAR(r.time, 0.95 / 100, 1.51 * clear / 100);
    EXPECT_NEAR(r.normal.x(), side, 1e-9);
  }
}

// The rod's axis turns about z; a ball of 0.05 stands at radius 0.9 and angle phi. They touch when
// 0.9 sin(phi - theta) = 0.07.
// A long way over a fine sheet is searched in halves. A part that meets late, found first, must not
// end the search for one that meets earlier, but not in the first half.
TEST(FirstContact, EachPartOfABodyIsFollowedToTheFirstContactOfAny) {
  constexpr int cells = 40;
  TriangleMesh m;  // in the plane z = 0, cells of 0.5 m
  m.vertices.resize((cells + 1) * (cells + 1), 3);
  m.faces.resize(2 * cells * cells, 3);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) m.vertices.row(j * (cells + 1) + i) << 0.5 * i, 0.5 * j, 0;
  for (int j = 0, f = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + cells + 1;
      m.faces.row(f++) << a, a + 1, b + 1;
      m.faces.row(f++) << a, b + 1, b;
    }
  const Shape ground = Mesh(m);
  const Vector3d velocity(180, 0, -10);
  for (const double low : {-0.05, -0.15, -0.3}) {  // m, by how much the second part hangs lower
    const Shape body = Compound(
        {{Sphere{0.05}, {.position = {0, 0, 0}}}, {Sphere{0.05}, {.position = {0.2, 0.1, low}}}});
    const BodyPath path = path_of({1, 10, 1.0}, velocity);
    const FirstContact r = first_contact(ground, path_of({0, 0, 0}), body, path, 0, 0.1);
    ASSERT_EQ(r.status, Status::contact) << low;
    const double exact = (1.0 + low - 0.05) / 10;
    EXPECT_LE(r.time, exact) << low;
    EXPECT_GE(r.time, exact - 1.51 * clear / 10) << low;
  }
}

TEST(FirstContact, ASpinningRodMeetsAPostAtItsAngle) {
  const Shape rod = Capsule{0.02, 2}, post = Sphere{0.05};
  const Quaterniond along_x(Eigen::AngleAxisd(pi / 2, Vector3d::UnitY()));
  for (const double rate : {1.0, 100.0, 1000.0})
    for (double phi = 0.2; phi < 3; phi += 0.31) {
      const Vector3d at(0.9 * std::cos(phi), 0.9 * std::sin(phi), 0);
      const FirstContact r =
          first_contact(rod, path_of({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, rate}, along_x), post,
                        path_of(at), 0, 2 * pi / rate);
      ASSERT_EQ(r.status, Status::contact) << rate << ' ' << phi;
      const double exact = (phi - std::asin(0.07 / 0.9)) / rate;
      EXPECT_LE(r.time, exact);
      EXPECT_GE(r.time, exact - 1.6 * clear / 0.85 / rate);  // cos(asin(0.07 / 0.9)) 0.9 > 0.85
    }
}

// What turns or slides in touch is not met again while its gap stays.
TEST(FirstContact, RollingAndSlidingInTouchAreNoHits) {
  const Shape floor = Box{{40, 40, 0.1}}, roller = Cylinder{0.1, 0.2}, slab = Box{{0.4, 0.4, 0.1}};
  const Quaterniond lying(Eigen::AngleAxisd(pi / 2, Vector3d::UnitX()));
  const FirstContact rolls =
      first_contact(floor, path_of({0, 0, 0}), roller,
                    path_of({-5, 0, 0.15}, {10, 0, 0}, {0, 0, 0}, {0, 100, 0}, lying), 0, 0.1);
  EXPECT_EQ(rolls.status, Status::clear);
  const FirstContact slides =
      first_contact(floor, path_of({0, 0, 0}), slab, path_of({-5, 0, 0.0999}, {100, 0, 0}), 0, 0.1);
  EXPECT_EQ(slides.status, Status::clear);
}

// A floor of 200 triangles is one floor: a ball that has sunk into it by 1e-4 is not stopped by the
// next triangle.
TEST(FirstContact, InternalEdgesOfAFloorStopNothing) {
  const Shape floor = Mesh(box_mesh({4, 4, 0.1}, 10)), ball = Sphere{0.1};
  const FirstContact r = first_contact(floor, path_of({0, 0, 0}), ball,
                                       path_of({-1.5, 0.03, 0.1499}, {30, 0, 0}), 0, 0.1);
  EXPECT_EQ(r.status, Status::clear);
}

const std::vector<Shape>& movers() {
  static const std::vector<Shape> all = [] {
    TriangleMesh::Vertices points(5, 3);
    points << -0.3, -0.3, 0, 0.3, -0.3, 0, 0, 0.4, 0, 0, 0, 0.5, 0, 0, -0.1;
    ParticleSet balls;
    balls.positions.resize(3, 3);
    balls.positions << 0, 0, 0, 0.3, 0, 0, 0, 0.3, 0.1;
    balls.radius = 0.05;
    return std::vector<Shape>{
        Sphere{0.3},
        Box{{0.6, 0.3, 0.1}},
        Capsule{0.1, 0.5},
        Cylinder{0.2, 0.4},
        Cone{0.3, 0.5},
        Ellipsoid{{0.4, 0.2, 0.1}},
        ConvexHull(points),
        Mesh(l_block()),
        balls,
        Compound({{Box{{0.6, 0.1, 0.1}}, {}}, {Sphere{0.15}, Pose{.position = {0.3, 0, 0}}}})};
  }();
  return all;
}

// Against dense sampling with another routine: collide() at poses along the paths.
TEST(FirstContact, NoPairOfShapesOverlapsBeforeTheTimeThatIsSaid) {
  std::mt19937_64 random(20261126);
  int met = 0;
  for (std::size_t i = 0; i < movers().size(); ++i)
    for (std::size_t j = 0; j < movers().size(); ++j)
      for (int trial = 0; trial < 4; ++trial) {
        const Pose a = random_pose(random), b = random_pose(random);
        const Vector3d apart = random_vector(random).normalized() * 4;
        const BodyPath path_a = path_of(a.position, random_vector(random, 2), {0, 0, -9.81},
                                        random_vector(random, 15), a.orientation);
        const BodyPath path_b = path_of(a.position + apart, -apart * 10 + random_vector(random, 3),
                                        {0, 0, 0}, random_vector(random, 15), b.orientation);
        const FirstContact r = first_contact(movers()[i], path_a, movers()[j], path_b, 0, 0.5);
        ASSERT_NE(r.status, Status::gave_up);
        met += r.status == Status::contact;
        const double until = r.status == Status::contact ? r.time : 0.5;
        for (int k = 0; k <= 200; ++k) {
          const double t = until * k / 200;
          const double gap = deepest(
              contacts(movers()[i], path_a.pose_at(t), movers()[j], path_b.pose_at(t), 2 * clear));
          // collide() is right to 1e-9 m (its own tests).
          ASSERT_GT(gap, clear - 2e-9) << i << ' ' << j << ' ' << trial << ' ' << t;
        }
        if (r.status == Status::contact) {  // and there they do meet
          const double gap = deepest(contacts(movers()[i], path_a.pose_at(until), movers()[j],
                                              path_b.pose_at(until), 2 * clear));
          ASSERT_LT(gap, 1.51 * clear) << i << ' ' << j << ' ' << trial;
        }
      }
  EXPECT_GT(met, 200);  // of 400: the test must test hits
}

}  // namespace
}  // namespace carom::testing
