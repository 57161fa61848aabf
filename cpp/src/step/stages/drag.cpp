// SPDX-License-Identifier: Apache-2.0
#include "carom/step/rotation.hpp"

#include "step/stages/resisted.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

/// What all LinearDrag of the scene come to for one body.
struct Resistance {
  double linear = 0, angular = 0;                  // kg/s, N m s
  Eigen::Vector3d push = Eigen::Vector3d::Zero();  // N, of the wind on a body at rest
};

Resistance resistance_of(const World& world, int i) {
  Resistance r;
  for (const Effect& effect : world.scene.effects)
    if (const auto* drag = std::get_if<LinearDrag>(&effect)) {
      if (drag->body && *drag->body != world.scene.bodies[i].id) continue;
      r.linear += drag->coefficient;
      r.angular += drag->angular_coefficient;
      r.push += drag->coefficient * drag->wind;
    }
  return r;
}

void slow_down(World& world, int i, const Resistance& r, const Eigen::Vector3d& gravity) {
  BodyStates& s = world.states;
  const double m = s.mass[i];
  const Eigen::Vector3d v0 = world.velocity_before[i];
  const Eigen::Vector3d kick = s.velocity[i] - v0;  // what the other forces did on their own
  if (!(r.linear > 0)) {
    world.mean_velocity.set(i, v0 + 0.5 * kick);
    return;
  }
  const Eigen::Vector3d wind = r.push / r.linear;
  Eigen::Vector3d after, mean;
  for (int k = 0; k < 3; ++k) {
    const Resisted w =
        resisted(m * (v0[k] - wind[k]), m * kick[k], r.linear / m, s.inverse_mass[i], world.dt);
    after[k] = wind[k] + w.after * s.inverse_mass[i];
    mean[k] = wind[k] + w.mean * s.inverse_mass[i];
    world.dissipated += w.dissipated;
  }
  world.work += m * (after - s.velocity[i]).dot(wind);
  // A held wrench was booked at the velocities it would have made alone; it acts along the path.
  const Eigen::Vector3d own = kick - world.dt * gravity;
  world.work += m * own.dot(mean - (v0 + world.dt * gravity + 0.5 * own));
  s.velocity.set(i, after);
  world.mean_velocity.set(i, mean);
}

void spin_down(World& world, int i, const Resistance& r) {
  BodyStates& s = world.states;
  const Eigen::Quaterniond q = world.orientation_halfway[i];
  const Eigen::Vector3d a = s.inverse_moments[i];
  const Eigen::Vector3d before = q.conjugate() * world.angular_momentum_before[i];
  const Eigen::Vector3d kick = q.conjugate() * s.angular_momentum[i] - before;
  Eigen::Vector3d after = before + kick, mean = before + 0.5 * kick;
  for (int k = 0; k < 3; ++k) {
    if (!(a[k] > 0)) continue;  // nothing turns about the axis of a rod
    const Resisted w = resisted(before[k], kick[k], r.angular * a[k], a[k], world.dt);
    after[k] = w.after, mean[k] = w.mean;
    world.dissipated += w.dissipated;
    world.work += kick[k] * a[k] * (w.mean - (before[k] + 0.5 * kick[k]));
  }
  s.angular_momentum.set(i, q * after);
  world.mean_momentum.set(i, q * mean);
  world.has_mean_momentum[i] = 1;
}

}  // namespace

void run_drag(World& world) {
  BodyStates& s = world.states;
  const Eigen::Vector3d gravity = gravity_of(world);
  world.mean_velocity = world.velocity_before;
  world.mean_momentum = s.angular_momentum;
  world.has_mean_momentum.assign(s.size(), 0);
  bool turns = false;
  for (const Effect& effect : world.scene.effects)
    if (const auto* drag = std::get_if<LinearDrag>(&effect)) turns |= drag->angular_coefficient > 0;
  if (turns) {
    // Resistance differs between the axes of a body: taken where they stand halfway, the step is of
    // second order.
    Array4& q = world.orientation_halfway = s.orientation;
    const Array3 &l = world.angular_momentum_before, &a = s.inverse_moments;
    RotationReport ignored;
    advance_rotation(world.options.integrator,
                     {q.x.data(), q.y.data(), q.z.data(), q.w.data(), l.x.data(), l.y.data(),
                      l.z.data(), a.x.data(), a.y.data(), a.z.data()},
                     world.plan.movers, 0.5 * world.dt, ignored);
  }
  for (const int i : world.plan.movers) {
    const Resistance r = resistance_of(world, i);
    slow_down(world, i, r, gravity);
    if (r.angular > 0) spin_down(world, i, r);
  }
}

}  // namespace carom
