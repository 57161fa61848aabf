// SPDX-License-Identifier: Apache-2.0
#include "narrow/normal_cone.hpp"

#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"

namespace carom {

using Bend = MeshSurface::Bend;

bool in_cone_of_vertex(const MeshSurface& s, int v, const Eigen::Vector3d& direction,
                       double slack) {
  if (!s.vertex_sharp[v]) return false;
  const double length = direction.norm();
  for (int k = s.vertex_first[v]; k < s.vertex_first[v + 1]; ++k) {
    const auto& e = s.edges[s.vertex_edges[k]];
    const Eigen::Vector3d along = s.vertex(e.v0 == v ? e.v1 : e.v0) - s.vertex(v);
    if (along.dot(direction) > slack * along.norm() * length) return false;
  }
  return true;
}

bool in_cone_of_edge(const MeshSurface& s, int e, const Eigen::Vector3d& direction) {
  const auto& edge = s.edges[e];
  if (edge.bend != Bend::convex) return false;
  const double slack = tolerance::normal_cone * direction.norm();
  return edge.inward0.dot(direction) <= slack && edge.inward1.dot(direction) <= slack;
}

std::optional<std::uint32_t> held_by(const MeshSurface& s, int f, TriangleFeature at,
                                     const Eigen::Vector3d& away) {
  using Held = std::optional<std::uint32_t>;
  const int k = static_cast<int>(at);
  const double slack = tolerance::normal_cone * away.norm();
  const Held by_face =
      away.dot(s.face_normals[f]) >= 0 ? Held(feature::face(s.face_cluster[f])) : std::nullopt;
  if (k >= 6) return by_face;
  if (k >= 3) {
    const int e = s.face_edges[f][k - 3];
    const auto& edge = s.edges[e];
    if (edge.inward0.dot(away) > slack || edge.inward1.dot(away) > slack) return std::nullopt;
    if (edge.bend == Bend::flat) return by_face;
    return edge.bend == Bend::convex ? Held(feature::edge(e)) : std::nullopt;
  }
  const int v = s.mesh.faces(f, k);
  bool flat = true;
  for (int i = s.vertex_first[v]; i < s.vertex_first[v + 1]; ++i) {
    const auto& e = s.edges[s.vertex_edges[i]];
    const Eigen::Vector3d along = s.vertex(e.v0 == v ? e.v1 : e.v0) - s.vertex(v);
    if (along.dot(away) > slack * along.norm()) return std::nullopt;
    flat = flat && e.bend == Bend::flat;
  }
  if (flat) return by_face;
  return s.vertex_sharp[v] ? Held(feature::vertex(v)) : std::nullopt;
}

}  // namespace carom
