// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {

void run_pairs(World& world) {
  const BodyStates& s = world.states;
  const std::size_t n = s.mass.size();
  world.boxes.resize(n), world.frames.resize(n);
  world.swing.resize(n), world.reach.resize(n);
  if (world.radius.size() != n) {  // rows close up when a body goes: all are asked again
    world.radius.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      world.radius[i] = bounding_radius(world.scene.bodies[i].shape);
  }
  world.sweep.fast.assign(n, 0);
  for (int i = 0; i < s.size(); ++i) {
    const Pose pose = s.pose(i);
    world.frames[i] = Frame(pose);
    // How far any point of the body can get in this step; contacts are looked for that far ahead.
    world.swing[i] = s.moves[i] ? world.dt * s.angular_velocity(i).norm() * world.radius[i] : 0;
    double reach = s.moves[i] ? world.dt * s.velocity[i].norm() + world.swing[i] : 0;
    // Farther ahead than its own thickness a contact is a guess: the sweep finds what it meets.
    if (const double most = tolerance::sweep_share * world.sweep.thickness[i]; reach > most) {
      reach = most;
      world.sweep.fast[i] = world.scene.bodies[i].ccd != Ccd::never;
    }
    world.reach[i] = reach;
    world.boxes[i] =
        bounds(world.scene.bodies[i].shape, pose).inflated(0.5 * tolerance::contact_margin + reach);
  }
  world.pairs = world.filter(world.box_tree.update(world.boxes, s.moves));
}

}  // namespace carom
