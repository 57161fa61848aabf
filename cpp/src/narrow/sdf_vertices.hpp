// SPDX-License-Identifier: Apache-2.0
// The part of a grid's surface that is near another body, by the vertices of its mesh, which lie on
// the zero level: where searches along the level start, and what carries a body that lies flat.
#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "narrow/sdf_touch.hpp"

namespace carom {

struct NearVertex {
  int vertex = -1;
  Touch touch;         ///< its distance to the other body
  bool least = false;  ///< no vertex next to it is nearer
};

/// Calls `on_vertex(v)` for the corners of the faces in boxes that `enter(gap, size)` lets in: the
/// gap at the middle of a box, m, and half its diagonal. No vertex in it is nearer than their
/// difference or farther than their sum.
template <class Seen, class Enter, class OnVertex>
void walk_vertices(const MeshSurface& surface, const Aabb& near, const Seen& seen,
                   const Enter& enter, const OnVertex& on_vertex) {
  struct Entry {
    double gap, size;
    int node;
  };
  const auto entry = [&](int i) {
    const Aabb& box = surface.tree.nodes[i].box;
    const double gap =
        box.overlaps(near) ? seen(box.centre()).gap : std::numeric_limits<double>::infinity();
    return Entry{gap, 0.5 * box.extents().norm(), i};
  };
  std::array<Entry, 128> stack;  // depth is log2 of the faces: 2 x 64 is never met
  int top = 0;
  stack[top++] = entry(0);
  while (top > 0) {
    const Entry at = stack[--top];
    if (!(at.gap < std::numeric_limits<double>::infinity()) || !enter(at.gap, at.size)) continue;
    const MeshTree::Node& node = surface.tree.nodes[at.node];
    for (int k = 0; k < node.count; ++k)
      for (int c = 0; c < 3; ++c)
        on_vertex(surface.mesh.faces(surface.tree.order[node.first + k], c));
    if (node.count > 0) continue;
    Entry one = entry(at.node + 1), two = entry(surface.tree.nodes[at.node + 1].end);
    if (one.gap - one.size < two.gap - two.size) std::swap(one, two);
    stack[top++] = one;
    stack[top++] = two;  // the nearer is looked at first
  }
}

/// Vertices of the grid no farther than `limit` from the other body, m, and no deeper in it than a
/// cell, nearest first; before them the nearest of all, be it deeper, or up to a cell farther, as
/// the level between vertices may be nearer than they.
/// @param seen  x -> Touch: signed distance to the other body, which grows no faster than x moves
template <class Seen>
void vertices_near(const SdfGrid& grid, const Aabb& near, double limit, const Seen& seen,
                   std::vector<NearVertex>& out) {
  const MeshSurface& surface = *grid.surface;
  const double inf = std::numeric_limits<double>::infinity();
  thread_local std::vector<Touch> met;  // by vertex; infinite gap: not asked for
  thread_local std::vector<int> asked;
  met.resize(surface.mesh.vertices.rows());
  out.clear(), asked.clear();
  const auto at = [&](int v) -> const Touch& {
    if (met[v].gap == inf) met[v] = seen(surface.vertex(v)), asked.push_back(v);
    return met[v];
  };
  double least = limit + grid.spacing;
  int nearest = -1;
  walk_vertices(
      surface, near, seen, [&](double gap, double size) { return gap - size < least; },
      [&](int v) {
        if (at(v).gap < least) least = met[v].gap, nearest = v;
      });
  if (nearest >= 0) {
    walk_vertices(
        surface, near, seen,
        [&](double gap, double size) { return gap - size <= limit && gap + size >= -grid.spacing; },
        [&](int v) { (void)at(v); });
    const std::size_t all = asked.size();  // the neighbours asked for below are none of them
    for (std::size_t i = 0; i < all; ++i) {
      const int v = asked[i];
      const Touch here = met[v];
      if (v != nearest && (here.gap > limit || here.gap < -grid.spacing)) continue;
      bool lowest = true;
      for (int k = surface.vertex_first[v]; lowest && k < surface.vertex_first[v + 1]; ++k) {
        const auto& e = surface.edges[surface.vertex_edges[k]];
        const int other = e.v0 == v ? e.v1 : e.v0;
        const double there = at(other).gap;
        lowest = there > here.gap || (there == here.gap && other > v);
      }
      out.push_back({v, here, lowest});
    }
    std::ranges::sort(out, [](const NearVertex& a, const NearVertex& b) {
      return a.touch.gap != b.touch.gap ? a.touch.gap < b.touch.gap : a.vertex < b.vertex;
    });
  }
  for (const int v : asked) met[v].gap = inf;
}

}  // namespace carom
