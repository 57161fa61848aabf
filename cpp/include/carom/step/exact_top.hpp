// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom {

struct ExactFlight {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  double error = 0;  ///< rad, estimate: rounding, stretched where the unstable axis stretches it
};

/// Where a free rigid body is after `seconds`, by Jacobi's elliptic functions: the price is the
/// same for any jump. Near the unstable axis it stays right where every stepping method loses all
/// digits, because it never computes 1 - m from m. Symmetric bodies, rods and points take the
/// trigonometric form.
/// @param orientation       principal frame to world
/// @param angular_momentum  kg m^2/s, world axes
/// @param inverse_moments   1/(kg m^2), in any order; 0 about an axis that resists nothing
/// Source: E. T. Whittaker, Analytical Dynamics, sections 69 and 70; R. van Zon and J. Schofield,
/// J. Comput. Phys. 225, 2007; the third-kind integrals by Carlson instead of theta series.
[[nodiscard]] ExactFlight exact_flight(const Eigen::Quaterniond& orientation,
                                       const Eigen::Vector3d& angular_momentum,
                                       const Eigen::Vector3d& inverse_moments, double seconds);

}  // namespace carom
