// SPDX-License-Identifier: Apache-2.0
// What a pair with a distance grid gathers: the touches that searches found, and what carries a
// body beside them.
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "carom/geometry/frame.hpp"

#include "geometry/features.hpp"
#include "narrow/candidates.hpp"
#include "narrow/sdf_touch.hpp"
#include "narrow/sdf_vertices.hpp"

namespace carom {

struct SdfPatch {
  std::vector<Candidate> found;
  std::vector<NearVertex> near;  ///< of the grid that is searched

  /// A point of the other body, `radius` m inside it.
  void add(const Touch& t, double radius, std::uint32_t name);
  /// What the two searches found. Where they agree but for the error of the grid they are one
  /// point, which changes from one to the other little by little; the overlap is that of the
  /// deeper.
  /// @param on_other  a point of the other body, its distance to the grid
  /// @param on_grid   a point of the zero level, its distance to the other body
  void add_both(const Touch& on_other, const Touch& on_grid, double error, double margin);
  template <class Seen>
  void add_supports(const SdfGrid& grid, const Eigen::Vector3d& deepest, const Seen& seen,
                    double margin, double side, const Frame& to_a);
  template <class Lowest>
  void part(const SdfGrid& a, const Frame& b_in_a, const Eigen::Vector3d& centre_b, double radius,
            const Lowest& lowest);
};

/// How far two searches over a grid may differ and have found one point, m.
[[nodiscard]] double blur(const SdfGrid& grid);
[[nodiscard]] Eigen::Vector3d lowest_vertex(const MeshSurface& surface, const Frame& frame,
                                            const Eigen::Vector3d& n);

/// A body that bends, or lies flat, is carried at several places: where the level is nearer than
/// all about it, and by the vertices of the level that face the other body and are near it.
/// @param deepest  what is known: not given a second time
/// @param side     1: normals of candidates are those of `seen`, -1: against them
/// @param to_a     from the grid's frame to that of the candidates
template <class Seen>
void SdfPatch::add_supports(const SdfGrid& grid, const Eigen::Vector3d& deepest, const Seen& seen,
                            double margin, double side, const Frame& to_a) {
  thread_local std::vector<Eigen::Vector3d> places;
  places.assign(1, deepest);
  const double apart = 2 * grid.spacing;
  const auto is_new = [&](const Eigen::Vector3d& x) {
    return std::ranges::all_of(
        places, [&](const Eigen::Vector3d& p) { return (p - x).squaredNorm() > apart * apart; });
  };
  const auto offer = [&](const Touch& t, double facing, int v) {
    if (t.gap > margin || -t.normal.dot(touch(grid, t.x).normal) < facing) return false;
    const Eigen::Vector3d x = t.x - 0.5 * t.gap * t.normal;
    found.push_back({side * (to_a.rotation * t.normal),
                     {to_a * x, t.gap, feature::pair(feature::curve(0), feature::vertex(v))}});
    return true;
  };
  for (const NearVertex& n : near) {
    if (static_cast<int>(places.size()) > tolerance::sdf_supports) break;
    if (!n.least || !is_new(n.touch.x)) continue;
    const Touch t = settle_on_level(grid, n.touch.x, seen);
    if (is_new(t.x) && offer(t, tolerance::opposing, n.vertex)) places.push_back(t.x);
  }
  const double close = std::min(margin, grid.spacing);
  for (const NearVertex& n : near)
    if (n.touch.gap <= close && is_new(n.touch.x)) offer(n.touch, tolerance::facing, n.vertex);
}

/// Where one body holds the other's whole surface within it, no point of a surface overlaps. A way
/// out all the same: along the axes of both and the line of their centres, the one that parts them
/// soonest.
/// @param lowest  point of the core of b lowest along a direction
template <class Lowest>
void SdfPatch::part(const SdfGrid& a, const Frame& b_in_a, const Eigen::Vector3d& centre_b,
                    double radius, const Lowest& lowest) {
  const auto& vertices = a.surface->mesh.vertices;
  Touch best;
  best.gap = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Eigen::Vector3d& n) {
    const Eigen::Vector3d x = lowest(n);
    const double gap = n.dot(x) - radius - (vertices * n).maxCoeff();
    if (gap > best.gap) best = {x, n, gap};
  };
  for (int i = 0; i < 3; ++i)
    for (const double sign : {1.0, -1.0}) {
      consider(sign * Eigen::Vector3d::Unit(i));
      consider(sign * b_in_a.rotation.col(i));
    }
  const Eigen::Vector3d across = centre_b - a.surface->tree.nodes[0].box.centre();
  if (across.norm() > tolerance::sdf_settled * a.spacing) consider(across.normalized());
  add(best, radius, feature::curve(2));
}

}  // namespace carom
