// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom {

struct TaylorFlight {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  double truncation = 0;   ///< rad, bound on what the dropped terms did by the end, to first order
  double rounding = 0;     ///< rad, estimate (3 sigma) of what rounding did by the end
  std::int64_t steps = 0;  ///< of the last pass
  bool capped = false;     ///< stopped at tolerance::taylor_steps steps, short of the end

  [[nodiscard]] double error() const { return truncation + rounding; }
};

/// A free rigid body by its Taylor series of order 16, in steps as long as the tolerance allows.
///
/// Each step's local error is carried to the end by the linearised motion e' = A (L x e), A the
/// world inverse inertia: so the estimate knows of shear and of the unstable axis. Where it exceeds
/// the tolerance the flight is flown again with smaller steps; a tolerance below rounding is not
/// reached, and error() says so.
/// @param orientation       principal frame to world, unit
/// @param angular_momentum  kg m^2/s, world axes
/// @param inverse_moments   1/(kg m^2); 0 about an axis that resists nothing
/// @param tolerance         rad, > 0, of the final orientation
/// @param least_steps       at least that many
[[nodiscard]] TaylorFlight taylor_flight(const Eigen::Quaterniond& orientation,
                                         const Eigen::Vector3d& angular_momentum,
                                         const Eigen::Vector3d& inverse_moments, double seconds,
                                         double tolerance, std::int64_t least_steps = 1);

}  // namespace carom
