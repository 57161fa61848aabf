// SPDX-License-Identifier: Apache-2.0
#include "contact/scratch.hpp"

#include <Eigen/Geometry>

namespace carom::contact {

void BodyFrames::resize(int n) {
  inverse_inertia.resize(n);
  velocity.resize(n), omega.resize(n);
  velocity_before.resize(n), omega_before.resize(n);
}

void BodyFrames::set(int i, const BodyStates& states, const Array3& velocity_before_of,
                     const Array3& angular_momentum_before) {
  velocity[i] = states.velocity[i];
  if (!states.moves[i]) {
    inverse_inertia[i].setZero();
    omega[i] = states.angular_velocity(i);
    velocity_before[i] = velocity[i], omega_before[i] = omega[i];
    return;
  }
  const Eigen::Matrix3d r = states.orientation[i].toRotationMatrix();
  const Eigen::Vector3d inverse = states.inverse_moments[i];
  inverse_inertia[i] = r * inverse.asDiagonal() * r.transpose();
  omega[i] = r * inverse.cwiseProduct(r.transpose() * states.angular_momentum[i]);
  velocity_before[i] = velocity_before_of[i];
  omega_before[i] = r * inverse.cwiseProduct(r.transpose() * angular_momentum_before[i]);
}

}  // namespace carom::contact
