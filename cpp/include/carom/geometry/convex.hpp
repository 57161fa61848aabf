// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <span>

#include <Eigen/Core>

#include "carom/geometry/polytope.hpp"
#include "carom/geometry/shape.hpp"

namespace carom {

/// A convex body seen through its support function, in its own frame: a core, grown by `radius`.
/// A ball is a point grown, a capsule a segment grown. Holds no memory: what it points to must
/// live.
struct Convex {
  enum class Kind { points, box, cylinder, cone, ellipsoid };

  Kind kind = Kind::points;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< m: half extents; radius, radius, half length
  double radius = 0;                               ///< m, of the growth
  std::span<const Eigen::Vector3d> points;         ///< of Kind::points: the core is their hull
  const Polytope* polytope = nullptr;              ///< the faces of those points, where known
  Eigen::Vector3d ends[2];                         ///< the core of a ball (one) or capsule (both)
  int end_count = 0;

  [[nodiscard]] static Convex point(const Eigen::Vector3d& at, double radius = 0);
  [[nodiscard]] static Convex segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                      double radius = 0);
  [[nodiscard]] static Convex hull(std::span<const Eigen::Vector3d> points);
  [[nodiscard]] static Convex hull(const Polytope& polytope);

  /// Corners of the core where it has any: the ends or the points.
  [[nodiscard]] std::span<const Eigen::Vector3d> corners() const {
    return end_count > 0 ? std::span(ends, static_cast<std::size_t>(end_count)) : points;
  }
  /// Point of the core farthest along a direction of any length > 0.
  [[nodiscard]] Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
  /// Second derivative of the support function h(n) = n . support(n) of the core at a unit n: how
  /// the support point moves as n turns. Zero where it stays on a corner.
  [[nodiscard]] Eigen::Matrix3d support_derivative(const Eigen::Vector3d& n) const;
  /// Radius of a ball about the origin of the frame that holds body and growth, m.
  [[nodiscard]] double bounding_radius() const;
  /// True when corners are all there is: the answers of a simplex search are then exact.
  [[nodiscard]] bool is_polyhedral() const { return kind == Kind::points || kind == Kind::box; }
};

/// The convex body that a shape is; nothing for a plane, a mesh that is not convex and the like.
/// The shape must outlive it.
[[nodiscard]] std::optional<Convex> convex_of(const Shape& shape);

}  // namespace carom
