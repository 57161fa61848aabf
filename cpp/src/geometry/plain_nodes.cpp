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

/// Whether a face lies in the plane of its cluster, to rounding.
bool in_plane(const MeshSurface& s, int f, double rounding) {
  const int seed = s.face_cluster[f];
  const Eigen::Vector3d& n = s.face_normals[seed];
  if (s.face_normals[f].isZero(0) || n.isZero(0)) return false;
  for (int k = 0; k < 3; ++k)
    if (std::abs(n.dot(s.corner(f, k) - s.corner(seed, 0))) > rounding) return false;
  return true;
}

double rounding_of(const MeshSurface& s) {
  if (s.tree.nodes.empty()) return 0;
  const Aabb& all = s.tree.nodes[0].box;
  return 16 * tolerance::unit_roundoff * (all.extents().norm() + all.centre().norm());
}

/// Whether an edge that is the end of a plane may reach into the region.
bool ends_within(const MeshSurface& s, int f, const Aabb& region) {
  for (int k = 0; k < 3; ++k) {
    const int e = s.face_edges[f][k];
    if (e < 0) return true;
    const MeshSurface::Edge& edge = s.edges[e];
    if (edge.f1 >= 0 && edge.bend == MeshSurface::Bend::flat) continue;
    const Eigen::Vector3d p = s.vertex(edge.v0), q = s.vertex(edge.v1);
    if (region.overlaps({p.cwiseMin(q), p.cwiseMax(q)})) return true;
  }
  return false;
}

}  // namespace

std::vector<int> plain_nodes(const MeshSurface& s) {
  const std::vector<std::uint8_t> flat = flat_vertices(s);
  const double rounding = rounding_of(s);
  const auto cluster_of = [&](int f) {
    for (int k = 0; k < 3; ++k)
      if (s.face_edges[f][k] < 0 || !flat[s.mesh.faces(f, k)]) return -1;
    return in_plane(s, f, rounding) ? s.face_cluster[f] : -1;
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
  const auto other_than = [&](int cluster) {
    if (found < 0) found = cluster;
    return found != cluster;
  };
  // Of leaves that are not plain as a whole what reaches into the region still may be.
  const auto breaks = [&](int f) {
    Aabb box;
    for (int k = 0; k < 3; ++k) box.extend(s.corner(f, k));
    if (!box.overlaps(region)) return false;
    return ++looks > most_looks || other_than(s.face_cluster[f]) || ends_within(s, f, region) ||
           !in_plane(s, f, rounding_of(s));
  };
  for (int i = 0, n = static_cast<int>(s.tree.nodes.size()); i < n;) {
    const MeshTree::Node& node = s.tree.nodes[i];
    if (!node.box.overlaps(region)) {
      i = node.end;
    } else if (s.plain[i] >= 0) {
      if (other_than(s.plain[i])) return -1;
      i = node.end;
    } else {
      if (++looks > most_looks) return -1;
      for (int k = 0; k < node.count; ++k)
        if (breaks(s.tree.order[node.first + k])) return -1;
      ++i;
    }
  }
  return found;
}

}  // namespace carom
