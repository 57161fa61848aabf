// SPDX-License-Identifier: Apache-2.0
// Rolling and spinning resistance, sleep, and what survives save and restore.
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

SimulationOptions with(SolverChoice choice) {
  SimulationOptions options;
  options.contact.choice = choice;
  return options;
}

// A rolling ball under a resisting torque r N: (m + I/R^2) a = r N / R, so a = (5/7) g r / R.
TEST(RollingResistance, StopsABallByTheClosedForm) {
  for (const SolverChoice choice : {SolverChoice::direct, SolverChoice::small_steps}) {
    const double resistance = 0.02, radius = 0.5;
    Scene scene = stage::ground();
    BodyDefinition ball = stage::ball({0, 0, radius}, radius);
    ball.rolling_resistance = resistance;
    ball.velocity = {1, 0, 0};
    ball.angular_velocity = {0, 1 / radius, 0};
    scene.add(ball);
    Simulation simulation(std::move(scene), with(choice));
    simulation.advance(2);
    const double a = 5.0 / 7 * stage::g * resistance / radius;
    // Small steps press the ball a little at first, and their friction lags by one small step.
    const double tolerance = choice == SolverChoice::direct ? 1e-4 : 5e-3;
    EXPECT_NEAR(simulation.states().velocity[1].x(), 1 - 2 * a, tolerance);
    simulation.advance(4);  // it stands after 3.57 s
    EXPECT_LT(simulation.states().velocity[1].norm(), 1e-5);
  }
}

// A ball that spins about the normal: I w' = -s N, so w' = -(5/2) g s / R^2.
TEST(SpinningResistance, SlowsASpinLinearly) {
  const double resistance = 1e-3, radius = 0.5;
  Scene scene = stage::ground();
  BodyDefinition ball = stage::ball({0, 0, radius}, radius);
  ball.spinning_resistance = resistance;
  ball.angular_velocity = {0, 0, 3};
  scene.add(ball);
  Simulation simulation(std::move(scene));
  simulation.advance(1);
  const double slowing = 2.5 * stage::g * resistance / (radius * radius);
  EXPECT_NEAR(simulation.states().angular_velocity(1).z(), 3 - slowing, 1e-5);
}

TEST(RollingResistance, IsInThePlanOnlyWhereAsked) {
  Scene scene = stage::ground();
  scene.add(stage::box({0, 0, 0.25}, 0.5));
  EXPECT_EQ(compile(scene).to_string().find("rolling"), std::string::npos);
  scene.bodies.back().rolling_resistance = 0.01;
  EXPECT_NE(compile(scene).to_string().find("rolling"), std::string::npos);
}

TEST(Sleep, CostsNothingAndEndsWhenTouched) {
  SimulationOptions options;
  options.sleep_after = 0.5;
  Scene scene = stage::tower(5, [](int) { return 1000; });
  BodyDefinition hammer = stage::ball({0, 0, 22}, 0.2);
  scene.add(hammer);  // lands after 2 s
  Simulation simulation(std::move(scene), options);
  simulation.advance(1.5);
  EXPECT_EQ(simulation.report().contact.asleep, 5);
  EXPECT_EQ(simulation.contacts().size(), 0u);
  simulation.advance(0.7);
  EXPECT_EQ(simulation.report().contact.asleep, 0);
  EXPECT_GT(simulation.contacts().size(), 16u);
  simulation.advance(5);
  EXPECT_LT(std::abs(simulation.states().position[5].z() - 2.25), 1e-3);  // the tower still stands
}

TEST(Sleep, EndsByAForce) {
  SimulationOptions options;
  options.sleep_after = 0.5;
  Simulation simulation(stage::tower(1, [](int) { return 1000; }), options);
  simulation.advance(1);
  ASSERT_EQ(simulation.report().contact.asleep, 1);
  simulation.apply_impulse(simulation.scene().bodies[1].id, {125, 0, 0});
  simulation.step();
  EXPECT_GT(simulation.states().velocity[1].x(), 0.5);
}

// Warm starts, recycled manifolds and the choice of solver are part of the state.
TEST(Restore, GoesOnWithTheSameBits) {
  Scene scene = stage::ground();
  for (int i = 0; i < 12; ++i) {
    BodyDefinition body = stage::box({0.3 * (i % 3), 0.27 * (i % 2), 0.4 + 0.6 * i}, 0.5);
    body.pose.orientation = Eigen::Quaterniond(1, 0.1 * i, 0.2, 0.05 * i).normalized();
    scene.add(body);
  }
  Simulation first(scene);
  first.advance(1);
  const std::string bytes = first.save();
  Simulation second(scene);
  second.restore(bytes);
  first.advance(1), second.advance(1);
  EXPECT_EQ(first.state_hash(), second.state_hash());
}

// An hour at 60 Hz with sleep off. A step may be off by the solver's residual, 1e-7 m/s over 1/60
// s, and the weight times that in energy; it must not go the same way in each.
TEST(Rest, LastsAnHour) {
  Scene slope = stage::ground(0.5);
  slope.effects[0] = UniformGravity{{stage::g * std::sin(0.45), 0, -stage::g * std::cos(0.45)}};
  BodyDefinition brick = stage::box({0, 0, 0.1}, 0.2);
  brick.shape = Box{{0.4, 0.3, 0.2}};
  slope.add(brick);  // tan 0.45 = 0.483: it holds by 3 %
  for (const Scene& scene : {stage::tower(3, [](int i) { return i == 2 ? 1e6 : 1e3; }), slope}) {
    Simulation simulation(scene);
    simulation.advance(1);
    double mass = 0, most_rise = 0;
    for (const double m : simulation.states().mass) mass += m;
    const Array3 start = simulation.states().position;
    const double start_energy = stage::mechanical(simulation);
    double energy = start_energy;
    for (int k = 0; k < 216000; ++k) {
      simulation.step();
      const double now = stage::mechanical(simulation);
      most_rise = std::max(most_rise, now - energy);
      energy = now;
    }
    const double of_a_step = mass * stage::g * 1e-7 / 60;
    EXPECT_LT(most_rise, of_a_step);
    EXPECT_LT(energy - start_energy, of_a_step);
    for (int i = 0; i < simulation.size(); ++i)
      EXPECT_LT((simulation.states().position[i] - start[i]).norm(), 1e-6) << i;
    EXPECT_EQ(simulation.report().contact.gave_up, 0);
  }
}

}  // namespace
}  // namespace carom
