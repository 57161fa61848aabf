// SPDX-License-Identifier: Apache-2.0
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

}  // namespace

SurfacePoint closest_point(const MeshSurface& s, const Eigen::Vector3d& p, double reach) {
  SurfacePoint out;
  const Nearest best = search(s, p, reach);
  if (best.face < 0) return out;
  out.face = best.face;
  out.point = best.at.point;
  Eigen::Vector3d pseudo = s.face_normals[best.face];
  out.feature = feature::face(s.face_cluster[best.face]);
  const int f = static_cast<int>(best.at.feature);
  if (f < 3) {
    const int v = s.mesh.faces(best.face, f);
    pseudo = s.vertex_normals[v];
    out.feature = feature::vertex(v);
  } else if (f < 6) {
    const int e = s.face_edges[best.face][f - 3];
    if (s.edges[e].bend != MeshSurface::Bend::flat) {
      pseudo = s.edges[e].normal;
      out.feature = feature::edge(e);
    }
  }
  const Eigen::Vector3d away = p - out.point;
  const double side = away.dot(pseudo);
  const double length = std::sqrt(best.squared);
  out.distance = side < 0 ? -length : length;
  if (f >= 3 && f < 6 && s.edges[s.face_edges[best.face][f - 3]].f1 < 0)
    out.distance = length;  // past the rim of an open surface there is no inside
  // On the surface the way is lost to rounding; on a face the face's normal is exact anyway.
  const bool on_face = out.feature == feature::face(s.face_cluster[best.face]);
  if (on_face || !(length > 0))
    out.normal = pseudo;
  else
    out.normal = away / out.distance;
  return out;
}

}  // namespace carom
