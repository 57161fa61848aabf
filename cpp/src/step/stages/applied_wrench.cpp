// SPDX-License-Identifier: Apache-2.0
#include "step/world.hpp"

namespace carom {
namespace {

/// Adds momentum and books the work: impulse times the mean of the velocities before and after.
void kick(World& world, int i, const Eigen::Vector3d& linear, const Eigen::Vector3d& angular) {
  BodyStates& s = world.states;
  if (!s.moves[i]) return;
  const double before = s.kinetic_energy(i);
  s.velocity.set(i, s.velocity[i] + s.inverse_mass[i] * linear);
  s.angular_momentum.set(i, s.angular_momentum[i] + angular);
  world.work += s.kinetic_energy(i) - before;
}

void hold(World& world, const AppliedWrench& w) {
  const int i = *world.scene.row(w.body);
  const Eigen::Quaterniond q_wb = world.states.pose(i).orientation;
  const Eigen::Vector3d force = w.in_body_axes ? q_wb * w.force : w.force;
  const Eigen::Vector3d torque = w.in_body_axes ? q_wb * w.torque : w.torque;
  kick(world, i, world.dt * force, world.dt * (torque + (q_wb * w.point_b).cross(force)));
}

}  // namespace

void run_applied_wrench(World& world) {
  for (const Request& r : world.requests)
    kick(world, r.row, world.dt * r.force, world.dt * r.torque);
  for (const Effect& effect : world.scene.effects)
    if (const auto* wrench = std::get_if<AppliedWrench>(&effect)) hold(world, *wrench);
  const std::size_t held = world.scene.effects.size();
  // To the nearest step, so that rounding in the clock neither drops nor adds one.
  const double nearest_end = world.report.time + 1.5 * world.dt;
  std::erase_if(world.scene.effects, [&](const Effect& effect) {
    const auto* wrench = std::get_if<AppliedWrench>(&effect);
    return wrench && nearest_end > wrench->until;
  });
  world.plan_is_stale |= !world.requests.empty() || held != world.scene.effects.size();
  world.requests.clear();
}

}  // namespace carom
