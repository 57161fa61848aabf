// SPDX-License-Identifier: Apache-2.0
// Where a distance grid and another body are nearest or overlap deepest. A search of a few steps on
// either body: the least of the grid's distance over the surface of the other, and the least of the
// distance to the other over the grid's own zero level. Both are joined, so that neither of the two
// bodies is preferred: a corner of either that pokes into a face of the other is found.
#pragma once
#include <algorithm>
#include <limits>

#include <Eigen/Core>

#include "carom/geometry/sdf.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {

/// A point of one body with its signed distance to the other.
struct Touch {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, along which the distance grows
  double gap = std::numeric_limits<double>::infinity();
};

[[nodiscard]] Touch touch(const SdfGrid& grid, const Eigen::Vector3d& x);

/// A point and, once it lies on the zero level, the way out of the body there, unit.
struct Level {
  Eigen::Vector3d x;
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
};

/// Takes the point to where the gradient leads on the zero level; false where it leads to none.
[[nodiscard]] bool onto_level(const SdfGrid& grid, Level& at);

/// Length of the next step down a gradient: that of the last one over the turn of the gradient
/// along it, which is the radius of what is met. A few steps where a fixed length takes hundreds.
/// Source: E. Birgin, J. Martinez, M. Raydan, SIAM J. Optim. 10(4), 2000, of J. Barzilai, J.
/// Borwein.
[[nodiscard]] inline double next_stride(const Eigen::Vector3d& way, const Eigen::Vector3d& turned,
                                        double last) {
  const double turn = way.dot(turned);
  return turn > 0 ? way.squaredNorm() / turn : tolerance::stride_on * last;
}

/// From a first touch to the nearest one: down the field of the grid and back onto a body. Never
/// uphill.
/// @param closest  moves q to the point of the body nearest to it
template <class Closest>
Touch settle(const SdfGrid& grid, Touch t, const Closest& closest) {
  const double still = tolerance::sdf_settled * grid.spacing;
  const double most = 0.5 * grid.box().extents().minCoeff();
  double stride = std::min(grid.spacing, most);
  for (int i = 0; i < tolerance::projections; ++i) {
    Eigen::Vector3d q = t.x - stride * t.normal;
    closest(q);
    const Touch next = touch(grid, q);
    const Eigen::Vector3d way = next.x - t.x;
    if (!(next.gap < t.gap)) {
      stride *= tolerance::stride_back;
      if (way.norm() <= still || stride <= still) break;
      continue;
    }
    stride = std::clamp(next_stride(way, next.normal - t.normal, stride), still, most);
    t = next;
    if (way.norm() <= still) break;
  }
  return t;
}

/// From a point of the zero level along it to where something else is nearest. A step is a cell at
/// most: farther from the level its gradient leads back to other points than the nearest. Never
/// uphill.
/// @param seen  x -> Touch: distance to what is sought
template <class Seen>
Touch settle_on_level(const SdfGrid& grid, const Eigen::Vector3d& start, const Seen& seen) {
  const double still = tolerance::sdf_settled * grid.spacing;
  Level at{start};
  if (!onto_level(grid, at)) return {};
  Touch t = seen(at.x);
  const auto along = [](const Touch& s, const Level& l) {
    return Eigen::Vector3d(s.normal - s.normal.dot(l.outward) * l.outward);
  };
  Eigen::Vector3d slope = along(t, at);
  double stride = grid.spacing;
  for (int i = 0; i < tolerance::projections; ++i) {
    const double length = slope.norm();
    if (!(length * stride > still)) break;
    stride = std::min(stride, grid.spacing / length);
    Level there{at.x - stride * slope};
    Touch next;
    if (onto_level(grid, there)) next = seen(there.x);
    if (!(next.gap < t.gap)) {
      stride *= tolerance::stride_back;
      continue;
    }
    const Eigen::Vector3d steeper = along(next, there);
    stride = std::max(next_stride(there.x - at.x, steeper - slope, stride), still);
    at = there, t = next, slope = steeper;
  }
  return t;
}

/// The same, its direction seen from `off` the other body. Where the two all but touch at an edge
/// or a corner, the way between them is as long as the error of the grid and points anywhere; from
/// within the grid the nearest point is the same, and the way long.
/// @param off  m, no more than the other body is convex over
template <class Seen>
Touch settle_on_level_seen_from(double off, const SdfGrid& grid, const Eigen::Vector3d& start,
                                const Seen& seen) {
  Touch t = settle_on_level(grid, start, seen);
  if (std::abs(t.gap) < grid.spacing)
    t.normal = seen(t.x - (off - t.gap) * touch(grid, t.x).normal).normal;
  return t;
}

/// A touch with its distance taken to the zero level, which is the surface: what is interpolated
/// in between is the worse the deeper a point lies in a round body, off by a tenth near edges, and
/// no more than a bound beyond the samples.
[[nodiscard]] Touch measured(const SdfGrid& grid, const Touch& t);

}  // namespace carom
