// SPDX-License-Identifier: Apache-2.0
// The lecture's repulsion in a simulation: what it adds, with and without the bound, and which
// normals a particle inside a distance grid was given.
#include <cmath>

#include <gtest/gtest.h>

#include "carom/geometry/sdf.hpp"
#include "carom/numerics/invalid_input.hpp"
#include "carom/step/simulation.hpp"

using namespace carom;
using Eigen::Vector3d;

namespace {

constexpr double dt = 1.0 / 60;

// Speeds of a few m/s through some ten operations of one step, and sweeps that end at 1e-9
// (tolerance::repulsion_settled) of the largest.
constexpr double settled = 1e-8;

/// A ball of 1 kg, its lowest point `depth` under the plane, no gravity.
Scene sunk_ball(double depth, std::optional<Repulsion> repulsion, Vector3d velocity = {0, 0, 0}) {
  Scene scene;
  scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
  scene.add({.name = "ball",
             .shape = Sphere{0.5},
             .mass = 1.0,
             .pose = {.position = {0, 0, 0.5 - depth}},
             .velocity = velocity});
  if (repulsion) scene.effects.emplace_back(*repulsion);
  return scene;
}

Shape cube_grid() {
  const auto distance = [](const Vector3d& p) {
    const Vector3d q = p.cwiseAbs() - Vector3d::Constant(0.5);
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  };
  return Sdf{std::make_shared<const SdfGrid>(
      SdfGrid::from_function(distance, {Vector3d::Constant(-0.5), Vector3d::Constant(0.5)}, 0.02))};
}

/// One particle that came through the top of a cube in the last step, nearer to its side.
Scene corner(bool chain, Ccd ccd = Ccd::automatic) {
  Scene scene;
  scene.add({.name = "cube", .shape = cube_grid(), .is_static = true});
  TriangleMesh::Vertices one = TriangleMesh::Vertices::Zero(1, 3);
  scene.add({.name = "particle",
             .shape = ParticleSet{one, 0.01},
             .mass = 0.1,
             .pose = {.position = {0.3, 0.013, 0.25}},
             .velocity = {0, 0, -0.35 / dt},
             .friction = 0,
             .ccd = ccd});
  scene.effects.emplace_back(Repulsion{.interior_normals = chain});
  return scene;
}

}  // namespace

TEST(Repulsion, UnboundedAddsTheLecturesSpeedAndItsEnergyIsInTheLedger) {
  Simulation simulation(sunk_ball(0.1, Repulsion{.bounded = false}));
  const double balance = simulation.energy().balance();
  simulation.step(dt);
  // dv = 0.1 m / (1/60 s) = 6 m/s, so 18 J on 1 kg; the ball is just clear after the step.
  const Energy energy = simulation.energy();
  EXPECT_NEAR(simulation.states().velocity[1].z(), 6, settled);
  EXPECT_NEAR(simulation.states().position[1].z(), 0.5, settled);
  EXPECT_NEAR(energy.repulsion, 18, 18 * settled);
  EXPECT_NEAR(energy.kinetic, 18, 18 * settled);
  EXPECT_NEAR(energy.balance(), balance, 18 * settled);
  EXPECT_EQ(simulation.report().repulsion.pushed, 1);
  EXPECT_NEAR(simulation.report().repulsion.fastest, 6, settled);
}

TEST(Repulsion, BoundedLeavesAtItsCapAndAddsOnlyWhatItLacks) {
  Simulation simulation(sunk_ball(0.1, Repulsion{.cap = 1.0}));
  simulation.step(dt);
  EXPECT_NEAR(simulation.states().velocity[1].z(), 1, settled);
  EXPECT_NEAR(simulation.energy().repulsion, 0.5, settled);
  // One that leaves at 0.75 m/s gets the other quarter: (1 - 0.75^2) / 2.
  Simulation leaving(sunk_ball(0.1, Repulsion{.cap = 1.0}, {0, 0, 0.75}));
  leaving.step(dt);
  EXPECT_NEAR(leaving.energy().repulsion, 0.5 * (1 - 0.5625), settled);
  // The lecture's very weak repulsion, pushing just clear: a small cap.
  Simulation weak(sunk_ball(0.1, Repulsion{.cap = 0.01}));
  weak.step(dt);
  EXPECT_NEAR(weak.energy().repulsion, 0.5e-4, settled);
}

TEST(Repulsion, WithoutItOverlapsAreUndoneAndNoSpeedIsAdded) {
  Simulation simulation(sunk_ball(0.1, {}));
  simulation.advance(1.0);
  // Left to itself the ball comes out, and what it keeps of the push is below the speed at which
  // soft contacts are called still, 1 mm/s.
  EXPECT_GT(simulation.states().position[1].z(), 0.5 - 1e-3);
  EXPECT_LT(simulation.states().velocity[1].norm(), 1e-3);
  EXPECT_EQ(simulation.energy().repulsion, 0);
  EXPECT_EQ(simulation.report().repulsion.pushed, 0);
  EXPECT_FALSE(simulation.plan().runs(StageKind::repulsion));
}

TEST(Repulsion, ABoxOnFourPointsGetsOnePushNotFour) {
  Scene scene;
  scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
  scene.add({.name = "box", .shape = Box{}, .mass = 2.0, .pose = {.position = {0, 0, 0.45}}});
  scene.effects.emplace_back(Repulsion{.bounded = false});
  Simulation simulation(scene);
  simulation.step(dt);
  EXPECT_NEAR(simulation.states().velocity[1].z(), 3, settled);  // 0.05 m in a step
  EXPECT_NEAR(simulation.states().angular_velocity(1).norm(), 0, 10 * settled);
  EXPECT_NEAR(simulation.energy().repulsion, 9, 9 * settled);
  EXPECT_EQ(simulation.report().repulsion.capped, 0);
  EXPECT_EQ(simulation.report().repulsion.pushed, 4);
}

TEST(Repulsion, RubsByTheFrictionOfThePush) {
  Scene scene = sunk_ball(0.1, Repulsion{.bounded = false}, {20, 0, 0});
  scene.bodies[0].friction = scene.bodies[1].friction = 0.5;
  Simulation simulation(scene);
  simulation.step(dt);
  // The push is 6 N s; friction takes mu times that from the slide: 3 m/s of 20.
  EXPECT_NEAR(simulation.states().velocity[1].x(), 17, settled * 20);
  const Energy energy = simulation.energy();
  EXPECT_NEAR(energy.repulsion, 18, 18 * settled);
  EXPECT_NEAR(energy.balance(), 0.5 * 400, 200 * settled);
}

TEST(Repulsion, ConservesMomentumBetweenTwoBodies) {
  Scene scene;
  scene.add({.name = "a", .shape = Sphere{0.5}, .mass = 1.0});
  scene.add({.name = "b", .shape = Sphere{0.5}, .mass = 3.0, .pose = {.position = {0.6, 0.7, 0}}});
  scene.effects.emplace_back(Repulsion{.bounded = false});
  Simulation simulation(scene);
  simulation.step(dt);
  const double depth = 1 - std::hypot(0.6, 0.7);
  const Vector3d apart = simulation.states().velocity[1] - simulation.states().velocity[0];
  EXPECT_NEAR(apart.norm(), depth / dt, settled);
  EXPECT_NEAR(simulation.momentum().norm(), 0, settled);
  // Reduced mass 3/4 kg.
  EXPECT_NEAR(simulation.energy().repulsion, 0.375 * std::pow(depth / dt, 2), settled * 10);
}

class InteriorNormals : public ::testing::TestWithParam<Ccd> {};

TEST_P(InteriorNormals, LeaveACornerByTheFaceTheParticleCameThrough) {
  Simulation simulation(corner(true, GetParam()));  // the sweep leaves what lies inside to them
  simulation.step(dt);
  EXPECT_EQ(simulation.report().repulsion.swept_hit, 1);
  EXPECT_EQ(simulation.report().repulsion.gradient, 0);
  ASSERT_FALSE(simulation.contacts().empty());
  // From the cube up to the particle; 1e-6 is what the gradient of a grid is good to on the flat of
  // a face, ten cells from its edge (see interior_normal_test).
  EXPECT_NEAR(simulation.contacts()[0].normal.z(), 1, 1e-6);
  const Report rest = simulation.advance(0.2);
  EXPECT_GT(rest.repulsion.kept + rest.repulsion.swept_hit, 0);  // inside for some steps more
  EXPECT_EQ(rest.repulsion.gradient, 0);
  EXPECT_GT(simulation.states().position[1].z(), 0.5);
  EXPECT_NEAR(simulation.states().position[1].x(), 0.3, 1e-6);  // never sideways
}

INSTANTIATE_TEST_SUITE_P(Followed, InteriorNormals,
                         ::testing::Values(Ccd::never, Ccd::automatic, Ccd::always));

TEST(PlainGradient, LeavesByTheWrongFace) {
  Simulation simulation(corner(false));
  simulation.advance(0.2);
  // Negative control: out through the side, 0.2 m away, 0.25 m under the top it came through.
  EXPECT_GT(simulation.states().position[1].x(), 0.5);
  EXPECT_EQ(simulation.report().repulsion.swept_hit, 0);
}

TEST(Repulsion, IsRefusedWithoutASpeed) {
  Scene scene = sunk_ball(0.1, Repulsion{.cap = 0});
  EXPECT_THROW(Simulation{scene}, InvalidInput);
}

TEST(Repulsion, IsPartOfASavedState) {
  Simulation simulation(sunk_ball(0.1, Repulsion{.bounded = false}));
  simulation.step(dt);
  Simulation again(sunk_ball(0.1, Repulsion{.bounded = false}));
  again.restore(simulation.save());
  EXPECT_EQ(again.energy().repulsion, simulation.energy().repulsion);
  simulation.advance(0.1), again.advance(0.1);
  EXPECT_EQ(again.state_hash(), simulation.state_hash());
}
