// SPDX-License-Identifier: Apache-2.0
// What sleeps takes no part in a step, and wakes by whatever could move it: a hit, a force, the
// loss of its support, a body put down on it.
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

/// Two towers of four, far apart: two islands. Asleep after a second.
Simulation asleep() {
  Scene scene = stage::ground();
  for (const double x : {0.0, 5.0})
    for (int i = 0; i < 4; ++i) scene.add(stage::box({x, 0, 0.25 + 0.5 * i}, 0.5));
  SimulationOptions options;
  options.sleep_after = 0.5;
  Simulation simulation(std::move(scene), options);
  simulation.advance(1);
  return simulation;
}

TEST(Sleep, LeavesNothingToSolve) {
  Simulation simulation = asleep();
  ASSERT_EQ(simulation.report().contact.asleep, 8);
  const std::int64_t iterations = simulation.report().contact.iterations;
  const Array3 before = simulation.states().position;
  simulation.advance(10);
  EXPECT_EQ(simulation.report().contact.iterations, iterations);
  EXPECT_EQ(simulation.contacts().size(), 0u);
  for (const Stage& stage : simulation.plan().stages)
    if (stage.on && stage.kind == StageKind::integrate) {
      EXPECT_EQ(simulation.plan().movers.size(), 0u);
    }
  for (int i = 0; i < simulation.size(); ++i) EXPECT_EQ(simulation.states().position[i], before[i]);
}

TEST(Sleep, IsPerIsland) {
  Simulation simulation = asleep();
  simulation.apply_impulse(simulation.scene().bodies[4].id, {1, 0, 0});  // top of the first tower
  simulation.step();
  EXPECT_EQ(simulation.report().contact.asleep, 4);
  for (int i = 5; i <= 8; ++i) EXPECT_FALSE(simulation.states().moves[i]);
  simulation.advance(2);
  EXPECT_EQ(simulation.report().contact.asleep, 8);  // and it falls asleep again
}

TEST(Sleep, EndsByTheLossOfItsSupport) {
  Simulation simulation = asleep();
  simulation.remove(simulation.scene().bodies[1].id);  // the lowest of the first tower
  simulation.advance(0.2);
  // Free fall of 0.196 m, less a step that it may take to notice.
  EXPECT_NEAR(simulation.states().position[1].z(), 0.75 - stage::g * 0.02,
              stage::g * 0.2 / 60 + 1e-3);
  simulation.advance(3);
  EXPECT_NEAR(simulation.states().position[1].z(), 0.25, 1e-3);
}

TEST(Sleep, EndsWhenItsSupportIsMovedAway) {
  Simulation simulation = asleep();
  simulation.set_state(simulation.scene().bodies[1].id, {.position = {2.5, 0, 0.25}},
                       Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  simulation.advance(3);
  EXPECT_NEAR(simulation.states().position[2].z(), 0.25, 1e-3);
}

TEST(Sleep, EndsByATorqueAndAHeldWrench) {
  for (const bool held : {false, true}) {
    Simulation simulation = asleep();
    const BodyId top = simulation.scene().bodies[4].id;
    if (held)
      simulation.hold_wrench({.body = top, .force = {2000, 0, 0}});
    else
      simulation.apply_angular_impulse(top, {0, 0, 20});
    simulation.step();  // friction stops the spin within 0.1 s
    const double speed = held ? simulation.states().velocity[4].norm()
                              : simulation.states().angular_velocity(4).norm();
    EXPECT_GT(speed, 0.01) << held;
  }
}

TEST(Sleep, EndsWhereABodyIsAddedOnTop) {
  Simulation simulation = asleep();
  simulation.add(stage::box({0, 0, 2.25}, 0.5, 1e6));
  simulation.advance(0.1);
  EXPECT_EQ(simulation.report().contact.asleep, 4);
  simulation.advance(3);
  EXPECT_NEAR(simulation.states().position[9].z(), 2.25, 1e-3);  // and carries it
}

// A body that flies past must not wake what it does not touch.
TEST(Sleep, IsNotEndedByWhatPassesBy) {
  Simulation simulation = asleep();
  BodyDefinition ball = stage::ball({2.5, -5, 0.5}, 0.2);
  ball.velocity = {0, 5, 2};
  simulation.add(ball);
  for (int k = 0; k < 60; ++k) {
    simulation.step();
    ASSERT_EQ(simulation.report().contact.asleep, 8) << k;
  }
}

TEST(Sleep, EndsWhereTheGroundIsTakenAway) {
  Simulation simulation = asleep();
  const BodyId ground = simulation.scene().bodies[0].id;
  const double top = simulation.states().position[4].z();
  simulation.set_state(ground, {.position = {0, 0, -1}}, Eigen::Vector3d::Zero(),
                       Eigen::Vector3d::Zero());
  simulation.advance(0.4);
  EXPECT_EQ(simulation.report().contact.asleep, 0);
  EXPECT_NEAR(simulation.states().position[4].z(), top - 0.5 * stage::g * 0.16, 1e-9);  // free fall
}

TEST(Sleep, LetsTimeGoOnAndNothingElse) {
  Simulation simulation = asleep();
  const Array3 before = simulation.states().position;
  const double time = simulation.time();
  const Report report = simulation.advance(1);
  EXPECT_NEAR(simulation.time(), time + 1, 1e-12);
  EXPECT_EQ(report.steps, 60);
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(simulation.report().contact.asleep, 8);
  for (int i = 0; i < simulation.size(); ++i) EXPECT_EQ(simulation.states().position[i], before[i]);
}

}  // namespace
}  // namespace carom
