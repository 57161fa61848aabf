// SPDX-License-Identifier: Apache-2.0
// Schemes that iterate or work on matrices: one body at a time.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom::kernel {

/// The lecture's update R + h w* R with w = R diag(a) R^T l, not yet a rotation.
[[nodiscard]] Eigen::Matrix3d lecture_update(const Eigen::Matrix3d& r, const Eigen::Vector3d& l,
                                             const Eigen::Matrix3d& inverse_inertia_b, double h);

/// Orthonormal columns from left to right; the first keeps its direction: that is the bias.
[[nodiscard]] Eigen::Matrix3d gram_schmidt(const Eigen::Matrix3d& m);

/// The nearest rotation, by Newton's iteration m <- (m + m^-T)/2, which converges quadratically.
/// `converged` is cleared when tolerance::polar_iterations did not do.
/// Source: N. J. Higham, Functions of Matrices, 2008, section 8.3.
[[nodiscard]] Eigen::Matrix3d polar_rotation(const Eigen::Matrix3d& m, bool& converged);

/// q_new = exp(phi) exp(phi) q with phi = h/2 w(exp(phi) q), to rounding: symmetric, so reversible.
/// Solved by Newton's iteration without the curvature of exp in its Jacobian.
[[nodiscard]] Eigen::Quaterniond implicit_midpoint(const Eigen::Quaterniond& q,
                                                   const Eigen::Vector3d& l,
                                                   const Eigen::Vector3d& inverse_moments, double h,
                                                   bool& converged);

}  // namespace carom::kernel
