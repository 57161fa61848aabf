// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {

void run_pairs(World& world) {
  const BodyStates& s = world.states;
  world.boxes.resize(s.size());
  world.reach.resize(s.size());
  for (int i = 0; i < s.size(); ++i) {
    const Shape& shape = world.scene.bodies[i].shape;
    // How far any point of the body can get in this step; contacts are looked for that far ahead.
    world.reach[i] = s.moves[i] ? world.dt * (s.velocity[i].norm() +
                                              s.angular_velocity(i).norm() * bounding_radius(shape))
                                : 0;
    world.boxes[i] =
        bounds(shape, s.pose(i)).inflated(0.5 * tolerance::contact_margin + world.reach[i]);
  }
  world.box_tree.update(world.boxes, s.moves);
}

}  // namespace carom
