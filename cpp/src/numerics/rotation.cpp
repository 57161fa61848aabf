// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/rotation.hpp"

#include <cmath>
#include <numbers>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {

Eigen::Quaterniond rotation_exponential(const Eigen::Vector3d& phi) {
  const double angle = phi.stableNorm();
  if (!(angle > 0)) return Eigen::Quaterniond::Identity();
  const double s = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * phi.x(), s * phi.y(), s * phi.z()};
}

Eigen::Vector3d rotation_logarithm(const Eigen::Quaterniond& q) {
  const double s = q.vec().stableNorm();
  if (!(s > 0)) return Eigen::Vector3d::Zero();
  // atan2 keeps its digits at both ends, where acos(w) loses half of them.
  const double angle = 2 * std::atan2(s, std::abs(q.w()));
  return std::copysign(angle / s, q.w()) * q.vec();
}

double rotation_angle(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return rotation_logarithm(a.conjugate() * b).norm();
}

Eigen::Quaterniond unit_quaternion(const Eigen::Vector4d& xyzw, std::string_view field) {
  const double length = xyzw.norm();
  if (!(std::abs(length - 1) <= tolerance::quaternion_norm))
    throw InvalidInput(field, with_unit(xyzw.transpose(), ""), "must be a unit quaternion x y z w",
                       "no rotation is 0 0 0 1");
  return Eigen::Quaterniond(xyzw / length);
}

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace carom
