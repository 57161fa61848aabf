// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>

namespace carom {

/// Which part of a triangle a point of it lies on: a corner, the edge that starts at a corner, or
/// the inside.
enum class TriangleFeature { corner0, corner1, corner2, edge0, edge1, edge2, face };

struct TrianglePoint {
  Eigen::Vector3d point;
  TriangleFeature feature;
};

/// Point of the triangle a b c closest to p. A triangle without area is its longest edge or a
/// point. Source: C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5.
[[nodiscard]] TrianglePoint closest_point(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                          const Eigen::Vector3d& b, const Eigen::Vector3d& c);

struct SegmentPoints {
  double s, t;           ///< fractions along each segment, in [0, 1]
  Eigen::Vector3d p, q;  ///< the closest points
};

/// Closest points of the segments p0 p1 and q0 q1; either may be a point. Of parallel segments, one
/// of the closest pairs.
[[nodiscard]] SegmentPoints closest_points(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
                                           const Eigen::Vector3d& q0, const Eigen::Vector3d& q1);

}  // namespace carom
