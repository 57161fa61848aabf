// SPDX-License-Identifier: Apache-2.0
#include "geometry/plain_nodes.hpp"

#include <cmath>
#include <cstdint>

#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

constexpr int most_looks = 64;  // inner nodes: a region has few that one plane does not fill

std::vector<std::uint8_t> flat_vertices(const MeshSurface& s) {
  std::vector<std::uint8_t> flat(s.mesh.vertices.rows(), 1);
  for (const MeshSurface::Edge& e : s.edges)
    if (e.f1 < 0 || e.bend != MeshSurface::Bend::flat) flat[e.v0] = flat[e.v1] = 0;
  return flat;
}

}  // namespace

std::vector<int> plain_nodes(const MeshSurface& s) {
  const std::vector<std::uint8_t> flat = flat_vertices(s);
  const double rounding = 16 * tolerance::unit_roundoff *
                          (s.tree.nodes.empty() ? 0
                                                : s.tree.nodes[0].box.extents().norm() +
                                                      s.tree.nodes[0].box.centre().norm());
  const auto cluster_of = [&](int f) {
    const int seed = s.face_cluster[f];
    if (s.face_normals[f].isZero(0) || s.face_normals[seed].isZero(0)) return -1;
    for (int k = 0; k < 3; ++k) {
      const int e = s.face_edges[f][k];
      const double height = s.face_normals[seed].dot(s.corner(f, k) - s.corner(seed, 0));
      if (e < 0 || !flat[s.mesh.faces(f, k)] || std::abs(height) > rounding) return -1;
    }
    return seed;
  };
  std::vector<int> plain(s.tree.nodes.size(), -1);
  for (int i = static_cast<int>(plain.size()) - 1; i >= 0; --i) {
    const MeshTree::Node& node = s.tree.nodes[i];
    if (node.count == 0) {
      const int left = plain[i + 1], right = plain[s.tree.nodes[i + 1].end];
      plain[i] = left == right ? left : -1;
      continue;
    }
    plain[i] = cluster_of(s.tree.order[node.first]);
    for (int k = 1; k < node.count; ++k)
      if (cluster_of(s.tree.order[node.first + k]) != plain[i]) plain[i] = -1;
  }
  return plain;
}

int lone_plane(const MeshSurface& s, const Aabb& region) {
  int found = -1, looks = 0;
  for (int i = 0, n = static_cast<int>(s.tree.nodes.size()); i < n;) {
    const MeshTree::Node& node = s.tree.nodes[i];
    if (!node.box.overlaps(region)) {
      i = node.end;
    } else if (s.plain[i] >= 0) {
      if (found >= 0 && found != s.plain[i]) return -1;
      found = s.plain[i];
      i = node.end;
    } else {
      if (node.count > 0 || ++looks > most_looks) return -1;
      ++i;
    }
  }
  return found;
}

}  // namespace carom
