// SPDX-License-Identifier: Apache-2.0
// A brick spun about its middle axis tumbles for ever; its angular momentum does not change.
#include <cstdio>

#include "carom/carom.hpp"

int main() {
  carom::Scene scene;
  scene.add({.name = "brick",
             .shape = carom::Box{{0.1, 0.4, 0.9}},
             .mass = 10.0,
             .angular_velocity = {0.1, 5, 0.1}});
  carom::Simulation simulation(scene, {.dt = 1e-3});
  std::printf("%s\n", simulation.plan().to_string().c_str());

  const Eigen::Vector3d L = simulation.angular_momentum();
  const double E = simulation.energy().kinetic;
  for (int second = 0; second < 10; ++second) {
    simulation.advance(1);
    const Eigen::Vector3d omega = simulation.states().angular_velocity(0);
    std::printf("t = %2.0f s  omega = (%6.3f, %6.3f, %6.3f) rad/s  energy error %.1e\n",
                simulation.time(), omega.x(), omega.y(), omega.z(),
                simulation.energy().kinetic / E - 1);
  }
  return (simulation.angular_momentum() - L).norm() <= 1e-12 * L.norm() ? 0 : 1;
}
