// SPDX-License-Identifier: Apache-2.0
#include "step/world.hpp"

namespace carom {

void run_gravity(World& world) {
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  for (const Effect& effect : world.scene.effects)
    if (const auto* gravity = std::get_if<UniformGravity>(&effect)) g += gravity->acceleration;
  const Eigen::Vector3d kick = world.dt * g;
  for (const int i : world.plan.movers)
    world.states.velocity.set(i, world.states.velocity[i] + kick);
}

}  // namespace carom
