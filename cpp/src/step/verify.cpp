// SPDX-License-Identifier: Apache-2.0
#include "step/verify.hpp"

#include <algorithm>
#include <set>

#include "step/world.hpp"

namespace carom {
namespace {

constexpr int pieces_of_a_parabola = 4;  // chords then stray by a h^2 / 128: 20 um of fall at 60 Hz

ScrewMotion motion_between(const BodyPath& path, double from, double to) {
  ScrewMotion m;
  m.centre = path.centre_at(from);
  m.orientation = path.pose_at(from).orientation;
  m.displacement = path.centre_at(to) - m.centre;
  m.rotation = (to - from) * path.arc_at(0.5 * (from + to)).rate;
  return m;
}

const TrailPiece* piece_at(const std::vector<TrailPiece>& trail, int row, double t) {
  for (const TrailPiece& p : trail)
    if (p.row == row && p.from <= t && t < p.to) return &p;
  return nullptr;
}

/// Times at which either way changes its kind.
std::vector<double> breaks_of(const std::vector<TrailPiece>& trail, int a, int b) {
  std::set<double> times;
  for (const TrailPiece& p : trail) {
    if (p.row != a && p.row != b) continue;
    const int n = p.path.acceleration.isZero(0) ? 1 : pieces_of_a_parabola;
    for (int k = 0; k <= n; ++k) times.insert(k == n ? p.to : p.from + (p.to - p.from) * k / n);
    for (const BodyPath::Arc& arc : p.path.arcs)
      if (arc.time > p.from && arc.time < p.to) times.insert(arc.time);
  }
  return {times.begin(), times.end()};
}

void verify_pair(World& world, int a, int b, const std::vector<Aabb>& boxes) {
  SweepWork& w = world.sweep;
  SweepReport& report = world.report.sweep;
  ++report.verified;
  SweptBody core_a = core_of(world, a, boxes[b]), core_b = core_of(world, b, boxes[a]);
  if (core_a.mesh.faces.rows() == 0 || core_b.mesh.faces.rows() == 0) return;
  const std::vector<double> times = breaks_of(w.trail, a, b);
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double from = times[k], to = times[k + 1], middle = 0.5 * (from + to);
    for (auto [row, core] : {std::pair(a, &core_a), std::pair(b, &core_b)}) {
      const TrailPiece* piece = piece_at(w.trail, row, middle);
      core->motion = motion_between(piece ? piece->path : w.paths[row], from, to);
    }
    const SweepResult found = sweep(core_a, core_b);
    if (found.status == SweepStatus::separated) continue;
    // Cores that overlap when the step begins were put there: not a crossing of this step.
    if (found.status == SweepStatus::contact && !(k == 0 && found.time == 0)) ++report.crossings;
    return;
  }
}

}  // namespace

void keep_trail(World& world, int row, double t) {
  SweepWork& w = world.sweep;
  const double from = w.paths[row].start;
  if (world.states.moves[row] && t > from) w.trail.push_back({row, from, t, w.paths[row]});
}

void verify_step(World& world) {
  SweepWork& w = world.sweep;
  const int n = world.states.size();
  for (int i = 0; i < n; ++i) keep_trail(world, i, world.dt);
  std::vector<Aabb> boxes(n);
  for (int i = 0; i < n; ++i)
    if (!world.states.moves[i]) boxes[i] = world.boxes[i];
  for (const TrailPiece& p : w.trail) {
    const double radius = bounding_radius(world.scene.bodies[p.row].shape) + p.path.com_b.norm();
    const Aabb way = p.path.centre_bounds(p.from, p.to).inflated(radius);
    boxes[p.row].extend(way);
  }
  BoxTree tree;
  for (const BodyPair& pair : tree.update(boxes, world.states.moves))
    if (world.filter.meet(pair.a, pair.b)) verify_pair(world, pair.a, pair.b, boxes);
  w.trail.clear();
}

}  // namespace carom
