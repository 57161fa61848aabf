// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "carom/bodies/mass_properties.hpp"
#include "carom/step/integrators.hpp"

namespace carom {

enum class FlightStatus : std::uint8_t {
  ok,
  clamped,        ///< a square-root step beyond |h w| = 2: half a turn was the most it could do
  iteration_cap,  ///< an implicit step or a polar decomposition stopped unconverged
  step_cap,       ///< more steps needed than tolerance::flight_steps
  below_rounding  ///< the tolerance asked for is below what double precision allows here
};
/// Lower-case name as printed: "ok", "clamped", ...
[[nodiscard]] std::string_view name_of(FlightStatus status);

struct FreeFlight {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body frame to world
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       ///< rad/s, world axes
  FlightStatus status = FlightStatus::ok;
  /// rad, estimate of the final orientation's error: from taylor and exact always, from the others
  /// when a tolerance was given; else NaN.
  double error = std::numeric_limits<double>::quiet_NaN();
  std::int64_t steps = 0;  ///< taken (the last try, where the tolerance chose them)
};

/// Flies a body without force or torque; gravity through the centre of mass changes nothing here.
///
/// @param orientation       body frame to world
/// @param angular_velocity  rad/s, world axes
/// @param seconds           s; negative flies backwards
/// @param steps             >= 1, equal; taylor takes at least as many, exact needs none
/// @param tolerance         rad, > 0, of the final orientation: fixed-step methods double their
///                          steps until the difference between two tries, scaled by their order, is
///                          within it; taylor aims at it (1e-12 where none is given)
/// @throws InvalidInput
[[nodiscard]] FreeFlight integrate_free(const MassProperties& body,
                                        const Eigen::Quaterniond& orientation,
                                        const Eigen::Vector3d& angular_velocity, double seconds,
                                        std::int64_t steps = 1,
                                        Integrator method = Integrator::symmetric_top,
                                        std::optional<double> tolerance = {});

}  // namespace carom
