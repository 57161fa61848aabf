// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>

#include "carom/geometry/convex.hpp"

namespace carom {

/// Where a point lies to the surface of a body.
struct PointDistance {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< m, nearest of the surface
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, outward there
  double distance = 0;                                ///< m, negative inside
};

/// Of a point to a convex body, both in its frame, to rounding: in closed form, but for an
/// ellipsoid (Newton's method, quadratic from its first step) and the outside of a hull (GJK).
[[nodiscard]] PointDistance point_distance(const Convex& body, const Eigen::Vector3d& p);

}  // namespace carom
