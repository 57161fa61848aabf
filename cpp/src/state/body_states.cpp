// SPDX-License-Identifier: Apache-2.0
#include "carom/state/body_states.hpp"

#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

template <class... Vectors>
void erase_row(int i, Vectors&... vectors) {
  (vectors.erase(vectors.begin() + i), ...);
}

Eigen::Vector3d pseudo_inverse(const Eigen::Vector3d& moments) {
  // A rod resists nothing about its axis, a point nothing at all: those axes carry no momentum.
  const double least = tolerance::inertia_rank * moments.maxCoeff();
  return moments.unaryExpr([&](double m) { return m > least ? 1 / m : 0.0; });
}

}  // namespace

void Array3::push_back(const Eigen::Vector3d& v) {
  x.push_back(v.x());
  y.push_back(v.y());
  z.push_back(v.z());
}
void Array3::erase(int i) {
  erase_row(i, x, y, z);
}

void Array4::push_back(const Eigen::Quaterniond& q) {
  x.push_back(q.x());
  y.push_back(q.y());
  z.push_back(q.z());
  w.push_back(q.w());
}
void Array4::erase(int i) {
  erase_row(i, x, y, z, w);
}

void BodyStates::push_back(const MassProperties& properties, bool is_mover, const Pose& pose,
                           const Eigen::Vector3d& linear, const Eigen::Vector3d& angular) {
  const PrincipalAxes principal = is_mover ? principal_axes(properties.inertia) : PrincipalAxes{};
  mass.push_back(is_mover ? properties.mass : 0);
  inverse_mass.push_back(is_mover ? 1 / properties.mass : 0);
  moments.push_back(principal.moments);
  inverse_moments.push_back(pseudo_inverse(principal.moments));
  com_b.push_back(is_mover ? properties.com : Eigen::Vector3d::Zero());
  axes_b.push_back(principal.axes);
  moves.push_back(is_mover);
  position.push_back({});
  velocity.push_back({});
  orientation.push_back({});
  angular_momentum.push_back({});
  set(size() - 1, pose, linear, angular);
}

void BodyStates::erase(int i) {
  for (Array3* a : {&position, &velocity, &angular_momentum, &moments, &inverse_moments, &com_b})
    a->erase(i);
  for (Array4* a : {&orientation, &axes_b}) a->erase(i);
  erase_row(i, mass, inverse_mass, moves);
}

void BodyStates::set(int i, const Pose& pose, const Eigen::Vector3d& linear,
                     const Eigen::Vector3d& angular) {
  const Eigen::Vector3d arm = pose.orientation * com_b[i];
  const Eigen::Quaterniond q_wp = pose.orientation * axes_b[i];
  const Eigen::Vector3d omega_p = q_wp.conjugate() * angular;
  position.set(i, pose.position + arm);
  velocity.set(i, linear + angular.cross(arm));
  orientation.set(i, q_wp);
  angular_momentum.set(i, q_wp * moments[i].cwiseProduct(omega_p));
}

Pose BodyStates::pose(int i) const {
  const Eigen::Quaterniond q_wb = orientation[i] * axes_b[i].conjugate();
  return {position[i] - q_wb * com_b[i], q_wb};
}

Eigen::Vector3d BodyStates::angular_velocity(int i) const {
  const Eigen::Quaterniond q_wp = orientation[i];
  const Eigen::Vector3d momentum_p = q_wp.conjugate() * angular_momentum[i];
  return q_wp * inverse_moments[i].cwiseProduct(momentum_p);
}

double BodyStates::angular_speed(int i) const {
  return inverse_moments[i].cwiseProduct(orientation[i].conjugate() * angular_momentum[i]).norm();
}

Eigen::Matrix3d BodyStates::world_inverse_inertia(int i) const {
  const Eigen::Matrix3d R_wp = orientation[i].toRotationMatrix();
  return R_wp * inverse_moments[i].asDiagonal() * R_wp.transpose();
}

Eigen::Vector3d BodyStates::velocity_at(int i, const Eigen::Vector3d& point) const {
  return velocity[i] + angular_velocity(i).cross(point - position[i]);
}

double BodyStates::kinetic_energy(int i) const {
  return 0.5 * mass[i] * velocity[i].squaredNorm() +
         0.5 * angular_velocity(i).dot(angular_momentum[i]);
}

}  // namespace carom
