// SPDX-License-Identifier: Apache-2.0
// Scenes that the contact tests share: SI units, ground at z = 0, gravity 9.81 down.
#pragma once
#include <algorithm>
#include <cmath>

#include "carom/step/simulation.hpp"

namespace carom::stage {

inline constexpr double g = 9.81;

inline Scene ground(double friction = 0.5) {
  Scene scene;
  scene.effects.push_back(UniformGravity{});
  BodyDefinition plane;
  plane.name = "ground";
  plane.shape = Plane{};
  plane.is_static = true;
  plane.friction = friction;
  scene.add(plane);
  return scene;
}

inline BodyDefinition box(const Eigen::Vector3d& position, double edge, double density = 1000) {
  BodyDefinition body;
  body.shape = Box{Eigen::Vector3d::Constant(edge)};
  body.density = density;
  body.pose.position = position;
  return body;
}

inline BodyDefinition ball(const Eigen::Vector3d& position, double radius, double density = 1000) {
  BodyDefinition body;
  body.shape = Sphere{radius};
  body.density = density;
  body.pose.position = position;
  return body;
}

/// Boxes of 0.5 m on top of one another; `density` gives each one's.
template <class Density>
Scene tower(int n, Density density) {
  Scene scene = ground();
  for (int i = 0; i < n; ++i) scene.add(box({0, 0, 0.25 + 0.5 * i}, 0.5, density(i)));
  return scene;
}

inline double mechanical(const Simulation& simulation) {
  return simulation.energy().kinetic + simulation.energy().potential;
}

/// By how much a step may add to the mechanical energy, J: contacts lift what overlaps, by no more
/// than its depth, and a contact that opens or closes is timed to a step, in which bodies fall by
/// g dt^2 / 2. So much height for all of the weight, and rounding.
inline double energy_of_a_step(const Simulation& simulation, double dt) {
  double mass = 0;
  for (const double m : simulation.states().mass) mass += m;
  return mass * g * (simulation.report().contact.deepest_overlap + 0.5 * g * dt * dt);
}

struct Stood {
  double drift = 0, sink = 0;  ///< m, of the worst body
  double overlap = 0;          ///< m, deepest seen
  double residual = 0;         ///< m/s
  std::int64_t gave_up = 0;
  double energy_gain = 0;  ///< J, largest rise of kinetic and potential above the start
};

/// How far bodies stray from where they start, in `seconds` of steps at 60 Hz.
inline Stood stand(Simulation& simulation, double seconds) {
  const Array3 start = simulation.states().position;
  const double energy = mechanical(simulation);
  Stood stood;
  for (int k = 0; k < static_cast<int>(std::lround(60 * seconds)); ++k) {
    simulation.step(1.0 / 60);
    stood.energy_gain = std::max(stood.energy_gain, mechanical(simulation) - energy);
  }
  for (int i = 0; i < simulation.size(); ++i) {
    const Eigen::Vector3d d = simulation.states().position[i] - start[i];
    stood.drift = std::max(stood.drift, d.head<2>().norm());
    stood.sink = std::max(stood.sink, std::abs(d.z()));
  }
  stood.overlap = simulation.report().contact.deepest_overlap;
  stood.residual = simulation.report().contact.residual;
  stood.gave_up = simulation.report().contact.gave_up;
  return stood;
}

}  // namespace carom::stage
