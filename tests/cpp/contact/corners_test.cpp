// SPDX-License-Identifier: Apache-2.0
// Bodies held by several faces at once, more than equilibrium needs.
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

constexpr double step = 1.0 / 60;

/// Three planes at right angles that stand on their common corner, and a ball dropped into it.
Simulation in_a_corner(double friction, SolverChoice choice) {
  Scene scene;
  scene.effects.emplace_back(UniformGravity{});
  for (int k = 0; k < 3; ++k) {
    const double a = 2 * M_PI * k / 3, s = std::sqrt(2.0 / 3);
    BodyDefinition face;
    face.shape = Plane{{s * std::cos(a), s * std::sin(a), std::sqrt(1.0 / 3)}, 0};
    face.is_static = true;
    face.friction = friction;
    scene.add(face);
  }
  BodyDefinition ball = stage::ball({0.1, 0.05, 1}, 0.2);
  ball.friction = friction;
  scene.add(ball);
  SimulationOptions options;
  options.contact.choice = choice;
  return Simulation(std::move(scene), options);
}

// Each plane carries m g / sqrt(3); the centre is r sqrt(3) above the corner. The direct solver
// knows no sink; a soft contact sinks by its closed form, F / (m (2 pi 120 Hz)^2) = 1e-5 m.
TEST(BallInACorner, RestsOnThreePlanesAlike) {
  for (const SolverChoice choice : {SolverChoice::automatic, SolverChoice::small_steps}) {
    Simulation simulation = in_a_corner(0, choice);
    const double allowed = choice == SolverChoice::automatic ? 1e-6 : 2e-5;
    double before = stage::mechanical(simulation);
    for (int k = 0; k < 600; ++k) {
      simulation.step(step);
      const double now = stage::mechanical(simulation);
      ASSERT_LE(now - before, stage::energy_of_a_step(simulation, step)) << k;
      before = now;
    }
    const Eigen::Vector3d x = simulation.states().position[3];
    EXPECT_LT((x - Eigen::Vector3d(0, 0, 0.2 * std::sqrt(3.0))).norm(), allowed);
    const double each = simulation.states().mass[3] * stage::g * step / std::sqrt(3.0);
    double share[3] = {0, 0, 0};
    for (const Contact& c : simulation.contacts()) share[c.a] += c.impulse.dot(c.normal);
    for (const double s : share) EXPECT_NEAR(s, each, 1e-4 * each);
  }
}

// With friction the share of each plane is not determined; their sum is.
TEST(BallInACorner, RestsWithFriction) {
  Simulation simulation = in_a_corner(0.3, SolverChoice::automatic);
  for (int k = 0; k < 900; ++k) simulation.step(step);
  EXPECT_LT(simulation.states().velocity[3].norm(), 1e-6);
  EXPECT_NEAR(simulation.states().position[3].z(), 0.2 * std::sqrt(3.0), 1e-6);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Contact& c : simulation.contacts()) sum += c.impulse;
  const double weight = simulation.states().mass[3] * stage::g * step;
  EXPECT_LT((sum - Eigen::Vector3d(0, 0, weight)).norm(), 1e-4 * weight);
}

// Four points where three would do, the cube turned to any angle: the same force on each.
TEST(CubeOnFourCorners, SharesItsWeightAlikeAtAnyAngle) {
  for (const double angle : {0.0, 0.3, M_PI / 4, 1.1}) {
    Scene scene = stage::ground();
    BodyDefinition cube = stage::box({0.3, -0.2, 0.25}, 0.5);
    cube.pose.orientation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
    scene.add(cube);
    SimulationOptions options;
    options.contact.choice = SolverChoice::direct;
    Simulation simulation(std::move(scene), options);
    for (int k = 0; k < 120; ++k) simulation.step(step);
    ASSERT_EQ(simulation.contacts().size(), 4u);
    const double each = 125 * stage::g * step / 4;
    double least = INFINITY, most = 0;
    for (const Contact& c : simulation.contacts()) {
      least = std::min(least, c.impulse.z()), most = std::max(most, c.impulse.z());
      // The residual of 1e-7 m/s times a quarter of the mass.
      EXPECT_NEAR(c.impulse.z(), each, 125 * 1e-7 / 4) << angle;
      EXPECT_LT(c.impulse.head<2>().norm(), 1e-9 * each) << angle;
    }
    // What makes them equal is the solver's stiffness of 1e4: it takes the rounding of the gaps,
    // some u of 0.5 m in a step of 1/60 s, to 1e4 * 60 * 1e-16 = 6e-11 of a speed of 1 m/s.
    EXPECT_LT(most - least, 3e-10 * each) << angle;
  }
}

/// A box in a V of two planes at 45 degrees: each face carries m g / sqrt(2) over four points.
TEST(BoxInAGroove, SharesItsWeightAlike) {
  Scene scene;
  scene.effects.emplace_back(UniformGravity{});
  for (const int side : {-1, 1}) {
    BodyDefinition face;
    face.shape = Plane{{side * std::sqrt(0.5), 0, std::sqrt(0.5)}, 0};
    face.is_static = true;
    face.friction = 0;
    scene.add(face);
  }
  BodyDefinition box = stage::box({0, 0, 0.25 * std::sqrt(2.0)}, 0.5);
  box.pose.orientation = Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitY());
  box.friction = 0;
  scene.add(box);
  Simulation simulation(std::move(scene));
  for (int k = 0; k < 300; ++k) simulation.step(step);
  double share[2] = {0, 0};
  for (const Contact& c : simulation.contacts()) share[c.a] += c.impulse.dot(c.normal);
  const double each = 125 * stage::g * step / std::sqrt(2.0);
  for (const double s : share) EXPECT_NEAR(s, each, 1e-6 * each);
  EXPECT_LT(simulation.states().velocity[2].norm(), 1e-6);
}

}  // namespace
}  // namespace carom
