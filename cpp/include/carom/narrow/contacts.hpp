// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "carom/geometry/frame.hpp"
#include "carom/geometry/shape.hpp"

namespace carom {

/// One point of a contact patch.
struct ContactPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, world, midway between the surfaces
  double separation = 0;                               ///< m along the normal; negative: overlap
  std::uint32_t feature = 0;  ///< names the meeting features, so that impulses keep over steps
};

/// Where two shapes touch or nearly touch: at most four points that carry the patch.
struct Manifold {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, world, from shape a towards shape b
  int count = 0;
  std::array<ContactPoint, 4> points;
};

/// All contacts of two shapes at their poses, appended to `out`: one manifold per direction in
/// which they meet (one for convex shapes; a ball in a corner has three). Points farther apart than
/// `margin` (m, >= 0) are left out. Allocates nothing once warm.
void collide(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double margin,
             std::vector<Manifold>& out);
/// The same for poses whose rotations are matrices already.
void collide(const Shape& a, const Frame& frame_a, const Shape& b, const Frame& frame_b,
             double margin, std::vector<Manifold>& out);

/// The manifold that holds the deepest point, for pairs that meet in one direction.
[[nodiscard]] Manifold collide(const Shape& a, const Pose& pose_a, const Shape& b,
                               const Pose& pose_b, double margin);

}  // namespace carom
