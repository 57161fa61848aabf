// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"
#include "carom/step/rotation.hpp"

#include "step/sweep.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Free rotation of one body at constant momentum, by the integrator of the simulation.
Quaterniond turned(const World& world, Quaterniond q, const Vector3d& l, const Vector3d& inverse,
                   double dt) {
  RotationReport ignored;
  advance_rotation(world.options.integrator,
                   {&q.x(), &q.y(), &q.z(), &q.w(), &l.x(), &l.y(), &l.z(), &inverse.x(),
                    &inverse.y(), &inverse.z()},
                   0, 1, dt, ignored);
  return q;
}

bool turns_evenly(const BodyStates& s, int i) {
  const Vector3d m = s.moments[i];
  return m[2] - m[0] <= tolerance::equal_moments * m[2];
}

/// Arcs from the principal orientation q0 at t0, at the momentum of the states, to the end of the
/// step; to q1 there where it is given.
void lay_arcs(const World& world, int i, double t0, const Quaterniond& q0, const Quaterniond* q1,
              BodyPath& path) {
  const BodyStates& s = world.states;
  const Vector3d l = s.angular_momentum[i], inverse = s.inverse_moments[i];
  const double rest = world.dt - t0;
  const Quaterniond to_body = s.axes_b[i].conjugate();
  const Vector3d omega = q0 * inverse.cwiseProduct(q0.conjugate() * l);
  // |omega| of a top stays below |L| over its least moment that resists.
  const double most = turns_evenly(s, i) ? omega.norm() : l.norm() * inverse.maxCoeff();
  path.arcs.clear();
  if (!(rest > 0) || (most == 0 && !q1)) {
    path.arcs.push_back({t0, q0 * to_body, Vector3d::Zero()});
    return;
  }
  if (turns_evenly(s, i) && (!q1 || most * rest > tolerance::sweep_arc)) {
    path.arcs.push_back({t0, q0 * to_body, omega});
    return;
  }
  const int n = static_cast<int>(
      std::clamp(std::ceil(most * rest / tolerance::sweep_arc), 1.0, tolerance::rotation_substeps));
  const double h = rest / n;
  Quaterniond q = q0;
  for (int k = 0; k < n; ++k) {
    const bool last = k + 1 == n;
    const Quaterniond next = last && q1 ? *q1 : turned(world, q, l, inverse, h);
    path.arcs.push_back({t0 + k * h, q * to_body, rotation_logarithm(next * q.conjugate()) / h});
    q = next;
  }
}

/// Angular momentum at time t of a path, turned by what the path's arc strays from the free motion:
/// seen from the body it is the true one, so the energy of rotation is, however unequal the
/// moments. Where contacts turned the body the momentum it ends with is taken.
Vector3d momentum_at(const World& world, int i, double t, const Quaterniond& at) {
  const BodyStates& s = world.states;
  const SweepWork& w = world.sweep;
  const Vector3d l = s.angular_momentum[i] - (world.dt - t) * w.torque[i];
  if (turns_evenly(s, i)) return l;
  const BodyPath& path = w.paths[i];
  if (path.start == 0 && world.plan.runs(StageKind::solve) && world.solver.motion().decided[i])
    return at * (s.orientation[i].conjugate() * l);
  const BodyPath::Arc& arc = path.arc_at(t);
  const Quaterniond from = arc.orientation * s.axes_b[i];
  const Quaterniond free = turned(world, from, l, s.inverse_moments[i], t - arc.time);
  return at * (free.conjugate() * l);
}

}  // namespace

void begin_paths(World& world) {
  SweepWork& w = world.sweep;
  const int n = world.states.size();
  w.paths.resize(n);
  w.laid.assign(n, 0), w.waits.assign(n, 0), w.boxed.assign(n, 0), w.version.assign(n, 0),
      w.hits.assign(n, 0);
  w.met_only.resize(n);
  std::iota(w.met_only.begin(), w.met_only.end(), 0);
  for (Array3* a : {&w.torque, &w.pull}) a->x.resize(n), a->y.resize(n), a->z.resize(n);
}

void need_path(World& world, int i) {
  SweepWork& w = world.sweep;
  if (w.laid[i]) return;
  w.laid[i] = 1;
  const BodyStates& s = world.states;
  BodyPath& path = w.paths[i];
  path.start = 0;
  path.com_b = s.com_b[i];
  path.centre = w.position_before[i];
  path.acceleration.setZero(), path.velocity.setZero();
  w.torque.set(i, Vector3d::Zero());
  if (!s.moves[i]) {
    path.arcs.assign(1, {0, s.orientation[i] * s.axes_b[i].conjugate(), Vector3d::Zero()});
    w.pull.set(i, Vector3d::Zero());
    return;
  }
  // The parabola that gets there with the velocity it ends with: the true one in free flight, and
  // one whose speed fits its way where contacts pushed.
  const Vector3d mean = (s.position[i] - path.centre) / world.dt;
  path.acceleration = 2 / world.dt * (s.velocity[i] - mean);
  path.velocity = 2 * mean - s.velocity[i];
  const bool pushed = world.plan.runs(StageKind::solve) && world.solver.motion().decided[i];
  w.pull.set(i, pushed ? gravity_of(world) : path.acceleration);
  if (!pushed)
    w.torque.set(i, (s.angular_momentum[i] - world.angular_momentum_before[i]) / world.dt);
  const Quaterniond q1 = s.orientation[i];
  lay_arcs(world, i, 0, w.orientation_before[i], &q1, path);
}

void go_to(World& world, int i, double t) {
  BodyStates& s = world.states;
  if (!s.moves[i]) return;
  SweepWork& w = world.sweep;
  const BodyPath& path = w.paths[i];
  const Quaterniond at = (path.pose_at(t).orientation * s.axes_b[i]).normalized();
  s.position.set(i, path.centre_at(t));
  if (!w.waits[i]) {
    s.velocity.set(i, s.velocity[i] - (world.dt - t) * path.acceleration);
    s.angular_momentum.set(i, momentum_at(world, i, t, at));
  }
  s.orientation.set(i, at);
}

void lay_path(World& world, int i, double t, const Vector3d& acceleration) {
  BodyStates& s = world.states;
  if (!s.moves[i]) return;
  SweepWork& w = world.sweep;
  BodyPath& path = w.paths[i];
  if (w.waits[i]) return;
  const double rest = world.dt - t;
  path.start = t;
  path.centre = s.position[i];
  path.velocity = s.velocity[i];
  path.acceleration = acceleration;
  lay_arcs(world, i, t, s.orientation[i], nullptr, path);
  s.position.set(i, path.centre_at(world.dt));
  s.orientation.set(i, (path.pose_at(world.dt).orientation * s.axes_b[i]).normalized());
  s.velocity.set(i, s.velocity[i] + rest * acceleration);
  s.angular_momentum.set(i, s.angular_momentum[i] + rest * w.torque[i]);
}

void wait_at(World& world, int i, double t) {
  SweepWork& w = world.sweep;
  if (!world.states.moves[i] || w.waits[i]) return;
  go_to(world, i, t);
  BodyPath& path = w.paths[i];
  const Quaterniond q = path.pose_at(t).orientation;
  path.start = t;
  path.centre = world.states.position[i];
  path.velocity.setZero(), path.acceleration.setZero();
  path.arcs.assign(1, {t, q, Vector3d::Zero()});
  w.waits[i] = 1;
  world.report.sweep.waited += 1;
  world.report.sweep.time_lost += world.dt - t;
}

Aabb path_box(const World& world, int i, const Vector3d& from, const Vector3d& to) {
  // The parabola leaves its chord by a h^2 / 8, and a h / 2 is what the mean speed lacks.
  const double bulge = 0.25 * (world.dt * world.states.velocity[i] - (to - from)).norm();
  Aabb box;
  box.extend(from), box.extend(to);
  return box.inflated(world.sweep.radius[i] + tolerance::sweep_clear + bulge);
}

Aabb path_bounds(const World& world, int i) {
  const SweepWork& w = world.sweep;
  if (!world.states.moves[i]) return world.boxes[i];
  if (!w.laid[i]) return path_box(world, i, w.position_before[i], world.states.position[i]);
  return w.paths[i]
      .centre_bounds(w.paths[i].start, world.dt)
      .inflated(w.radius[i] + tolerance::sweep_clear);
}

}  // namespace carom
