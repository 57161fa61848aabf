// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

/// Length of the way of a body that nothing holds is at most this, m: it slows down or speeds up.
double way_bound(const World& world, int i) {
  return world.dt * std::sqrt(std::max(world.velocity_before[i].squaredNorm(),
                                       world.states.velocity[i].squaredNorm()));
}

/// Box of a body and of the surroundings that contacts are looked for in.
Aabb near_box(const World& world, int i) {
  return bounds(world.scene.bodies[i].shape, world.states.pose(i))
      .inflated(0.5 * tolerance::contact_margin + world.reach[i]);
}

/// A round box about where the step takes a body that nothing holds; the near box is within.
Aabb way_ahead(const World& world, int i) {
  const BodyStates& s = world.states;
  const Eigen::Vector3d from = s.position[i];
  const Eigen::Vector3d to = from + 0.5 * world.dt * (world.velocity_before[i] + s.velocity[i]);
  return path_box(world, i, from, to).inflated(0.5 * tolerance::contact_margin + world.reach[i]);
}

/// Of pairs whose ways may cross, those that are near now: contacts are looked for among them.
std::span<const BodyPair> near_ones(World& world, std::span<const BodyPair> pairs) {
  SweepWork& w = world.sweep;
  if (w.ahead == 0 || pairs.empty()) return pairs;
  w.boxed.assign(world.boxes.size(), 0), w.boxes.resize(world.boxes.size());
  const auto near = [&](int i) -> const Aabb& {
    if (!w.fast[i]) return world.boxes[i];
    if (!std::exchange(w.boxed[i], 1)) w.boxes[i] = near_box(world, i);
    return w.boxes[i];
  };
  w.near_pairs.clear();
  for (const BodyPair& pair : pairs)
    if (near(pair.a).overlaps(near(pair.b))) w.near_pairs.push_back(pair);
  return w.near_pairs;
}

/// What contacts need to know of bodies that have a neighbour; the rest goes without.
void make_frames(World& world) {
  const BodyStates& s = world.states;
  world.framed.assign(world.frames.size(), 0);
  for (const BodyPair& pair : world.pairs)
    for (const int i : {pair.a, pair.b})
      if (!std::exchange(world.framed[i], 1)) {
        const Pose pose = s.pose(i);
        world.frames[i] = Frame(pose), world.turns[i] = pose.orientation;
        world.swing[i] =
            s.moves[i] ? world.dt * s.angular_speed(i) * world.sweep.turning_radius[i] : 0;
      }
}

}  // namespace

void run_pairs(World& world) {
  const BodyStates& s = world.states;
  const std::size_t n = s.mass.size();
  world.boxes.resize(n), world.frames.resize(n), world.turns.resize(n);
  world.swing.resize(n), world.reach.resize(n);
  SweepWork& w = world.sweep;
  w.fast.assign(n, 0);
  w.ahead = 0;
  for (int i = 0; i < s.size(); ++i) {
    if (!s.moves[i]) {
      world.reach[i] = 0;
      if (!std::exchange(world.boxed[i], 1)) world.boxes[i] = near_box(world, i);
      continue;
    }
    // How far any point of the body can get in this step; contacts are looked for that far ahead.
    double reach = way_bound(world, i) + turn_bound(world, i) * w.turning_radius[i];
    // Farther ahead than its own thickness a contact is a guess: the sweep finds what it meets.
    if (const double most = tolerance::sweep_share * w.thickness[i]; reach > most) {
      reach = most;
      w.fast[i] = w.ccd[i] != Ccd::never;
    }
    world.reach[i] = reach;
    world.boxes[i] = w.fast[i] ? way_ahead(world, i) : near_box(world, i);
    w.ahead += w.fast[i];
  }
  // One tree serves the contacts and the sweep: what is fast stands in it with its way ahead.
  world.pairs = near_ones(world, world.filter(world.box_tree.update(world.boxes, s.moves)));
  make_frames(world);
}

}  // namespace carom
