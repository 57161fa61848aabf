// SPDX-License-Identifier: Apache-2.0
// Where a distance grid and another body are nearest or overlap deepest. A search of a few steps on
// either body: the least of the grid's distance over the surface of the other, and the least of the
// distance to the other over the grid's own zero level. Both are joined, so that neither of the two
// bodies is preferred: a corner of either that pokes into a face of the other is found.
#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

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

/// The point of the zero level that the gradient leads to from p; false where it leads to none.
[[nodiscard]] bool onto_level(const SdfGrid& grid, Eigen::Vector3d& p);

/// The point of the grid's surface mesh with the least gap(x), a signed distance. Best first: of a
/// box of them, none is nearer than its middle less its half diagonal.
/// @param least  that gap, m; infinite when no box overlaps `near`
template <class Gap>
Eigen::Vector3d nearest_vertex(const SdfGrid& grid, const Aabb& near, const Gap& gap,
                               double& least) {
  const MeshTree& tree = grid.surface->tree;
  const double inf = std::numeric_limits<double>::infinity();
  const auto bound = [&](int i) {
    const Aabb& box = tree.nodes[i].box;
    return box.overlaps(near) ? gap(box.centre()) - 0.5 * box.extents().norm() : inf;
  };
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  least = inf;
  std::array<std::pair<double, int>, 128> stack;  // depth is log2 of the faces: 2 x 64 is never met
  int top = 0;
  stack[top++] = {bound(0), 0};
  while (top > 0) {
    const auto [low, i] = stack[--top];
    if (!(low < least)) continue;
    const MeshTree::Node& node = tree.nodes[i];
    for (int k = 0; k < node.count; ++k)
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d v = grid.surface->corner(tree.order[node.first + k], c);
        if (const double d = gap(v); d < least) least = d, best = v;
      }
    if (node.count > 0) continue;
    std::pair<double, int> one{bound(i + 1), i + 1}, two{0, tree.nodes[i + 1].end};
    two.first = bound(two.second);
    if (one.first < two.first) std::swap(one, two);
    stack[top++] = one;
    stack[top++] = two;  // the nearer is looked at first
  }
  return best;
}

/// From a first touch to the nearest one: down the gradient and back onto the body.
/// @param seen     x -> Touch: distance to the other body there
/// @param closest  q -> (found, point of the body near q)
///
/// The length of a step is that of the last one over the turn of the gradient along it, which is
/// the radius of what is met: a few steps where a fixed length takes hundreds. Never uphill.
/// Source: E. Birgin, J. Martinez, M. Raydan, SIAM J. Optim. 10(4), 2000, of J. Barzilai, J.
/// Borwein.
template <class Seen, class Closest>
Touch settle(const SdfGrid& grid, Touch t, const Seen& seen, const Closest& closest) {
  const double still = tolerance::sdf_settled * grid.spacing;
  const double most = 0.5 * grid.box().extents().minCoeff();
  double stride = std::min(grid.spacing, most);
  for (int i = 0; i < tolerance::projections; ++i) {
    Eigen::Vector3d q = t.x - stride * t.normal;
    Touch next;
    if (closest(q)) next = seen(q);
    const Eigen::Vector3d way = next.x - t.x;
    if (!(next.gap < t.gap)) {
      stride *= 0.25;
      if (way.norm() <= still || stride <= still) break;
      continue;
    }
    const double turn = way.dot(next.normal - t.normal);
    t = next;
    if (way.norm() <= still) break;
    stride = std::clamp(turn > 0 ? way.squaredNorm() / turn : 4 * stride, still, most);
  }
  return t;
}

/// The same with its distance taken to the zero level, which is the surface: what is interpolated
/// in between is the worse the deeper a point lies in a round body, and no more than a bound beyond
/// the samples. Within a cell of the level the two are one.
[[nodiscard]] Touch measured(const SdfGrid& grid, const Touch& t);

}  // namespace carom
