// SPDX-License-Identifier: Apache-2.0
// What can be read off a simulation: poses, twists, energy, momentum.
#include "carom/numerics/invalid_input.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

void require_room(std::span<const double> out, int rows, int columns) {
  if (out.size() != static_cast<std::size_t>(rows) * columns)
    throw InvalidInput("out", std::to_string(out.size()) + " doubles",
                       "must hold " + std::to_string(rows) + " x " + std::to_string(columns));
}

}  // namespace

Eigen::Vector3d gravity_of(const World& world) {
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  for (const Effect& effect : world.scene.effects)
    if (const auto* gravity = std::get_if<UniformGravity>(&effect)) g += gravity->acceleration;
  return g;
}

void Simulation::poses(std::span<double> out) const {
  require_room(out, size(), 7);
  for (int i = 0; i < size(); ++i) {
    const Pose pose = world_->states.pose(i);
    Eigen::Vector3d::Map(&out[7 * i]) = pose.position;
    Eigen::Vector4d::Map(&out[7 * i + 3]) = pose.orientation.coeffs();  // x y z w
  }
}

void Simulation::twists(std::span<double> out) const {
  require_room(out, size(), 6);
  for (int i = 0; i < size(); ++i) {
    Eigen::Vector3d::Map(&out[6 * i]) =
        world_->states.velocity_at(i, world_->states.pose(i).position);
    Eigen::Vector3d::Map(&out[6 * i + 3]) = world_->states.angular_velocity(i);
  }
}

Energy Simulation::energy() const {
  Energy energy{
      .dissipated = world_->dissipated, .work = world_->work, .repulsion = world_->repulsion};
  const Eigen::Vector3d g = gravity_of(*world_);
  for (int i = 0; i < size(); ++i) {
    energy.kinetic += world_->states.kinetic_energy(i);
    energy.potential -= world_->states.mass[i] * g.dot(world_->states.position[i]);
  }
  for (const Effect& effect : world_->scene.effects)
    if (const auto* spring = std::get_if<TorsionSpring>(&effect))
      energy.potential += 0.5 * spring->stiffness * twist_of(*world_, *spring).squaredNorm();
  return energy;
}

Eigen::Vector3d Simulation::momentum() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < size(); ++i) sum += world_->states.mass[i] * world_->states.velocity[i];
  return sum;
}

Eigen::Vector3d Simulation::angular_momentum() const {
  const BodyStates& s = world_->states;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < size(); ++i)
    sum += s.angular_momentum[i] + s.position[i].cross(s.mass[i] * s.velocity[i]);
  return sum;
}

}  // namespace carom
