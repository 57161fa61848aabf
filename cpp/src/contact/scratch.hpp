// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include <Eigen/Core>

#include "carom/contact/contact.hpp"
#include "carom/state/body_states.hpp"

namespace carom::contact {

/// What every part of the solver asks of a body, worked out once per step; row i is body i.
struct BodyFrames {
  std::vector<Eigen::Matrix3d> inverse_inertia;  ///< 1/(kg m^2), world axes
  std::vector<Eigen::Vector3d> velocity, omega;  ///< m/s, rad/s with the step's forces
  std::vector<Eigen::Vector3d> velocity_before, omega_before;  ///< without them

  void resize(int n);
  void set(int i, const BodyStates& states, const Array3& velocity_before,
           const Array3& angular_momentum_before);
};

/// Mean of the diagonal of J M^-1 J^T of a point, 1/kg, one body's part.
[[nodiscard]] inline double mobility(double inverse_mass, const Eigen::Matrix3d& inverse_inertia,
                                     const Eigen::Vector3d& arm) {
  const double turn = arm.squaredNorm() * inverse_inertia.trace() - arm.dot(inverse_inertia * arm);
  return inverse_mass + turn / 3;
}

/// The same along a unit direction.
[[nodiscard]] inline double mobility_along(double inverse_mass,
                                           const Eigen::Matrix3d& inverse_inertia,
                                           const Eigen::Vector3d& arm,
                                           const Eigen::Vector3d& direction) {
  const Eigen::Vector3d x = arm.cross(direction);
  return inverse_mass + x.dot(inverse_inertia * x);
}

/// Right-handed axes with the given first column, unit. Duff et al. 2017, without a branch to jump
/// at but the sign of z.
[[nodiscard]] inline Eigen::Matrix3d frame_about(const Eigen::Vector3d& n) {
  const double sign = n.z() < 0 ? -1.0 : 1.0;
  const double a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  Eigen::Matrix3d m;
  m.col(0) = n;
  m.col(1) << 1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x();
  m.col(2) << b, sign + n.y() * n.y() * a, -n.y();
  return m;
}

}  // namespace carom::contact
