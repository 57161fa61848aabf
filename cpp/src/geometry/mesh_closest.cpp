// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/triangle.hpp"

#include "geometry/features.hpp"

namespace carom {
namespace {

struct Nearest {
  int face = -1;
  double squared = 0;
  TrianglePoint at{};
};

/// Depth-first, nearer child first, so that the first leaf already gives a short reach.
Nearest search(const MeshSurface& s, const Eigen::Vector3d& p, double reach) {
  Nearest best;
  best.squared = reach < std::numeric_limits<double>::max() ? reach * reach
                                                            : std::numeric_limits<double>::max();
  std::array<std::pair<double, int>, 128> stack;  // depth is log2 of the faces: 2 x 64 is never met
  int top = 0;
  stack[top++] = {squared_distance(s.tree.nodes[0].box, p), 0};
  while (top > 0) {
    const auto [bound, i] = stack[--top];
    if (bound > best.squared) continue;
    const MeshTree::Node& node = s.tree.nodes[i];
    for (int k = 0; k < node.count; ++k) {
      const int f = s.tree.order[node.first + k];
      if (s.face_normals[f].isZero(0)) continue;
      const TrianglePoint q = closest_point(p, s.corner(f, 0), s.corner(f, 1), s.corner(f, 2));
      const double d = (p - q.point).squaredNorm();
      if (d < best.squared || (d == best.squared && (best.face < 0 || f < best.face)))
        best = {f, d, q};
    }
    if (node.count == 0) {
      const int left = i + 1, right = s.tree.nodes[left].end;
      const double dl = squared_distance(s.tree.nodes[left].box, p);
      const double dr = squared_distance(s.tree.nodes[right].box, p);
      const bool left_first = dl <= dr;
      stack[top++] = left_first ? std::pair(dr, right) : std::pair(dl, left);
      stack[top++] = left_first ? std::pair(dl, left) : std::pair(dr, right);
    }
  }
  return best;
}

/// Whether the nearest feature lies on the rim of an open surface.
bool on_rim(const MeshSurface& s, const Nearest& best) {
  const auto open = [&](int e) { return e >= 0 && s.edges[e].f1 < 0; };
  const int f = static_cast<int>(best.at.feature);
  if (f >= 6) return false;
  if (f >= 3) return open(s.face_edges[best.face][f - 3]);
  const int v = s.mesh.faces(best.face, f);
  return std::any_of(s.vertex_edges.begin() + s.vertex_first[v],
                     s.vertex_edges.begin() + s.vertex_first[v + 1], open);
}

/// Of the feature nearest to a point; its sign tells the side.
Eigen::Vector3d pseudonormal(const MeshSurface& s, const Nearest& best, std::uint32_t& name) {
  name = feature::face(s.face_cluster[best.face]);
  const int f = static_cast<int>(best.at.feature);
  if (f < 3) {
    const int v = s.mesh.faces(best.face, f);
    name = feature::vertex(v);
    return s.vertex_normals[v];
  }
  if (f < 6)
    if (const int e = s.face_edges[best.face][f - 3]; s.edges[e].bend != MeshSurface::Bend::flat) {
      name = feature::edge(e);
      return s.edges[e].normal;
    }
  return s.face_normals[best.face];
}

}  // namespace

SurfacePoint closest_point(const MeshSurface& s, const Eigen::Vector3d& p, double reach) {
  SurfacePoint out;
  const Nearest best = search(s, p, reach);
  if (best.face < 0) return out;
  out.face = best.face;
  out.point = best.at.point;
  const Eigen::Vector3d pseudo = pseudonormal(s, best, out.feature);
  const Eigen::Vector3d away = p - out.point;
  const double side = away.dot(pseudo);
  const double length = std::sqrt(best.squared);
  out.distance = side < 0 ? -length : length;
  if (s.faults.open_edges > 0 && on_rim(s, best))
    out.distance = length;  // past the rim of an open surface there is no inside
  // On the surface the way is lost to rounding; on a face the face's normal is exact anyway.
  const bool on_face = out.feature == feature::face(s.face_cluster[best.face]);
  if (on_face || !(length > 0))
    out.normal = pseudo;
  else
    out.normal = away / out.distance;
  return out;
}

Side side_of(const MeshSurface& s, const Eigen::Vector3d& p, double reach) {
  const Nearest best = search(s, p, reach);
  if (best.face < 0) return Side::none;
  std::uint32_t unused;
  const double height = (p - best.at.point).dot(pseudonormal(s, best, unused));
  return height < 0 ? Side::behind : Side::front;
}

}  // namespace carom
