// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>

namespace carom {

/// Side of the plane through a, b, c on which p lies: +1 where a, b, c run counter-clockwise seen
/// from p, -1 on the other, 0 when the four are coplanar to 2^-98 of their size. Plain doubles with
/// a filter, then double-double. Source: J. R. Shewchuk, "Adaptive precision floating-point
/// arithmetic", 1997.
[[nodiscard]] int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c, const Eigen::Vector3d& p);

/// Where a segment goes through a triangle.
enum class Passage {
  none,    ///< it does not, or touches with an end, or lies in the plane
  inside,  ///< from one side to the other, off the rim
  ab,      ///< exactly through that edge
  bc,
  ca,
  corner,  ///< exactly through a corner
};

/// How the segment p q passes through the triangle a b c, by exact signs.
[[nodiscard]] Passage passage(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                              const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c);

/// For a segment p q through the edge a b of two triangles (a, b, c) and (b, a, d): whether p and q
/// lie strictly on different sides of the two. Touching along a face is not crossing.
[[nodiscard]] bool crosses_ridge(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                 const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& c, const Eigen::Vector3d& d);

}  // namespace carom
