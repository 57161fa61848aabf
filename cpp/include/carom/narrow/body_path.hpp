// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "carom/geometry/frame.hpp"

namespace carom {

/// How a body gets from `start` to the end of a step: its centre of mass on a parabola, its frame
/// through arcs of constant rate. Times are seconds within the step.
struct BodyPath {
  /// Holds from its time to that of the next arc.
  struct Arc {
    double time = 0;                                                  ///< s
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to world, at `time`
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();                   ///< rad/s, world axes
  };

  double start = 0;                                        ///< s
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();        ///< m, of mass, at `start`
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< m/s, at `start`
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< m/s^2
  Eigen::Vector3d com_b = Eigen::Vector3d::Zero();         ///< m, centre of mass in the body frame
  std::vector<Arc> arcs;                                   ///< at least one, ascending in time

  [[nodiscard]] const Arc& arc_at(double t) const;
  /// End of the arc that holds at t, or `end` where that comes first.
  [[nodiscard]] double arc_end(double t, double end) const;
  [[nodiscard]] Eigen::Vector3d centre_at(double t) const;
  [[nodiscard]] Eigen::Vector3d velocity_at(double t) const {
    return velocity + (t - start) * acceleration;
  }
  [[nodiscard]] Pose pose_at(double t) const;  ///< of the body frame
  [[nodiscard]] bool moves() const;
  /// Box of the way of the centre between two times.
  [[nodiscard]] Aabb centre_bounds(double from, double to) const;
};

}  // namespace carom
