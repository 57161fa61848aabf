// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <limits>

#include <Eigen/Core>

namespace carom {

/// Axis-aligned box, closed. Starts empty: lower > upper.
struct Aabb {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Eigen::Vector3d& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  void extend(const Aabb& other) {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
  [[nodiscard]] bool contains(const Aabb& other) const {
    return (lower.array() <= other.lower.array()).all() &&
           (other.upper.array() <= upper.array()).all();
  }
  [[nodiscard]] bool overlaps(const Aabb& other) const {
    return (lower.array() <= other.upper.array()).all() &&
           (other.lower.array() <= upper.array()).all();
  }
  [[nodiscard]] bool empty() const { return !(lower.array() <= upper.array()).all(); }
  [[nodiscard]] Eigen::Vector3d centre() const { return 0.5 * (lower + upper); }
  [[nodiscard]] Eigen::Vector3d extents() const { return upper - lower; }
  [[nodiscard]] Aabb inflated(double margin) const {
    return {lower.array() - margin, upper.array() + margin};
  }
};

}  // namespace carom
