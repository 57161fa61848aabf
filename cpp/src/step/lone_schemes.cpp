// SPDX-License-Identifier: Apache-2.0
#include "step/lone_schemes.hpp"

#include <Eigen/LU>

#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom::kernel {

Eigen::Matrix3d lecture_update(const Eigen::Matrix3d& r, const Eigen::Vector3d& l,
                               const Eigen::Matrix3d& inverse_inertia_b, double h) {
  const Eigen::Vector3d w = r * (inverse_inertia_b * (r.transpose() * l));
  Eigen::Matrix3d next;
  for (int k = 0; k < 3; ++k) next.col(k) = r.col(k) + h * w.cross(r.col(k));
  return next;
}

Eigen::Matrix3d gram_schmidt(const Eigen::Matrix3d& m) {
  Eigen::Matrix3d r;
  r.col(0) = m.col(0).normalized();
  r.col(1) = (m.col(1) - r.col(0).dot(m.col(1)) * r.col(0)).normalized();
  r.col(2) = r.col(0).cross(r.col(1));  // what is left of m.col(2), with det = +1 for certain
  return r;
}

Eigen::Matrix3d polar_rotation(const Eigen::Matrix3d& m, bool& converged) {
  Eigen::Matrix3d r = m;
  for (int i = 0; i < tolerance::polar_iterations; ++i) {
    Eigen::Matrix3d cofactors;
    cofactors.col(0) = r.col(1).cross(r.col(2));
    cofactors.col(1) = r.col(2).cross(r.col(0));
    cofactors.col(2) = r.col(0).cross(r.col(1));
    const Eigen::Matrix3d next = 0.5 * (r + cofactors / r.col(0).dot(cofactors.col(0)));
    const double change = (next - r).lpNorm<Eigen::Infinity>();
    r = next;
    // Quadratic: the next change would be about the square of this one.
    if (change <= tolerance::newton_last_change) return r;
  }
  converged = false;
  return r;
}

Eigen::Quaterniond implicit_midpoint(const Eigen::Quaterniond& q, const Eigen::Vector3d& l,
                                     const Eigen::Vector3d& inverse_moments, double h,
                                     bool& converged) {
  const auto velocity_at = [&](const Eigen::Matrix3d& r) -> Eigen::Vector3d {
    return r * inverse_moments.cwiseProduct(r.transpose() * l);
  };
  Eigen::Vector3d phi = 0.5 * h * velocity_at(q.toRotationMatrix());
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tolerance::implicit_iterations; ++i) {
    const Eigen::Matrix3d r = (rotation_exponential(phi) * q).toRotationMatrix();
    const Eigen::Vector3d w = velocity_at(r);
    // A turn e of the body changes w by e x w - A (e x l).
    const Eigen::Matrix3d a = r * inverse_moments.asDiagonal() * r.transpose();
    const Eigen::Matrix3d jacobian =
        Eigen::Matrix3d::Identity() + 0.5 * h * (skew(w) - a * skew(l));
    const Eigen::Vector3d change = jacobian.inverse() * (0.5 * h * w - phi);
    phi += change;
    const double size = change.norm();
    const double floor = 8 * tolerance::unit_roundoff * (1 + phi.norm());
    if (size <= floor || (size >= last && size <= 64 * floor)) {
      const Eigen::Quaterniond turn = rotation_exponential(phi);
      return (turn * (turn * q)).normalized();
    }
    last = size;
  }
  converged = false;
  const Eigen::Quaterniond turn = rotation_exponential(phi);
  return (turn * (turn * q)).normalized();
}

}  // namespace carom::kernel
