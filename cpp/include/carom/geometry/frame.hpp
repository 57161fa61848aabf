// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>

#include "carom/geometry/shape.hpp"

namespace carom {

/// A pose with its rotation as a matrix, for code that moves many points.
struct Frame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< m

  Frame() = default;
  Frame(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) : rotation(R), translation(t) {}
  explicit Frame(const Pose& pose)
      : rotation(pose.orientation.toRotationMatrix()), translation(pose.position) {}

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& x) const {
    return rotation * x + translation;
  }
  [[nodiscard]] Frame operator*(const Frame& inner) const {
    return {rotation * inner.rotation, rotation * inner.translation + translation};
  }
  [[nodiscard]] Eigen::Vector3d to_local(const Eigen::Vector3d& x) const {
    return rotation.transpose() * (x - translation);
  }
  [[nodiscard]] Frame inverse() const {
    return {rotation.transpose(), -(rotation.transpose() * translation)};
  }
};

/// Frame of b seen from a: x_a = relative * x_b. The difference of the two positions is taken
/// first, so that what is left of it far from the origin is only the rounding of the positions.
[[nodiscard]] inline Frame relative(const Frame& a, const Frame& b) {
  return {a.rotation.transpose() * b.rotation,
          a.rotation.transpose() * (b.translation - a.translation)};
}

}  // namespace carom
