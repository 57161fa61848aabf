// SPDX-License-Identifier: Apache-2.0
#include "contact/direct_island.hpp"

#include <algorithm>
#include <cmath>

#include "carom/numerics/tolerance.hpp"

namespace carom::contact {
namespace {

Vector6 velocity_before(const BodyFrames& frames, int row) {
  Vector6 v;
  v << frames.velocity_before[row], frames.omega_before[row];
  return v;
}

}  // namespace

DirectBody direct_body(const BodyStates& states, const BodyFrames& frames, int row) {
  DirectBody body;
  body.mass = states.mass[row];
  body.inverse_mass = states.inverse_mass[row];
  body.inverse_inertia = frames.inverse_inertia[row];
  const Eigen::Matrix3d r = states.orientation[row].toRotationMatrix();
  Eigen::Vector3d moments = states.moments[row];
  const Eigen::Vector3d inverse = states.inverse_moments[row];
  const double largest = moments.maxCoeff();
  Eigen::Vector3d resists = Eigen::Vector3d::Ones();
  for (int k = 0; k < 3; ++k)
    if (!(inverse[k] > 0)) {
      // Any positive number serves: no torque reaches this axis.
      moments[k] = largest > 0 ? largest : body.mass;
      resists[k] = 0;
      body.resists_all = false;
    }
  body.inertia = r * moments.asDiagonal() * r.transpose();
  body.resists = r * resists.asDiagonal() * r.transpose();
  body.radius = std::sqrt(largest / body.mass);
  body.free << frames.velocity[row], frames.omega[row];
  return body;
}

void DirectIsland::load(const BodyStates& states, const BodyFrames& frames, const Islands& islands,
                        const Island& island, std::span<const Contact> contacts, double dt) {
  solver_.clear();
  contact_of_.clear();
  local_.resize(states.size(), -1);
  for (int i = 0; i < island.bodies; ++i) {
    const int row = islands.bodies[island.first_body + i];
    local_[row] = i;
    solver_.bodies.push_back(direct_body(states, frames, row));
  }
  for (int i = 0; i < island.patches; ++i) {
    const Patch& patch = islands.patches[island.first_patch + i];
    const int a = states.moves[patch.a] ? local_[patch.a] : -1;
    const int b = states.moves[patch.b] ? local_[patch.b] : -1;
    int edge = -1;
    if (a >= 0 && b >= 0) {
      edge = static_cast<int>(solver_.edges.size());
      solver_.edges.emplace_back(a, b);
    }
    const Eigen::Matrix3d frame = frame_about(contacts[patch.first].normal);
    for (int k = patch.first; k < patch.first + patch.count; ++k) {
      const Contact& c = contacts[k];
      DirectPoint p;
      p.a = a, p.b = b, p.edge = edge;
      p.mu = c.friction;
      p.gap_speed = std::max(c.separation, 0.0) / dt;
      p.arm_a = c.position - states.position[patch.a];
      p.arm_b = c.position - states.position[patch.b];
      p.frame = frame;
      p.drive.setZero();
      Eigen::Vector3d spin = Eigen::Vector3d::Zero();
      if (a < 0) {
        p.drive -=
            frame.transpose() * (frames.velocity[patch.a] + frames.omega[patch.a].cross(p.arm_a));
        spin -= frames.omega[patch.a];
      }
      if (b < 0) {
        p.drive +=
            frame.transpose() * (frames.velocity[patch.b] + frames.omega[patch.b].cross(p.arm_b));
        spin += frames.omega[patch.b];
      }
      p.mobility =
          mobility(states.inverse_mass[patch.a], frames.inverse_inertia[patch.a], p.arm_a) +
          mobility(states.inverse_mass[patch.b], frames.inverse_inertia[patch.b], p.arm_b);
      p.impulse = frame.transpose() * c.impulse;
      if (c.rolling_resistance > 0 || c.spinning_resistance > 0) {
        DirectTurn t;
        t.point = static_cast<int>(solver_.points.size());
        t.rolling = c.rolling_resistance, t.spinning = c.spinning_resistance;
        t.mobility =
            (frames.inverse_inertia[patch.a] + frames.inverse_inertia[patch.b]).trace() / 3;
        t.drive = frame.transpose() * spin;
        t.impulse = frame.transpose() * c.turning_impulse;
        if (t.mobility > 0) solver_.turns.push_back(t);
      }
      solver_.points.push_back(p);
      contact_of_.push_back(k);
    }
  }
}

// Sum of the normal speeds before and after, m/s.
double DirectIsland::approach(const BodyStates& states, const BodyFrames& frames,
                              const Contact& c) const {
  const auto both = [&](int row) -> Eigen::Vector3d {
    const Eigen::Vector3d arm = c.position - states.position[row];
    if (!states.moves[row]) return 2 * (frames.velocity[row] + frames.omega[row].cross(arm));
    const Vector6 v = solver_.bodies[local_[row]].v + velocity_before(frames, row);
    return v.head<3>() + v.tail<3>().cross(arm);
  };
  return c.normal.dot(both(c.b) - both(c.a));
}

double DirectIsland::store(BodyStates& states, const BodyFrames& frames,
                           std::span<Contact> contacts) {
  double dissipated = 0;
  for (std::size_t k = 0; k < solver_.points.size(); ++k) {
    Contact& c = contacts[contact_of_[k]];
    const DirectPoint& p = solver_.points[k];
    c.impulse = p.frame * p.impulse;
    c.impulse_at_end = c.impulse;
    c.turning_impulse.setZero();
  }
  for (const DirectTurn& t : solver_.turns)
    contacts[contact_of_[t.point]].turning_impulse = solver_.points[t.point].frame * t.impulse;
  // Momentum from the impulses themselves, so that pairs exchange it to the last bit.
  for (const int k : contact_of_) {
    const Contact& c = contacts[k];
    const auto act = [&](int row, double sign) {
      if (!states.moves[row]) return;
      const Eigen::Vector3d f = sign * c.impulse;
      states.velocity.set(row, states.velocity[row] + states.inverse_mass[row] * f);
      states.angular_momentum.set(row, states.angular_momentum[row] +
                                           (c.position - states.position[row]).cross(f) +
                                           sign * c.turning_impulse);
    };
    act(c.a, -1), act(c.b, 1);
  }
  // Work: impulse times the mean of the relative velocity before the step and after it.
  for (const int k : contact_of_) {
    Contact& c = contacts[k];
    Eigen::Vector3d u = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero();
    const auto add = [&](int row, double sign) {
      Eigen::Vector3d omega = frames.omega[row], v = frames.velocity[row];
      if (states.moves[row]) {
        const Vector6& now = solver_.bodies[local_[row]].v;
        v = 0.5 * (now.head<3>() + frames.velocity_before[row]);
        omega = 0.5 * (now.tail<3>() + frames.omega_before[row]);
      }
      u += sign * (v + omega.cross(c.position - states.position[row]));
      w += sign * omega;
    };
    add(c.a, -1), add(c.b, 1);
    c.dissipated -= c.impulse.dot(u) + c.turning_impulse.dot(w);
    dissipated += -c.impulse.dot(u) - c.turning_impulse.dot(w);
  }
  return dissipated;
}

DirectResult DirectIsland::solve(BodyStates& states, const BodyFrames& frames,
                                 const Islands& islands, const Island& island,
                                 std::span<Contact> contacts, ContactMotion& motion, double dt,
                                 double residual, int newton_cap, double& dissipated) {
  load(states, frames, islands, island, contacts, dt);
  DirectResult result = solver_.solve(
      residual, std::min(tolerance::direct_residual_slow, 100 * residual), newton_cap);
  if (!result.converged) return result;
  dissipated += store(states, frames, contacts);

  bool touched = false, overlaps = false;
  for (std::size_t k = 0; k < solver_.points.size(); ++k) {
    touched |= !solver_.points[k].impulse.isZero(0);
    overlaps |= contacts[contact_of_[k]].separation < -tolerance::push_from;
  }
  if (!touched && !overlaps) return result;  // free flight: the mean velocity is exact there

  // The mean of both velocities is exact under constant forces, friction among them; where it would
  // drive points into each other, something lands, and the new velocity takes it to the surface.
  const bool lands = std::ranges::any_of(contact_of_, [&](int k) {
    const Contact& c = contacts[k];
    const double gap = c.separation + 0.5 * dt * approach(states, frames, c);
    return gap < std::min(c.separation, 0.0) - tolerance::push_from;
  });
  const double share = lands ? 0.0 : 0.5;  // of the old velocity
  for (int i = 0; i < island.bodies; ++i) {
    const int row = islands.bodies[island.first_body + i];
    const Vector6 old = share * (velocity_before(frames, row) - solver_.bodies[i].v);
    motion.decided[row] = 1;
    motion.displacement.set(row, dt * (states.velocity[row] + old.head<3>()));
    motion.turn.set(row, dt * old.tail<3>());
  }
  if (lands) {
    // The forces of the step act along the way gone, not along the mean: what that leaves of their
    // work is lost in the hit.
    for (int i = 0; i < island.bodies; ++i) {
      const int row = islands.bodies[island.first_body + i];
      const Vector6 half = 0.5 * (velocity_before(frames, row) - solver_.bodies[i].v);
      const Eigen::Vector3d kick = frames.velocity[row] - frames.velocity_before[row];
      const Eigen::Vector3d twist = frames.omega[row] - frames.omega_before[row];
      dissipated -= states.mass[row] * kick.dot(half.head<3>()) +
                    twist.dot(solver_.bodies[i].inertia * half.tail<3>());
    }
  }
  if (!overlaps) return result;

  for (std::size_t k = 0; k < solver_.points.size(); ++k) {
    const double s = contacts[contact_of_[k]].separation;
    if (s < 0)
      solver_.points[k].gap_speed =
          std::max(tolerance::push_share * s / dt, -tolerance::push_speed);
  }
  settled_.clear();
  for (DirectBody& body : solver_.bodies) settled_.push_back(body.v);
  const DirectResult pushed = solver_.solve(std::max(residual, tolerance::push_residual),
                                            tolerance::direct_residual_slow, newton_cap);
  result.newton += pushed.newton;
  if (!pushed.converged) return result;  // they stay where they overlap; the next step tries again
  for (int i = 0; i < island.bodies; ++i) {
    const int row = islands.bodies[island.first_body + i];
    const Vector6 extra = solver_.bodies[i].v - settled_[i];
    motion.displacement.set(row, motion.displacement[row] + dt * extra.head<3>());
    motion.turn.set(row, motion.turn[row] + dt * extra.tail<3>());
  }
  return result;
}

}  // namespace carom::contact
