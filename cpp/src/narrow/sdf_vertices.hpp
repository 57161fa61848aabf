// SPDX-License-Identifier: Apache-2.0
// The part of a grid's surface that is near another body, by the vertices of its mesh, which lie on
// the zero level: where searches along the level start, and what carries a body that lies flat.
#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "narrow/sdf_touch.hpp"

namespace carom {

struct NearVertex {
  int vertex = -1;
  Touch touch;       ///< its distance to the other body
  bool least = false;  ///< no vertex next to it is nearer
};

/// Vertices of the grid no farther than `limit` from the other body, m, nearest first; where there
/// are none, those up to a cell farther, as the level between them may be nearer.
/// @param seen  x -> Touch: signed distance to the other body, which grows no faster than x moves
template <class Seen>
void vertices_near(const SdfGrid& grid, const Aabb& near, double limit, const Seen& seen,
                   std::vector<NearVertex>& out, bool is_all = false) {
  const MeshSurface& surface = *grid.surface;
  const double inf = std::numeric_limits<double>::infinity();
  thread_local std::vector<double> gap;  // by vertex; infinite: not asked for
  thread_local std::vector<int> asked;
  gap.resize(surface.mesh.vertices.rows(), inf);
  out.clear(), asked.clear();
  std::array<int, 128> stack;  // depth is log2 of the faces: 2 x 64 is never met
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const int i = stack[--top];
    const MeshTree::Node& node = surface.tree.nodes[i];
    if (!node.box.overlaps(near)) continue;
    // Of a box of them none is nearer than its middle less its half diagonal.
    if (seen(node.box.centre()).gap - 0.5 * node.box.extents().norm() > limit) continue;
    for (int k = 0; k < node.count; ++k)
      for (int c = 0; c < 3; ++c) {
        const int v = surface.mesh.faces(surface.tree.order[node.first + k], c);
        if (gap[v] < inf) continue;
        const Touch t = seen(surface.vertex(v));
        gap[v] = t.gap;
        asked.push_back(v);
        if (t.gap <= limit) out.push_back({v, t});
      }
    if (node.count > 0) continue;
    stack[top++] = i + 1;
    stack[top++] = surface.tree.nodes[i + 1].end;
  }
  if (out.empty() && !is_all) {
    for (const int v : asked) gap[v] = inf;
    return vertices_near(grid, near, limit + grid.spacing, seen, out, true);
  }
  for (NearVertex& n : out) {
    n.least = true;
    for (int k = surface.vertex_first[n.vertex]; k < surface.vertex_first[n.vertex + 1]; ++k) {
      const auto& e = surface.edges[surface.vertex_edges[k]];
      const int other = e.v0 == n.vertex ? e.v1 : e.v0;
      n.least &= gap[other] > n.touch.gap || (gap[other] == n.touch.gap && other > n.vertex);
    }
  }
  for (const int v : asked) gap[v] = inf;
  std::ranges::sort(out, [](const NearVertex& a, const NearVertex& b) {
    return a.touch.gap != b.touch.gap ? a.touch.gap < b.touch.gap : a.vertex < b.vertex;
  });
}

}  // namespace carom
