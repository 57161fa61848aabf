// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {

void run_pairs(World& world) {
  const BodyStates& s = world.states;
  world.boxes.resize(s.size());
  world.reach.resize(s.size());
  world.sweep.fast.assign(s.size(), 0);
  for (int i = 0; i < s.size(); ++i) {
    const Shape& shape = world.scene.bodies[i].shape;
    // How far any point of the body can get in this step; contacts are looked for that far ahead.
    double reach = s.moves[i] ? world.dt * (s.velocity[i].norm() +
                                            s.angular_velocity(i).norm() * bounding_radius(shape))
                              : 0;
    // Farther ahead than its own thickness a contact is a guess: the sweep finds what it meets.
    if (const double most = tolerance::sweep_share * world.sweep.thickness[i]; reach > most) {
      reach = most;
      world.sweep.fast[i] = world.scene.bodies[i].ccd != Ccd::never;
    }
    world.reach[i] = reach;
    world.boxes[i] = bounds(shape, s.pose(i)).inflated(0.5 * tolerance::contact_margin + reach);
  }
  world.box_tree.update(world.boxes, s.moves);
}

}  // namespace carom
