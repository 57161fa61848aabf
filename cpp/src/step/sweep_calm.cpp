// SPDX-License-Identifier: Apache-2.0
// What a body that has to wait keeps of its speed: what jams loses it in some steps, as it would by
// hits without number.
#include <Eigen/Dense>

#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d inertia(const BodyStates& s, int i) {
  const Matrix3d axes = s.orientation[i].toRotationMatrix();
  return axes * s.moments[i].asDiagonal() * axes.transpose();
}

double both(const BodyStates& s, int a, int b) {
  return s.kinetic_energy(a) + s.kinetic_energy(b);
}

}  // namespace

void calm(World& world, int i) {
  if (!(world.scene.bodies[i].restitution < 1)) return;
  BodyStates& s = world.states;
  world.dissipated += s.kinetic_energy(i);
  s.velocity.set(i, tolerance::sweep_wait_keeps * s.velocity[i]);
  s.angular_momentum.set(i, tolerance::sweep_wait_keeps * s.angular_momentum[i]);
  world.dissipated -= s.kinetic_energy(i);
}

// Of both as one rigid body: that motion has all their momentum, linear and angular.
void calm_together(World& world, int a, int b) {
  const double restitution =
      std::max(world.scene.bodies[a].restitution, world.scene.bodies[b].restitution);
  if (!(restitution < 1)) return;
  BodyStates& s = world.states;
  world.dissipated += both(s, a, b);
  const double mass = s.mass[a] + s.mass[b];
  const Vector3d centre = (s.mass[a] * s.position[a] + s.mass[b] * s.position[b]) / mass;
  const Vector3d v = (s.mass[a] * s.velocity[a] + s.mass[b] * s.velocity[b]) / mass;
  Matrix3d inertia_of_both = Matrix3d::Zero();
  Vector3d momentum = Vector3d::Zero();
  for (const int i : {a, b}) {
    const Vector3d r = s.position[i] - centre;
    inertia_of_both +=
        inertia(s, i) + s.mass[i] * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
    momentum += s.angular_momentum[i] + s.mass[i] * r.cross(s.velocity[i] - v);
  }
  // Points on a line resist no turn about it: the least solution leaves that one out.
  const Vector3d turn = inertia_of_both.completeOrthogonalDecomposition().solve(momentum);
  constexpr double keeps = tolerance::sweep_wait_keeps;
  for (const int i : {a, b}) {
    const Vector3d along = v + turn.cross(s.position[i] - centre);
    const Vector3d spin = inertia(s, i) * turn;
    s.velocity.set(i, along + keeps * (s.velocity[i] - along));
    s.angular_momentum.set(i, spin + keeps * (s.angular_momentum[i] - spin));
  }
  world.dissipated -= both(s, a, b);
}

}  // namespace carom
