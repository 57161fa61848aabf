// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/patch.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
thread_local std::vector<ContactPoint> found;

void add(const Vector3d& normal, double offset, const Vector3d& point, std::uint32_t feature,
         double margin) {
  const double gap = normal.dot(point) - offset;
  if (gap <= margin) found.push_back({point - 0.5 * gap * normal, gap, feature});
}

}  // namespace

void half_space_points(const Vector3d& normal, double offset, std::span<const Vector3d> points,
                       const Frame& b_in_a, double margin, std::vector<Manifold>& out) {
  found.clear();
  for (std::size_t i = 0; i < points.size(); ++i)
    add(normal, offset, b_in_a * points[i],
        feature::pair(feature::face(0), feature::vertex(static_cast<int>(i))), margin);
  if (!found.empty()) reduce(found, normal, out.emplace_back());
}

void half_space_surface(const Vector3d& normal, double offset, const MeshSurface& b,
                        const Frame& b_in_a, double margin, std::vector<Manifold>& out) {
  if (b.polytope)
    return half_space_points(normal, offset, b.polytope->vertices, b_in_a, margin, out);
  const Vector3d n_b = b_in_a.rotation.transpose() * normal;
  const double limit = offset - normal.dot(b_in_a.translation) + margin;
  thread_local std::vector<std::uint32_t> seen;  // the round a vertex was last met in
  thread_local std::uint32_t round = 0;
  if (seen.size() < static_cast<std::size_t>(b.mesh.vertices.rows()))
    seen.resize(b.mesh.vertices.rows(), 0);
  ++round;
  found.clear();
  b.tree.query(
      [&](const Aabb& box) {  // its lowest corner along the normal
        return n_b.cwiseProduct(box.lower).cwiseMin(n_b.cwiseProduct(box.upper)).sum() <= limit;
      },
      [&](int f) {
        for (int k = 0; k < 3; ++k) {
          const int v = b.mesh.faces(f, k);
          if (seen[v] == round) continue;
          seen[v] = round;
          add(normal, offset, b_in_a * b.vertex(v),
              feature::pair(feature::face(0), feature::vertex(v)), margin);
        }
      });
  if (!found.empty()) reduce(found, normal, out.emplace_back());
}

}  // namespace carom
