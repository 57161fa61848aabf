// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/bodies/mass_properties.hpp"

namespace carom {

/// Integrals of density times 1, x, y, z, xx, yy, zz, xy, yz, zx and the covariance of their
/// estimates.
struct SampledMoments {
  using Vector = Eigen::Matrix<double, 10, 1>;
  using Matrix = Eigen::Matrix<double, 10, 10>;
  Vector value = Vector::Zero();
  Matrix covariance = Matrix::Zero();
  long samples = 0;

  [[nodiscard]] static Vector basis(const Eigen::Vector3d& p) {
    return (Vector() << 1, p.x(), p.y(), p.z(), p.x() * p.x(), p.y() * p.y(), p.z() * p.z(),
            p.x() * p.y(), p.y() * p.z(), p.z() * p.x())
        .finished();
  }
};

/// Mass, centre and inertia with their standard errors; positions were (x - centre) / half.
[[nodiscard]] MassProperties body_of(const SampledMoments& moments, const Eigen::Vector3d& centre,
                                     const Eigen::Vector3d& half);

}  // namespace carom
