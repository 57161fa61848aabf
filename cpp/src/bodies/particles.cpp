// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/particles.hpp"

#include <string>

#include "carom/numerics/invalid_input.hpp"

#include "bodies/parallel_axis.hpp"

namespace carom {

void require_valid(const Particles& particles) {
  const Eigen::Index n = particles.positions.rows();
  if (n == 0) throw InvalidInput("positions", "none", "must hold a particle");
  if (particles.masses.size() != n)
    throw InvalidInput("masses", std::to_string(particles.masses.size()) + " masses",
                       "must be one for each of " + std::to_string(n) + " positions");
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::string row = std::string("[").append(std::to_string(i)).append("]");
    require_non_negative(particles.masses[i], "masses" + row, "kg");
    if (!particles.positions.row(i).allFinite())
      throw InvalidInput("positions" + row, with_unit(particles.positions.row(i), "m"),
                         "must be finite");
  }
  require_positive(particles.masses.sum(), "masses", "kg in all");
}

MassProperties mass_properties(const Particles& particles) {
  require_valid(particles);
  const Eigen::Matrix3d none = Eigen::Matrix3d::Zero();
  MassProperties body = gathered(
      particles.positions.rows(), [&](Eigen::Index i) { return particles.masses[i]; },
      [&](Eigen::Index i) { return particles.positions.row(i); },
      [&](Eigen::Index) -> const Eigen::Matrix3d& { return none; });
  if (!body.inertia.allFinite())
    throw InvalidInput("positions", "inertia infinite", "must give a finite inertia");
  return body;
}

Particles centred(const Particles& particles) {
  const MassProperties body = mass_properties(particles);
  return {particles.positions.rowwise() - body.com.transpose(), particles.masses};
}

Rows3 to_world(const Rows3& positions, const Pose& pose) {
  const Eigen::Matrix3d R_wb = pose.orientation.toRotationMatrix();
  return (positions * R_wb.transpose()).rowwise() + pose.position.transpose();
}

Rows3 to_object(const Rows3& positions, const Pose& pose) {
  const Eigen::Matrix3d R_wb = pose.orientation.toRotationMatrix();
  return (positions.rowwise() - pose.position.transpose()) * R_wb;
}

Rows3 rigid_velocities(const Rows3& world_positions, const Eigen::Vector3d& centre,
                       const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity) {
  Rows3 v(world_positions.rows(), 3);
  for (Eigen::Index i = 0; i < v.rows(); ++i)
    v.row(i) = (angular_velocity.cross(world_positions.row(i).transpose() - centre) + velocity)
                   .transpose();
  return v;
}

Eigen::Vector3d momentum(const Eigen::VectorXd& masses, const Rows3& velocities) {
  return velocities.transpose() * masses;
}

Eigen::Vector3d angular_momentum(const Eigen::VectorXd& masses, const Rows3& world_positions,
                                 const Rows3& velocities, const Eigen::Vector3d& about) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < velocities.rows(); ++i) {
    const Eigen::Vector3d arm = world_positions.row(i).transpose() - about;
    sum += masses[i] * arm.cross(velocities.row(i).transpose());
  }
  return sum;
}

double kinetic_energy(const Eigen::VectorXd& masses, const Rows3& velocities) {
  return 0.5 * masses.dot(velocities.rowwise().squaredNorm());
}

Wrench net_wrench(const Rows3& forces, const Rows3& world_positions, const Eigen::Vector3d& about) {
  Wrench net;
  for (Eigen::Index i = 0; i < forces.rows(); ++i) {
    const Eigen::Vector3d arm = world_positions.row(i).transpose() - about;
    net.force += forces.row(i).transpose();
    net.torque += arm.cross(forces.row(i).transpose());
  }
  return net;
}

}  // namespace carom
