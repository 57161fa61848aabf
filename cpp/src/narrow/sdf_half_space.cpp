// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <limits>

#include <Eigen/Geometry>

#include "carom/geometry/sdf.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/candidates.hpp"
#include "narrow/routines.hpp"
#include "narrow/sdf_touch.hpp"

namespace carom {

using Eigen::Vector3d;

void half_space_sdf(const Vector3d& normal, double offset, const SdfGrid& b, const Frame& b_in_a,
                    double margin, std::vector<Manifold>& out) {
  thread_local std::vector<Candidate> found;
  found.clear();
  const Vector3d n = b_in_a.rotation.transpose() * normal;  // in the grid
  const double level = offset - normal.dot(b_in_a.translation);
  const double reach = std::min(margin, b.spacing);
  // The patch: of the vertices near the plane, those farthest out in eight directions along it.
  const Vector3d along = n.unitOrthogonal(), across = n.cross(along);
  struct Farthest {
    double far = -std::numeric_limits<double>::infinity(), gap = 0;
    int vertex = -1;
  };
  std::array<Farthest, 8> patch;
  double least = std::numeric_limits<double>::infinity();
  Vector3d lowest = Vector3d::Zero();
  const MeshSurface& s = *b.surface;
  s.tree.query(
      [&](const Aabb& box) {
        const double low = n.dot(box.centre()) - 0.5 * n.cwiseAbs().dot(box.extents()) - level;
        return low <= std::max(reach, margin + b.spacing);
      },
      [&](int f) {
        for (int c = 0; c < 3; ++c) {
          const Vector3d x = s.corner(f, c);
          const double gap = n.dot(x) - level, u = along.dot(x), w = across.dot(x);
          if (gap < least) least = gap, lowest = x;
          if (gap > reach) continue;
          const double directions[8] = {u, -u, w, -w, u + w, -u - w, u - w, w - u};
          for (int k = 0; k < 8; ++k)
            if (directions[k] > patch[k].far) patch[k] = {directions[k], gap, s.mesh.faces(f, c)};
        }
      });
  if (least > margin + b.spacing) return;
  for (const Farthest& p : patch)
    if (p.vertex >= 0)
      found.push_back({n,
                       {s.vertex(p.vertex) - 0.5 * p.gap * n, p.gap,
                        feature::pair(feature::face(0), feature::vertex(p.vertex))}});
  const auto foot = [&](Vector3d& x) { x -= (n.dot(x) - level) * n; };
  const auto over = [&](const Vector3d& x) { return Touch{x, n, n.dot(x) - level}; };
  Vector3d under = lowest;
  foot(under);
  const Touch inside = settle(b, touch(b, under), foot);
  const Touch deep = settle_on_level(b, lowest, over);
  // The plane gives the normal; its own search counts where the grid's gradient says the same.
  const bool faces = inside.normal.dot(-n) > tolerance::facing;
  const double gap = faces ? std::min(inside.gap, deep.gap) : deep.gap;
  if (gap <= margin)
    found.push_back(
        {n, {deep.x - 0.5 * gap * n, gap, feature::pair(feature::face(0), feature::curve(1))}});
  const std::size_t begin = out.size();
  emit(found, tolerance::same_normal, out);
  for (std::size_t i = begin; i < out.size(); ++i) {  // worked out in the grid's frame
    out[i].normal = normal;
    for (int k = 0; k < out[i].count; ++k)
      out[i].points[k].position = b_in_a * out[i].points[k].position;
  }
}

}  // namespace carom
