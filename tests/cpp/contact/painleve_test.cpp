// SPDX-License-Identifier: Apache-2.0
// A thin rod dragged over rough ground: above mu = 4/3 there are attitudes in which sliding
// friction presses the tip down harder than any normal force can lift it (Painleve's paradox), and
// its two moments differ by 1250, so that a small error of attitude is a large one of energy.
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

struct Drag {
  double friction, angle, speed;
};

void expect_it_settles(const Drag& drag, SolverChoice choice) {
  const double length = 1, width = 0.02, dt = 1.0 / 60;  // m, m, s
  Scene scene = stage::ground(drag.friction);
  BodyDefinition rod;
  rod.shape = Box{{width, width, length}};
  rod.friction = drag.friction;
  rod.pose.position.z() = 0.5 * (length * std::cos(drag.angle) + width * std::sin(drag.angle));
  rod.pose.orientation = Eigen::AngleAxisd(drag.angle, Eigen::Vector3d::UnitY());
  rod.velocity.x() = drag.speed;
  scene.add(rod);
  SimulationOptions options;
  options.contact.choice = choice;
  Simulation simulation(std::move(scene), options);
  const double start = stage::mechanical(simulation);
  double before = start;
  for (int k = 0; k < 180; ++k) {
    simulation.step(dt);
    const double now = stage::mechanical(simulation);
    ASSERT_LE(now - before, stage::energy_of_a_step(simulation, dt)) << "step " << k;
    before = now;
  }
  // It lies on its side: a lying rod has its centre half a width up.
  EXPECT_LT(simulation.states().position[1].z(), width);
  EXPECT_LT(before, 0.1 * start);
}

TEST(PainleveRod, LosesEnergyUntilItLies) {
  for (const double friction : {0.5, 1.0, 1.5, 2.0, 3.0})
    for (int k = 1; k <= 14; ++k)
      for (const double speed : {-5.0, 5.0})
        for (const SolverChoice choice : {SolverChoice::automatic, SolverChoice::small_steps}) {
          SCOPED_TRACE(testing::Message()
                       << "mu " << friction << ", " << 0.1 * k << " rad from upright, " << speed
                       << " m/s, solver " << static_cast<int>(choice));
          expect_it_settles({friction, 0.1 * k, speed}, choice);
        }
}

}  // namespace
}  // namespace carom
