// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

namespace carom::contact {

enum class Branch : std::uint8_t { open, stick, slide };

/// Projection of z = (normal, two tangents) onto Coulomb's cone |t| <= mu n, and what it did.
struct ConeProjection {
  Eigen::Vector3d value;
  Branch branch;
};

[[nodiscard]] inline ConeProjection project_on_cone(const Eigen::Vector3d& z, double mu) {
  const double t = std::hypot(z.y(), z.z());
  if (mu > 0 && t <= mu * z.x()) return {z, Branch::stick};
  if (mu * t <= -z.x()) return {Eigen::Vector3d::Zero(), Branch::open};
  const double n = (z.x() + mu * t) / (1 + mu * mu);
  const double s = t > 0 ? mu * n / t : 0.0;
  return {{n, s * z.y(), s * z.z()}, Branch::slide};
}

/// Derivative of the projection at z: symmetric, eigenvalues in [0, 1].
[[nodiscard]] inline Eigen::Matrix3d cone_derivative(const Eigen::Vector3d& z, double mu,
                                                     Branch branch) {
  if (branch == Branch::stick) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d d = Eigen::Matrix3d::Zero();
  if (branch == Branch::open) return d;
  const double t = std::hypot(z.y(), z.z());
  const double share = 1 / (1 + mu * mu);
  d(0, 0) = share;
  if (!(t > 0)) return d;
  const Eigen::Vector2d along(z.y() / t, z.z() / t);
  const double across = mu * (z.x() + mu * t) * share / t;
  d.block<2, 1>(1, 0) = mu * share * along;
  d.block<1, 2>(0, 1) = d.block<2, 1>(1, 0).transpose();
  d.block<2, 2>(1, 1) =
      across * Eigen::Matrix2d::Identity() + (mu * mu * share - across) * along * along.transpose();
  return d;
}

/// What Coulomb's law says of impulse l: normal not below 0, tangent cut back to mu times it.
/// Unlike the cone projection its fixed points are Coulomb's, also where a contact slides.
[[nodiscard]] inline Eigen::Vector3d clamp_coulomb(Eigen::Vector3d l, double mu) {
  l.x() = std::max(l.x(), 0.0);
  const double t = std::hypot(l.y(), l.z()), bound = mu * l.x();
  if (t > bound) l.tail<2>() *= bound / t;
  return l;
}

}  // namespace carom::contact
