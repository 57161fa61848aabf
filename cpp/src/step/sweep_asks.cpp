// SPDX-License-Identifier: Apache-2.0
// Which two paths are followed to their meeting, and which need no look.
#include <algorithm>
#include <cmath>
#include <limits>

#include "carom/numerics/tolerance.hpp"

#include "step/sweep.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

Motion motion_of(const World& world, int i, double t) {
  const BodyPath& path = world.sweep.paths[i];
  const Eigen::Vector3d from = path.centre_at(t);
  return {from, path.centre_at(world.dt) - from, (world.dt - t) * path.arc_at(t).rate};
}

/// Pairs whose contacts the solver has, and those that were far apart, need no look while they move
/// little against each other; a body that was hit may have come near others since, and be thrown
/// through what it rests on, where that is thinner than it moves.
bool goes_without(const World& world, int a, int b, double t) {
  const SweepWork& w = world.sweep;
  const Motion of_a = motion_of(world, a, t), of_b = motion_of(world, b, t);
  const BodyPair pair{a, b};
  if (std::ranges::binary_search(w.kept, pair) && !std::ranges::binary_search(w.free, pair) &&
      stays_apart(world, a, b, t))
    return true;
  if (is_fast(world, a, b, of_a, of_b)) return false;
  const bool was_hit = w.version[a] != 0 || w.version[b] != 0;
  if (std::ranges::binary_search(w.kept, pair))
    return !was_hit || !(std::ranges::binary_search(w.free, pair) ||
                         (of_b.way - of_a.way).norm() >
                             std::min(w.thickness[a], w.thickness[b]) + tolerance::sweep_deepest);
  return !was_hit && !std::ranges::binary_search(w.left, pair);
}

void ask(World& world, int a, int b, double t) {
  if (!world.filter.meet(a, b)) return;
  SweepWork& w = world.sweep;
  need_path(world, a), need_path(world, b);
  if (goes_without(world, a, b, t)) return;
  const Scene::Body &body_a = world.scene.bodies[a], &body_b = world.scene.bodies[b];
  SweepReport& report = world.report.sweep;
  double thin = std::numeric_limits<double>::infinity();
  for (const int row : {a, b})
    if (world.states.moves[row] && w.thickness[row] > 0) thin = std::min(thin, w.thickness[row]);
  const double deepest = std::min(tolerance::sweep_deepest, tolerance::sweep_deepest_share * thin);
  const FirstContact found =
      first_contact(body_a.shape, w.paths[a], body_b.shape, w.paths[b], t, world.dt, deepest);
  ++report.sweeps;
  report.queries += found.queries;
  report.smallest_gap = std::min(report.smallest_gap, found.gap);
  if (found.status == FirstContact::Status::clear) return;
  w.events.push_back({found, a, b, w.version[a], w.version[b]});
  std::push_heap(w.events.begin(), w.events.end());
}

const Aabb& box_of_path(World& world, int i) {
  SweepWork& w = world.sweep;
  if (!w.boxed[i]) w.boxes[i] = path_bounds(world, i), w.boxed[i] = 1;
  return w.boxes[i];
}

/// Whether the balls about two bodies come together: seen from a, b goes along a chord that its
/// true way leaves by no more than the bulge of both.
bool balls_meet(const World& world, int a, int b) {
  const SweepWork& w = world.sweep;
  const BodyStates& s = world.states;
  const Eigen::Vector3d from = w.position_before[b] - w.position_before[a];
  const Eigen::Vector3d way = s.position[b] - s.position[a] - from;
  const double bulge = 0.25 * (world.dt * (s.velocity[b] - s.velocity[a]) - way).norm();
  const double share = std::clamp(-from.dot(way) / way.squaredNorm(), 0.0, 1.0);
  const double least = (from + (share > 0 ? share : 0) * way).norm();
  return !(least > w.radius[a] + w.radius[b] + tolerance::sweep_clear + bulge);
}

}  // namespace

bool is_fast(const World& world, int a, int b, const Motion& of_a, const Motion& of_b) {
  const SweepWork& w = world.sweep;
  double thin = std::numeric_limits<double>::infinity();
  for (const int row : {a, b}) {
    if (!world.states.moves[row]) continue;
    if (w.ccd[row] == Ccd::always) return true;
    thin = std::min(thin, w.thickness[row]);
  }
  const auto swing = [&](int row, const Motion& of) {  // a plane reaches for ever and never turns
    return world.states.moves[row] ? of.turn.norm() * w.turning_radius[row] : 0.0;
  };
  double far = (of_b.way - of_a.way).norm() + swing(a, of_a) + swing(b, of_b);
  // As seen from a body that turns little, what turns with it stands still.
  const double common = (of_b.way - of_a.way - of_a.turn.cross(of_b.centre - of_a.centre)).norm() +
                        (of_b.turn - of_a.turn).norm() * w.turning_radius[b];
  if (world.states.moves[a] && world.states.moves[b] && of_a.turn.norm() < tolerance::small_turn)
    far = std::min(far, common);
  return far > tolerance::sweep_share * thin || turns_through(world, a, b, of_a.turn, of_b.turn);
}

void foresee(World& world) {
  SweepWork& w = world.sweep;
  const BodyStates& s = world.states;
  // What nothing held, slowed or pushed apart went the way that stands there already.
  const bool free = !world.plan.runs(StageKind::drag) && !world.plan.runs(StageKind::repulsion);
  const bool solved = world.plan.runs(StageKind::solve);
  bool grown = false;
  for (const int i : world.plan.movers) {
    if (free && !(solved && world.solver.motion().decided[i])) continue;
    const Eigen::Vector3d way = s.position[i] - w.position_before[i];
    const double bulge = 0.25 * (world.dt * s.velocity[i] - way).norm();
    const double reach = world.reach[i] + 0.5 * tolerance::contact_margin;
    if (way.norm() + turn_bound(world, i) * w.turning_radius[i] + bulge <= reach) continue;
    const Aabb& box = box_of_path(world, i);
    if (world.boxes[i].contains(box)) continue;
    world.boxes[i].extend(box);
    grown = true;
  }
  if (grown) static_cast<void>(world.box_tree.update(world.boxes, s.moves));
}

void ask_all(World& world) {
  SweepWork& w = world.sweep;
  for (const BodyPair& pair : world.box_tree.pairs())
    if ((w.fast[pair.a] || w.fast[pair.b]) &&
        box_of_path(world, pair.a).overlaps(box_of_path(world, pair.b)) &&
        balls_meet(world, pair.a, pair.b))
      ask(world, pair.a, pair.b, 0);
}

void ask_about(World& world, int row, int done, double t) {
  SweepWork& w = world.sweep;
  if (!world.states.moves[row]) return;
  const Aabb box = box_of_path(world, row);
  world.box_tree.overlaps(box, w.met);
  if (!world.boxes[row].contains(box) && std::ranges::find(w.strayed, row) == w.strayed.end())
    w.strayed.push_back(row);
  w.met.insert(w.met.end(), w.strayed.begin(), w.strayed.end());
  std::ranges::sort(w.met);
  const auto repeated = std::ranges::unique(w.met);
  w.met.erase(repeated.begin(), repeated.end());
  for (const int j : w.met)
    if (j != row && j != done && box_of_path(world, j).overlaps(box))
      ask(world, std::min(row, j), std::max(row, j), t);
}

}  // namespace carom
