// SPDX-License-Identifier: Apache-2.0
// The lecture's repulsion impulse. It acts at the start of the step, so that a step of dt carries
// the points apart; what it adds in energy is measured, not estimated.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "carom/narrow/interior_normal.hpp"
#include "carom/numerics/tolerance.hpp"

#include "step/interior_contacts.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

Repulsion repulsion_of(const Scene& scene) {
  Repulsion last;
  for (const Effect& effect : scene.effects)
    if (const auto* found = std::get_if<Repulsion>(&effect)) last = *found;
  return last;
}

bool pushable(const BodyStates& s, int i) {
  return s.moves[i] && s.inverse_mass[i] > 0;
}

Vector3d turned_by(const BodyStates& s, int i, const Vector3d& angular_impulse) {
  const Eigen::Matrix3d R = s.orientation[i].toRotationMatrix();
  return R * s.inverse_moments[i].cwiseProduct(R.transpose() * angular_impulse);
}

/// Change of velocity at a point along n for an impulse of 1 N s along n there, 1/kg.
double mobility(const BodyStates& s, int i, const Vector3d& point, const Vector3d& n) {
  if (!pushable(s, i)) return 0;
  const Vector3d lever = point - s.position[i];
  return s.inverse_mass[i] + n.dot(turned_by(s, i, lever.cross(n)).cross(lever));
}

/// Both at the end and before the forces: the impulse acts at the start of the step.
void push(World& world, int i, const Vector3d& point, const Vector3d& impulse) {
  BodyStates& s = world.states;
  if (!pushable(s, i)) return;
  const Vector3d spin = (point - s.position[i]).cross(impulse);
  for (Array3* v : {&s.velocity, &world.velocity_before})
    v->set(i, (*v)[i] + s.inverse_mass[i] * impulse);
  for (Array3* l : {&s.angular_momentum, &world.angular_momentum_before}) l->set(i, (*l)[i] + spin);
}

void apply(World& world, const Contact& c, const Vector3d& impulse) {
  push(world, c.b, c.position, impulse);
  push(world, c.a, c.position, -impulse);
}

Vector3d relative_velocity(const World& world, const Contact& c) {
  return world.states.velocity_at(c.b, c.position) - world.states.velocity_at(c.a, c.position);
}

double kinetic_energy(const World& world) {
  double sum = 0;
  for (const int i : world.plan.movers) sum += world.states.kinetic_energy(i);
  return sum;
}

/// What each overlapping point asks for.
void gather(World& world, const Repulsion& how) {
  world.pushes.clear();
  for (std::size_t k = 0; k < world.contacts.size(); ++k) {
    const Contact& c = world.contacts[k];
    if (!(c.separation < 0)) continue;
    const double normal_velocity = c.normal.dot(relative_velocity(world, c));
    const double speed =
        repulsion_speed(-c.separation, normal_velocity, world.dt, how.bounded, how.cap);
    const double m = mobility(world.states, c.a, c.position, c.normal) +
                     mobility(world.states, c.b, c.position, c.normal);
    if (!(m > 0)) continue;
    // The target is a velocity to reach: several points of a body then share one push.
    world.pushes.push_back({k, normal_velocity + speed, m, 0});
    world.report.repulsion.fastest = std::max(world.report.repulsion.fastest, speed);
    ++world.report.repulsion.pushed;
  }
}

/// Projected Gauss-Seidel; pushes never pull.
void sweep(World& world) {
  double largest = 0;
  for (const Push& p : world.pushes) largest = std::max(largest, std::abs(p.target));
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tolerance::repulsion_sweeps; ++i) {
    double change = 0;
    for (Push& p : world.pushes) {
      const Contact& c = world.contacts[p.contact];
      const double lack = p.target - c.normal.dot(relative_velocity(world, c));
      const double impulse = std::max(0.0, p.impulse + lack / p.mobility);
      change = std::max(change, std::abs(impulse - p.impulse) * p.mobility);
      apply(world, c, (impulse - p.impulse) * c.normal);
      p.impulse = impulse;
    }
    if (change <= tolerance::repulsion_settled * largest) return;
    if (change == before) {  // rounding leaves each sweep where the last one was
      ++world.report.repulsion.stagnated;
      return;
    }
    before = change;
  }
  ++world.report.repulsion.capped;
}

/// Friction of the pushes: no more than the cone allows, no more than stops the sliding.
void rub(World& world) {
  for (const Push& p : world.pushes) {
    const Contact& c = world.contacts[p.contact];
    const Vector3d v = relative_velocity(world, c);
    const Vector3d sliding = v - c.normal.dot(v) * c.normal;
    const double speed = sliding.norm();
    if (!(speed > 0) || !(p.impulse > 0) || !(c.friction > 0)) continue;
    const Vector3d along = sliding / speed;
    const double m = mobility(world.states, c.a, c.position, along) +
                     mobility(world.states, c.b, c.position, along);
    apply(world, c, -std::min(c.friction * p.impulse, speed / m) * along);
  }
}

}  // namespace

void run_repulsion(World& world) {
  const Repulsion how = repulsion_of(world.scene);
  if (how.interior_normals) refine_interior_contacts(world);
  gather(world, how);
  if (world.pushes.empty()) return;
  const double start = kinetic_energy(world);
  sweep(world);
  const double pushed = kinetic_energy(world);
  rub(world);
  world.repulsion += pushed - start;
  world.dissipated += pushed - kinetic_energy(world);
}

}  // namespace carom
