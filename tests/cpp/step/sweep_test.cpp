// SPDX-License-Identifier: Apache-2.0
// Nothing passes through anything: first that it does without the sweep, then that it does not.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "carom/geometry/mesh.hpp"
#include "carom/numerics/tolerance.hpp"
#include "carom/step/simulation.hpp"

namespace carom {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Mesh sheet() {  // without thickness, in the plane x = 0
  TriangleMesh m;
  m.vertices.resize(4, 3);
  m.vertices << 0, -2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2;
  m.faces.resize(2, 3);
  m.faces << 0, 1, 2, 0, 2, 3;
  return Mesh(m);
}

Simulation shot(const Shape& wall, double speed, Ccd ccd, double restitution = 0) {
  Scene scene;
  scene.add({.name = "wall", .shape = wall, .is_static = true});
  scene.add({.name = "ball",
             .shape = Sphere{0.05},
             .mass = 1.0,
             .pose = {.position = {-1.234, 0.1, 0.2}},
             .velocity = {speed, 0, 0},
             .restitution = restitution,
             .ccd = ccd});
  return Simulation(std::move(scene));
}

double x_of(const Simulation& s, int row) {
  return s.states().position[row].x();
}

TEST(Sweep, ABulletTunnelsWithoutItAndNeverWithIt) {
  for (const Shape& wall : {Shape(Box{{0.01, 4, 4}}), Shape(sheet()), Shape(Plane{{-1, 0, 0}, 0})})
    for (const double speed : {100.0, 1e3, 1e4}) {
      Simulation control = shot(wall, speed, Ccd::never), cured = shot(wall, speed, Ccd::automatic);
      for (int k = 0; k < 4; ++k) control.step(), cured.step();
      EXPECT_GT(x_of(control, 1), 0.1) << speed;  // the negative control: it is through
      EXPECT_LT(x_of(cured, 1), 0) << speed;
      EXPECT_EQ(cured.report().sweep.impacts, 1);
      EXPECT_TRUE(cured.report().ok());
    }
}

// It flies on for the rest of the step: x = wall - e v (t - t_hit), to the gap at which hits are
// called (1e-6 m) times 1 + e.
TEST(Sweep, ABounceLosesNoTime) {
  Simulation s = shot(Box{{0.01, 4, 4}}, 1e3, Ccd::automatic, 0.5);
  s.step();
  const double way = 1.234 - 0.055, rest = 1.0 / 60 - way / 1e3;
  EXPECT_NEAR(x_of(s, 1), -0.055 - 500 * rest, 1.6e-6);
  EXPECT_NEAR(s.states().velocity[1].x(), -500, 500 * tolerance::hit_residual * 10);
  EXPECT_EQ(s.report().sweep.time_lost, 0);
}

// Each hit is elastic to hit_residual of its speed, 1e-11; a thousand add up to 2e-8 at worst, and
// as they are not of one sign to far less.
TEST(Sweep, ABouncingBallKeepsItsEnergyOverAThousandBounces) {
  Scene scene;
  scene.add({.name = "floor", .shape = Plane{}, .is_static = true});
  scene.add({.name = "ball",
             .shape = Sphere{0.1},
             .mass = 1.0,
             .pose = {.position = {0, 0, 1.1}},
             .restitution = 1.0});
  scene.effects.emplace_back(UniformGravity{{0, 0, -9.81}});
  Simulation s(std::move(scene));
  const Energy start = s.energy();
  double worst = 0;
  while (s.report().sweep.impacts < 1000) {
    s.step();
    const Energy now = s.energy();
    worst = std::max(worst, std::abs(now.kinetic + now.potential - start.potential));
  }
  EXPECT_LT(worst / (9.81 * 1.0), 1e-9);
  // Flight times: 1000 bounces take (2 * 1000 - 1) sqrt(2 h / g), h = 1 m less the gap of 1e-6.
  EXPECT_NEAR(s.time(), 1999 * std::sqrt(2 / 9.81), 1.0 / 60 + 1999 * 0.5e-6 * std::sqrt(2 / 9.81));
}

/// A rod of 1 m spins at 100 rad/s next to a wall of 1 cm that its end reaches.
Simulation rod_beside_wall(Ccd ccd, double dt) {
  Scene scene;
  scene.add({.name = "wall", .shape = Box{{0.01, 4, 4}}, .is_static = true, .friction = 0.0});
  scene.add({.name = "rod",
             .shape = Box{{1.0, 0.05, 0.05}},
             .mass = 1.0,
             .pose = {.position = {-0.3, 0, 0},
                      .orientation = Eigen::Quaterniond(
                          Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()))},
             .angular_velocity = {0, 0, 100},
             .ccd = ccd});
  return Simulation(std::move(scene), {.dt = dt});
}

double farthest_corner(const Simulation& s) {
  const Pose pose = s.states().pose(1);
  double x = -1e300;
  for (const double i : {-0.5, 0.5})
    for (const double j : {-0.025, 0.025}) x = std::max(x, (pose * Vector3d(i, j, 0)).x());
  return x;
}

// Closed form of an inelastic hit without friction: the end at arm r = (rx, ry) from the centre
// closes at w |ry|, impulse J = w |ry| / (1/m + ry^2 / I), new spin w - |ry| J / I.
TEST(Sweep, ASpinningRodHitsTheWallAndKeepsWhatSpinItShould) {
  Simulation control = rod_beside_wall(Ccd::never, 1.0 / 60);
  double deepest = -1;
  for (int k = 0; k < 6; ++k) control.step(), deepest = std::max(deepest, farthest_corner(control));
  EXPECT_GT(deepest, 0.02);  // the negative control: 2 cm and more

  Simulation s = rod_beside_wall(Ccd::automatic, 1.0 / 60);
  deepest = -1;
  while (s.report().sweep.impacts == 0) s.step(), deepest = std::max(deepest, farthest_corner(s));
  const double spin = s.states().angular_velocity(1).z();
  for (int k = 0; k < 10; ++k) s.step(), deepest = std::max(deepest, farthest_corner(s));
  EXPECT_LT(deepest, -0.005 + 1e-4);
  EXPECT_TRUE(s.report().ok());
  // The corner that hits: distance 0.5006 from the centre, at x = 0.295 from it.
  const double arm = std::sqrt(0.25 + 0.025 * 0.025 - 0.295 * 0.295), inertia = (1 + 0.0025) / 12;
  const double impulse = 100 * arm / (1 + arm * arm / inertia);
  EXPECT_NEAR(spin, 100 - arm * impulse / inertia, 1e-3);  // 1e-6 m of gap turn the arm by 3e-6
}

TEST(Sweep, AChainOfAHundredBallsPassesOnTheSpeedOfTheFirst) {
  Scene scene;
  for (int i = 0; i < 100; ++i)
    scene.add({.shape = Sphere{0.05},
               .mass = 1.0,
               .pose = {.position = {0.101 * i, 0, 0}},
               .restitution = 1.0});
  scene.add({.shape = Sphere{0.05},
             .mass = 1.0,
             .pose = {.position = {-1, 0, 0}},
             .velocity = {300, 0, 0},
             .restitution = 1.0});
  Simulation s(std::move(scene));
  for (int k = 0; k < 4; ++k) s.step();
  EXPECT_EQ(s.report().sweep.impacts, 100);
  EXPECT_NEAR(s.momentum().x(), 300, 300 * 1e-12);
  EXPECT_NEAR(s.states().velocity[99].x(), 300, 300 * 100 * tolerance::hit_residual);
  for (int i = 1; i < 100; ++i) EXPECT_GT(x_of(s, i), x_of(s, i - 1) + 0.1);
}

// A box that meets the wall with a corner keeps most of its speed and turns it into spin: the wall
// must be asked about again, and again.
TEST(Sweep, AHitThatDoesNotStopIsFollowedByTheNext) {
  Scene scene;
  scene.add({.name = "plate", .shape = Box{{1e-4, 20, 20}}, .is_static = true});
  scene.add({.name = "box",
             .shape = Box{{0.02, 0.02, 0.02}},
             .pose = {.position = {-700, 0.3, 0.4}},
             .velocity = {12000, 0, 0},
             .angular_velocity = {60, -30, 80}});
  Simulation s(std::move(scene), {.dt = 0.1});
  for (int k = 0; k < 20; ++k) {
    s.step();
    ASSERT_LT(x_of(s, 1), 0) << k;
  }
}

TEST(Sweep, TwoBulletsMeetHeadOn) {
  Scene scene;
  for (const double side : {-1.0, 1.0})
    scene.add({.shape = Box{{0.02, 0.02, 0.02}},
               .mass = 1.0,
               .pose = {.position = {side, 0, 0}},
               .velocity = {-side * 1000, 0, 0},
               .restitution = 1.0});
  Simulation s(std::move(scene));
  s.step();
  EXPECT_LT(x_of(s, 0), x_of(s, 1));
  EXPECT_NEAR(s.states().velocity[1].x(), 1000, 1e-6);
}

// A ball between two slabs of a ton that close at 100 m/s: more hits than a step may hold. It
// waits, it is told, and it is still between them.
TEST(Sweep, WhatIsWedgedWaitsAndIsReported) {
  Scene scene;
  for (const double side : {-1.0, 1.0})
    scene.add({.shape = Box{{0.2, 2, 2}},
               .mass = 1000.0,
               .pose = {.position = {side, 0, 0}},
               .velocity = {-side * 50, 0, 0}});
  scene.add({.shape = Sphere{0.05}, .mass = 1e-3, .velocity = {30, 5, 0}, .restitution = 1.0});
  Simulation s(std::move(scene));
  for (int k = 0; k < 60; ++k) {
    s.step();
    ASSERT_TRUE(s.states().position[2].allFinite());
    ASSERT_LT(x_of(s, 0), x_of(s, 2));
    ASSERT_LT(x_of(s, 2), x_of(s, 1));
  }
  const SweepReport& sweep = s.report().sweep;
  EXPECT_EQ(s.report().ok(), sweep.waited == 0 && s.report().contact.gave_up == 0);
  EXPECT_GT(sweep.impacts, 2);
}

// Two hulls that spin and hit at everyday speed: a pair that is given up for the rest of a step
// waits, and gets its momentum back.
TEST(Sweep, APairGivenUpKeepsItsMomentum) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  TriangleMesh::Vertices points(12, 3);
  for (int i = 0; i < 12; ++i)
    points.row(i) << 0.2 * normal(random), 0.2 * normal(random), 0.2 * normal(random);
  const Shape hull = ConvexHull(points);
  for (int run = 0; run < 40; ++run) {
    Scene scene;
    for (const double side : {-1.0, 1.0})
      scene.add({.shape = hull,
                 .pose = {.position = {0.5 * side, 0.05 * normal(random), 0.05 * normal(random)}},
                 .velocity = {-2 * side, 0, 0},
                 .angular_velocity = 4 * Vector3d(normal(random), normal(random), normal(random))});
    Simulation s(std::move(scene));
    const auto mean = [&] { return Vector3d(s.states().velocity[0] + s.states().velocity[1]); };
    const Vector3d before = mean();
    s.advance(1);
    EXPECT_LT((mean() - before).norm(), 1e-9) << run;
  }
}

// The second look is by other code: it must see the crossing of a body that nobody followed, and
// none where bodies are followed through hits.
TEST(Sweep, TheSecondLookFindsWhatPassesAndOnlyThat) {
  for (const bool passes : {true, false})
    for (const Shape& wall : {Shape(Box{{0.01, 4, 4}}), Shape(sheet())}) {
      Scene scene;
      scene.add({.name = "wall", .shape = wall, .is_static = true});
      scene.add({.name = "ball",
                 .shape = Sphere{0.05},
                 .pose = {.position = {-1.234, 0.1, 0.2}},
                 .velocity = {300, 0, 0},
                 .restitution = 0.5,
                 .ccd = passes ? Ccd::never : Ccd::automatic});
      scene.add({.name = "rod",
                 .shape = Capsule{0.02, 1},
                 .pose = {.position = {-0.2, 1, 0}},
                 .angular_velocity = {0, 90, 0}});
      scene.effects.emplace_back(UniformGravity{{0, 0, -9.81}});
      Simulation s(std::move(scene), {.verify = true});
      for (int k = 0; k < 5; ++k) s.step();
      EXPECT_EQ(s.report().sweep.crossings, passes ? 1 : 0);
      EXPECT_EQ(s.report().ok(), !passes);
      EXPECT_GE(s.report().sweep.verified,
                2);  // the first step alone has wall and ball, wall and rod
    }
}

// A small box turns by 0.34 rad in a step above a sheet: 15 mm for its corners, less than the 17 mm
// that fit into it, so the contacts of the step are those of the corner that is lowest as it
// begins. The one that comes down after it must be seen too. What may go unseen is sweep_deepest.
TEST(Sweep, ACornerThatTurnsDownOnASheetIsSeen) {
  TriangleMesh m;
  m.vertices.resize(4, 3);
  // Bent by a hair: a flat sheet is met as a half-space, by all corners of the box at once.
  m.vertices << -2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2, 1e-7;
  m.faces.resize(2, 3);
  m.faces << 0, 1, 2, 0, 2, 3;
  const Vector3d half(0.017, 0.0335, 0.025);
  const auto lowest = [&](const Pose& pose) {
    const Vector3d down = pose.orientation.conjugate() * Vector3d::UnitZ();
    return pose.position.z() - half.dot(down.cwiseAbs());
  };
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  double deepest[2] = {0, 0};
  for (int run = 0; run < 400; ++run) {
    const Quaterniond q =
        Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Vector3d axis = Vector3d(normal(random), normal(random), normal(random)).normalized();
    for (const Ccd ccd : {Ccd::automatic, Ccd::never}) {
      Scene scene;
      scene.add({.name = "sheet", .shape = Mesh(m), .is_static = true});
      scene.add({.name = "box",
                 .shape = Box{2 * half},
                 .pose = {.position = {0.1, 0.2, 1e-4 - lowest({{0, 0, 0}, q})}, .orientation = q},
                 .velocity = {0, 0, -0.2},
                 .angular_velocity = 60 * axis,
                 .ccd = ccd});
      Simulation s(std::move(scene), {.dt = 0.0057});
      for (int k = 0; k < 4; ++k) {
        s.step();
        double& worst = deepest[ccd == Ccd::never];
        worst = std::max(worst, -lowest(s.states().pose(1)));
      }
    }
  }
  EXPECT_GT(deepest[1], 2e-3);  // the negative control
  EXPECT_LT(deepest[0], tolerance::sweep_deepest);
}

TEST(Sweep, SlowScenesKeepTheirBitsAndAskNothing) {
  std::uint64_t hash[2];
  for (const Ccd ccd : {Ccd::automatic, Ccd::never}) {
    Scene scene;
    scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
    for (int i = 0; i < 3; ++i)
      scene.add({.shape = Box{{0.4, 0.4, 0.4}},
                 .pose = {.position = {0.01 * i, 0, 0.21 + 0.41 * i}},
                 .ccd = ccd});
    scene.effects.emplace_back(UniformGravity{{0, 0, -9.81}});
    Simulation s(std::move(scene));
    s.advance(1.0);
    EXPECT_EQ(s.report().sweep.sweeps, 0);
    hash[ccd == Ccd::never] = s.state_hash();
  }
  EXPECT_EQ(hash[0], hash[1]);
}

TEST(Sweep, ARestoredFlightHitsWithTheSameBits) {
  Simulation s = shot(Box{{0.01, 4, 4}}, 60, Ccd::automatic, 0.5);
  s.step();
  const std::string saved = s.save();
  const auto run = [&] {
    for (int k = 0; k < 5; ++k) s.step();
    return s.state_hash();
  };
  const std::uint64_t first = run();
  s.restore(saved);
  EXPECT_EQ(run(), first);
}

}  // namespace
}  // namespace carom
