// SPDX-License-Identifier: Apache-2.0
#include "contact/impacts.hpp"

#include <algorithm>
#include <cmath>

#include "carom/numerics/tolerance.hpp"

#include "contact/direct_island.hpp"

namespace carom::contact {
namespace {

constexpr int hits_per_patch = 16;  // a cradle of n balls takes n - 1 hits over n - 1 patches
constexpr int lower_restitution = 8;

Eigen::Vector3d relative(const BodyStates& states, std::span<const Eigen::Vector3d> v,
                         std::span<const Eigen::Vector3d> w, const Contact& c) {
  return v[c.b] + w[c.b].cross(c.position - states.position[c.b]) - v[c.a] -
         w[c.a].cross(c.position - states.position[c.a]);
}

/// Approach speed of the patch's fastest point that meets within the step and bounces for longer
/// than it, m/s; 0 where none does. What would land again within the step rests instead.
double approach(const BodyStates& states, const BodyFrames& frames, const Patch& patch,
                std::span<const Contact> contacts, double dt) {
  double fastest = 0;
  for (int k = patch.first; k < patch.first + patch.count; ++k) {
    const Contact& c = contacts[k];
    if (!(c.restitution > 0)) continue;
    const double before =
        c.normal.dot(relative(states, frames.velocity_before, frames.omega_before, c));
    const double now = c.normal.dot(relative(states, frames.velocity, frames.omega, c));
    const bool meets = c.separation + dt * std::min(before, now) < 0;
    const bool flies = -2 * c.restitution * before > before - now;
    if (meets && flies && -before > fastest) fastest = -before;
  }
  return fastest;
}

}  // namespace

double Impacts::strike(BodyStates& states, BodyFrames& frames, const Patch& patch,
                       std::span<Contact> contacts, double speed) {
  const Eigen::Matrix3d frame = frame_about(contacts[patch.first].normal);
  double restitution = contacts[patch.first].restitution, taken = 0;
  for (int attempt = 0; attempt <= lower_restitution; ++attempt) {
    solver_.clear();
    int local[2] = {-1, -1};
    const int rows[2] = {patch.a, patch.b};
    for (int i = 0; i < 2; ++i)
      if (states.moves[rows[i]]) {
        local[i] = static_cast<int>(solver_.bodies.size());
        DirectBody body = direct_body(states, frames, rows[i]);
        body.free << frames.velocity_before[rows[i]], frames.omega_before[rows[i]];
        solver_.bodies.push_back(body);
      }
    if (local[0] >= 0 && local[1] >= 0) solver_.edges.emplace_back(0, 1);
    for (int k = patch.first; k < patch.first + patch.count; ++k) {
      const Contact& c = contacts[k];
      DirectPoint p;
      p.a = local[0], p.b = local[1], p.edge = 0;
      p.mu = c.friction;
      p.arm_a = c.position - states.position[c.a];
      p.arm_b = c.position - states.position[c.b];
      p.frame = frame;
      p.drive.setZero();
      if (local[0] < 0)
        p.drive -= frame.transpose() * (frames.velocity[c.a] + frames.omega[c.a].cross(p.arm_a));
      if (local[1] < 0)
        p.drive += frame.transpose() * (frames.velocity[c.b] + frames.omega[c.b].cross(p.arm_b));
      p.mobility = mobility(states.inverse_mass[c.a], frames.inverse_inertia[c.a], p.arm_a) +
                   mobility(states.inverse_mass[c.b], frames.inverse_inertia[c.b], p.arm_b);
      p.impulse.setZero();
      const double u =
          c.normal.dot(relative(states, frames.velocity_before, frames.omega_before, c));
      p.gap_speed = restitution * std::min(u, 0.0);
      solver_.points.push_back(p);
    }
    if (!solver_.solve(tolerance::hit_residual * speed, tolerance::direct_residual_slow, 400)
             .converged)
      return 0;
    taken = 0;
    for (int k = 0; k < patch.count; ++k) {
      const Contact& c = contacts[patch.first + k];
      const DirectPoint& p = solver_.points[k];
      Eigen::Vector3d u = relative(states, frames.velocity_before, frames.omega_before, c);
      for (int i = 0; i < 2; ++i)
        if (local[i] >= 0) {
          const Vector6 change = solver_.bodies[local[i]].v - solver_.bodies[local[i]].free;
          const Eigen::Vector3d& arm = i == 0 ? p.arm_a : p.arm_b;
          u += (i == 0 ? -0.5 : 0.5) * (change.head<3>() + change.tail<3>().cross(arm));
        }
      taken -= (p.frame * p.impulse).dot(u);
    }
    double energy = 0;  // J at stake: rounding of it must not count as a gain
    for (const DirectBody& b : solver_.bodies)
      energy += 0.5 * b.mass * b.free.head<3>().squaredNorm();
    if (taken >= -64 * tolerance::unit_roundoff * energy - tolerance::hit_residual * energy) break;
    restitution = attempt + 1 < lower_restitution ? 0.5 * restitution : 0.0;
  }
  for (int k = 0; k < patch.count; ++k) {
    const Contact& c = contacts[patch.first + k];
    const Eigen::Vector3d f = frame * solver_.points[k].impulse;
    impulses_.push_back({patch.first + k, f, 0});
    for (int i = 0; i < 2; ++i) {
      const int row = i == 0 ? c.a : c.b;
      if (!states.moves[row]) continue;
      const Eigen::Vector3d push = i == 0 ? Eigen::Vector3d(-f) : f;
      const Eigen::Vector3d torque = (c.position - states.position[row]).cross(push);
      const Eigen::Vector3d dv = states.inverse_mass[row] * push;
      const Eigen::Vector3d dw = frames.inverse_inertia[row] * torque;
      states.velocity.set(row, states.velocity[row] + dv);
      states.angular_momentum.set(row, states.angular_momentum[row] + torque);
      frames.velocity[row] += dv, frames.velocity_before[row] += dv;
      frames.omega[row] += dw, frames.omega_before[row] += dw;
      hit_[row] = 1;
    }
  }
  impulses_.back().dissipated = taken;
  return taken;
}

double Impacts::resolve_island(BodyStates& states, BodyFrames& frames, const Islands& islands,
                               const Island& island, std::span<Contact> contacts, double dt) {
  double taken = 0;
  for (int hit = 0; hit < hits_per_patch * island.patches; ++hit) {
    int best = -1;
    double fastest = 0;
    for (int i = 0; i < island.patches; ++i) {
      const double speed =
          approach(states, frames, islands.patches[island.first_patch + i], contacts, dt);
      if (speed > fastest) fastest = speed, best = i;
    }
    if (best < 0) break;
    taken += strike(states, frames, islands.patches[island.first_patch + best], contacts, fastest);
  }
  return taken;
}

double Impacts::resolve(BodyStates& states, BodyFrames& frames, const Islands& islands,
                        std::span<Contact> contacts, double dt) {
  impulses_.clear();
  hit_.clear();
  if (std::ranges::none_of(contacts, [](const Contact& c) { return c.restitution > 0; })) return 0;
  hit_.assign(states.size(), 0);
  double taken = 0;
  for (const Island& island : islands.islands)
    taken += resolve_island(states, frames, islands, island, contacts, dt);
  return taken;
}

double Impacts::hit(BodyStates& states, BodyFrames& frames, const Patch& patch,
                    std::span<Contact> contacts, double speed) {
  impulses_.clear();
  hit_.resize(states.size());
  const double taken = strike(states, frames, patch, contacts, speed);
  add_to(contacts);
  return taken;
}

void Impacts::add_to(std::span<Contact> contacts) const {
  for (const Impulse& i : impulses_) {
    contacts[i.contact].impulse += i.impulse;
    contacts[i.contact].dissipated += i.dissipated;
  }
}

}  // namespace carom::contact
