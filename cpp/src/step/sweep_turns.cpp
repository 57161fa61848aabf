// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "carom/numerics/tolerance.hpp"

#include "step/sweep.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// How far a turn may carry a corner that the contacts of the pair do not hold back, m. They are of
/// the face that faces the other body as the step begins, and move on straight lines: up to the
/// angle at which a face counts as facing only the second order of the turn is missing.
double unseen(double turn, double swing) {
  static const double facing = std::acos(tolerance::facing);
  return turn > facing ? turn * swing : 0.5 * turn * turn * swing;
}

}  // namespace

bool turns_through(const World& world, int a, int b, const Vector3d& turn_a,
                   const Vector3d& turn_b) {
  const SweepWork& w = world.sweep;
  const double turn = (turn_b - turn_a).norm();
  double way = 0;
  for (const int row : {a, b})
    if (world.states.moves[row]) way += unseen(turn, w.turning_radius[row]);
  // Half of what may go unseen: the pair may overlap by the other half before.
  return way > std::min(w.thickness[a], w.thickness[b]) + 0.5 * tolerance::sweep_deepest;
}

bool mark_turned(World& world) {
  SweepWork& w = world.sweep;
  if (!w.has_thin) return false;
  const BodyStates& s = world.states;
  const auto turn = [&](int row) -> Vector3d {
    return s.moves[row] ? Vector3d(world.dt * s.angular_velocity(row)) : Vector3d::Zero();
  };
  bool any = false;
  for (const BodyPair& pair : w.kept) {
    if (!turns_through(world, pair.a, pair.b, turn(pair.a), turn(pair.b))) continue;
    for (const int row : {pair.a, pair.b}) {
      if (!s.moves[row] || w.ccd[row] == Ccd::never) continue;
      w.fast[row] = 1;
      any = true;
    }
  }
  return any;
}

}  // namespace carom
