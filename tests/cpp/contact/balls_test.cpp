// SPDX-License-Identifier: Apache-2.0
// Balls have rows of their own in the small-step solver; they must not have a law of their own.
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

/// A crate of balls that fall, roll and collide. `spinning`: of every ball.
Scene heap(double spinning) {
  Scene scene = stage::ground(0.4);
  for (int i = 0; i < 60; ++i) {
    BodyDefinition ball = stage::ball({0.31 * (i % 4), 0.33 * (i / 4 % 4), 0.2 + 0.35 * (i / 16)},
                                      0.15 + 0.01 * (i % 3));
    ball.spinning_resistance = spinning;
    ball.velocity = {0.3 * (i % 5), -0.2 * (i % 3), 0};
    scene.add(ball);
  }
  return scene;
}

SimulationOptions small_steps() {
  SimulationOptions options;
  options.contact.choice = SolverChoice::small_steps;
  options.contact.substeps = 8;
  return options;
}

// A resistance too small to turn anything sends the same contacts through the rows of patches. One
// step: from then on every hit of a ball on balls doubles what rounding left between the two.
TEST(BallRows, SolveWhatGeneralRowsSolve) {
  Simulation balls(heap(0), small_steps()), general(heap(1e-200), small_steps());
  balls.step(), general.step();
  double worst = 0;
  for (int i = 0; i < balls.size(); ++i) {
    const BodyStates &a = balls.states(), &b = general.states();
    worst = std::max(worst, (a.velocity[i] - b.velocity[i]).norm());
    worst = std::max(worst, (a.angular_velocity(i) - b.angular_velocity(i)).norm());
  }
  EXPECT_GT(balls.contacts().size(), 60u);
  // 8 small steps of 2 passes over some 10 rows of a ball, each rounding speeds of 10 m/s to 1e-15:
  // 160 of them add up to 2e-13 at worst.
  EXPECT_LT(worst, 1e-12);
}

}  // namespace
}  // namespace carom
