// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include <Eigen/Core>

namespace carom {

/// A contact point as the solver takes it and leaves it: geometry in, impulses out.
///
/// Consecutive points of the same two bodies and the same normal form one patch.
struct Contact {
  int a = 0, b = 0;                                    ///< rows
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< from a to b, unit
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, world
  double separation = 0;                               ///< m, at the start of the step
  double friction = 0;                                 ///< of the pair
  double restitution = 0;                              ///< of the pair
  double rolling_resistance = 0;                       ///< m, of the pair
  double spinning_resistance = 0;                      ///< m, of the pair
  std::uint32_t feature = 0;
  /// N s on b over the step, world axes; going in: where the solver starts.
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  /// N m s on b, turning impulse of rolling and spinning resistance; zero where none was asked for.
  Eigen::Vector3d turning_impulse = Eigen::Vector3d::Zero();
  /// N s: what would act over a whole step at the rate of its end. The next step starts from it.
  Eigen::Vector3d impulse_at_end = Eigen::Vector3d::Zero();
  double dissipated = 0;  ///< J taken out of the two bodies by this point in the step
};

}  // namespace carom
