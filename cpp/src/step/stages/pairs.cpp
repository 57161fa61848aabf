// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

/// A round box about where the step takes a body that nothing holds.
Aabb way_ahead(const World& world, int i) {
  const BodyStates& s = world.states;
  const Eigen::Vector3d from = s.position[i];
  const Eigen::Vector3d to = from + 0.5 * world.dt * (world.velocity_before[i] + s.velocity[i]);
  Aabb box = path_box(world, i, from, to);
  return box.inflated(0.5 * tolerance::contact_margin);
}

/// Of pairs whose ways may cross, those that are near now: contacts are looked for among them.
std::span<const BodyPair> near_ones(World& world, std::span<const BodyPair> pairs) {
  SweepWork& w = world.sweep;
  if (w.ahead == 0) return pairs;
  const auto near = [&](int i) -> const Aabb& { return w.fast[i] ? w.near[i] : world.boxes[i]; };
  w.near_pairs.clear();
  for (const BodyPair& pair : pairs)
    if (near(pair.a).overlaps(near(pair.b))) w.near_pairs.push_back(pair);
  return w.near_pairs;
}

}  // namespace

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
  SweepWork& w = world.sweep;
  w.fast.assign(n, 0);
  w.near.resize(n);
  w.ahead = 0;
  for (int i = 0; i < s.size(); ++i) {
    const Pose pose = s.pose(i);
    world.frames[i] = Frame(pose);
    // How far any point of the body can get in this step; contacts are looked for that far ahead.
    world.swing[i] = s.moves[i] ? world.dt * s.angular_velocity(i).norm() * world.radius[i] : 0;
    double reach = s.moves[i] ? world.dt * s.velocity[i].norm() + world.swing[i] : 0;
    // Farther ahead than its own thickness a contact is a guess: the sweep finds what it meets.
    if (const double most = tolerance::sweep_share * w.thickness[i]; reach > most) {
      reach = most;
      w.fast[i] = world.scene.bodies[i].ccd != Ccd::never;
    }
    world.reach[i] = reach;
    world.boxes[i] =
        bounds(world.scene.bodies[i].shape, pose).inflated(0.5 * tolerance::contact_margin + reach);
    if (!w.fast[i]) continue;
    ++w.ahead;
    w.near[i] = world.boxes[i];
    world.boxes[i].extend(way_ahead(world, i));
  }
  // One tree serves the contacts and the sweep: what is fast stands in it with its way ahead.
  world.pairs = near_ones(world, world.filter(world.box_tree.update(world.boxes, s.moves)));
}

}  // namespace carom
