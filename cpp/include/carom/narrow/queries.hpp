// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <limits>

#include "carom/geometry/shape.hpp"

namespace carom {

struct CastHit {
  bool hit = false;
  double distance = std::numeric_limits<double>::infinity();  ///< m along the direction
  Eigen::Vector3d point = Eigen::Vector3d::Zero();            ///< m, world
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();           ///< unit, world, out of the shape hit
};

struct ClosestPoints {
  double distance = std::numeric_limits<double>::infinity();             ///< m; negative: overlap
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero(), point_b = point_a;  ///< m, world
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, world, from a to b
};

/// First point of the ray origin + t direction, 0 <= t <= max_distance, on or in the shape.
/// `direction` is a unit vector. A ray that starts inside hits at 0.
[[nodiscard]] CastHit ray_cast(const Shape& shape, const Pose& pose, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction, double max_distance);

/// How far `moving` can be carried along a unit direction until it meets `shape`; point and normal
/// are of `shape`. Never beyond the first contact; short of it by tolerance::cast_gap at most.
[[nodiscard]] CastHit shape_cast(const Shape& moving, const Pose& start,
                                 const Eigen::Vector3d& direction, double max_distance,
                                 const Shape& shape, const Pose& pose);

/// Nearest points of two shapes no farther apart than `reach` m; distance is infinite beyond.
[[nodiscard]] ClosestPoints closest_points(const Shape& a, const Pose& pose_a, const Shape& b,
                                           const Pose& pose_b, double reach);

}  // namespace carom
