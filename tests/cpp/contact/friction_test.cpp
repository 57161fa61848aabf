// SPDX-License-Identifier: Apache-2.0
// Closed forms of Coulomb friction (accuracy.md, small analytic cases).
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

/// A brick on ground tilted by `angle`: gravity is tilted instead, which is the same thing.
Simulation on_slope(double angle, double friction) {
  Scene scene = stage::ground(friction);
  scene.effects[0] = UniformGravity{{stage::g * std::sin(angle), 0, -stage::g * std::cos(angle)}};
  BodyDefinition brick = stage::box({0, 0, 0.1}, 0.2);
  brick.shape = Box{{0.4, 0.4, 0.2}};
  brick.friction = friction;
  scene.add(brick);
  return Simulation(std::move(scene));
}

constexpr double angle = M_PI / 6;

TEST(Slope, HoldsAMillionthBelowTheLimit) {
  Simulation simulation = on_slope(angle, std::tan(angle) * (1 + 1e-6));
  for (int k = 0; k < 60; ++k) simulation.step(1.0 / 60);
  const double x = simulation.states().position[1].x();
  for (int k = 0; k < 600; ++k) simulation.step(1.0 / 60);
  EXPECT_LT(std::abs(simulation.states().position[1].x() - x) / 10, 1e-9);  // m/s, the mark
}

TEST(Slope, SlidesAMillionthAboveTheLimit) {
  const double mu = std::tan(angle) * (1 - 1e-6);
  Simulation simulation = on_slope(angle, mu);
  for (int k = 0; k < 600; ++k) simulation.step(1.0 / 60);
  const double a = stage::g * (std::sin(angle) - mu * std::cos(angle));  // 4.9e-6 m/s^2
  // The residual of 1e-7 m/s may act once on the way from sticking to sliding.
  EXPECT_NEAR(simulation.states().velocity[1].x(), 10 * a, 2e-7);
}

TEST(Slope, SlidesWithTheClosedFormAcceleration) {
  const double mu = 0.3;
  Simulation simulation = on_slope(angle, mu);
  for (int k = 0; k < 60; ++k) simulation.step(1.0 / 60);
  const double a = stage::g * (std::sin(angle) - mu * std::cos(angle));
  // Constant forces: the mean velocity makes every step exact but for the residual, 1e-5 m/s at
  // most.
  EXPECT_NEAR(simulation.states().velocity[1].x(), a, 1e-5);
  EXPECT_NEAR(simulation.states().position[1].x(), 0.5 * a, 1e-5);
}

TEST(Sliding, StopsWhereTheClosedFormSays) {
  for (const double dt : {1.0 / 60, 1.0 / 240}) {
    Scene scene = stage::ground(0.4);
    BodyDefinition cube = stage::box({0, 0, 0.1}, 0.2);
    cube.friction = 0.4;
    cube.velocity = {0.6, 0.8, 0};  // a pyramid instead of the cone would turn it
    scene.add(cube);
    Simulation simulation(std::move(scene), {.dt = dt});
    simulation.advance(1);
    const Eigen::Vector3d x = simulation.states().position[1];
    const double way = 1 / (2 * 0.4 * stage::g);
    // Only the step in which it stops is not exact: half of it at the speed it has left.
    const double last = 0.4 * stage::g * dt * dt / 2;
    EXPECT_NEAR(x.head<2>().norm(), way, last + 1e-6);
    EXPECT_NEAR(x.y() / x.x(), 0.8 / 0.6, 1e-4);
    EXPECT_LT(simulation.states().velocity[1].norm(), 1e-7);
  }
}

TEST(Rolling, StartsAtFiveSeventhsOfTheSpeed) {
  Scene scene = stage::ground(0.3);
  BodyDefinition ball = stage::ball({0, 0, 0.5}, 0.5);
  ball.friction = 0.3;
  ball.velocity = {2, 1, 0};
  scene.add(ball);
  Simulation simulation(std::move(scene));
  simulation.advance(2);  // slides for 2 v / (7 mu g) = 0.217 s
  const Eigen::Vector3d v = simulation.states().velocity[1];
  // L = I w + m r x v about the contact is kept: 5/7 exactly, to the residual of each sliding step.
  EXPECT_NEAR(v.x(), 10.0 / 7, 2e-5);
  EXPECT_NEAR(v.y(), 5.0 / 7, 2e-5);
  const Eigen::Vector3d w = simulation.states().angular_velocity(1);
  EXPECT_NEAR(w.y() * 0.5, v.x(), 1e-6);  // rolls
}

TEST(Rolling, OnASlopeAcceleratesByFiveSevenths) {
  Scene scene = stage::ground(0.5);
  scene.effects[0] = UniformGravity{{stage::g * std::sin(angle), 0, -stage::g * std::cos(angle)}};
  BodyDefinition ball = stage::ball({0, 0, 0.5}, 0.5);
  scene.add(ball);
  Simulation simulation(std::move(scene));
  simulation.advance(1);
  const double a = 5.0 / 7 * stage::g * std::sin(angle);
  EXPECT_NEAR(simulation.states().velocity[1].x(), a, 1e-5);
  EXPECT_NEAR(simulation.states().position[1].x(), 0.5 * a, 1e-4);
}

// Four corners carry a cube alike, though three would do.
TEST(CubeOnFourCorners, SharesItsWeightAlike) {
  Scene scene = stage::ground();
  scene.add(stage::box({0, 0, 0.25}, 0.5));
  Simulation simulation(std::move(scene));
  for (int k = 0; k < 120; ++k) simulation.step(1.0 / 60);
  ASSERT_EQ(simulation.contacts().size(), 4u);
  const double each = 125 * stage::g / 60 / 4;
  for (const Contact& c : simulation.contacts()) EXPECT_NEAR(c.impulse.z(), each, 1e-6 * each);
}

}  // namespace
}  // namespace carom
