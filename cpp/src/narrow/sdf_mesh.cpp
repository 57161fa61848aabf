// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "carom/geometry/sdf.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/bounds.hpp"
#include "narrow/routines.hpp"
#include "narrow/sdf_patch.hpp"

namespace carom {

using Eigen::Vector3d;

void sdf_surface(const SdfGrid& a, const MeshSurface& b, const Frame& b_in_a, double margin,
                 std::vector<Manifold>& out) {
  thread_local SdfPatch patch;
  patch.found.clear();
  const Frame a_in_b = b_in_a.inverse();
  const double inf = std::numeric_limits<double>::infinity();
  const Aabb near_b = moved(a.surface->tree.nodes[0].box.inflated(margin), a_in_b);
  const auto seen_by_b = [&](const Vector3d& x) {
    const SurfacePoint p = closest_point(b, a_in_b * x, inf);
    return Touch{x, b_in_a.rotation * p.normal, p.distance};
  };
  const bool solid = b.faults.closed();
  const auto on_b = [&](Vector3d& q) {
    const SurfacePoint p = closest_point(b, a_in_b * q, inf);
    if (!solid || p.distance > 0) q = b_in_a * p.point;
  };
  Touch best;
  thread_local std::vector<int> vertices;
  vertices.clear();
  Vector3d unused;
  b.tree.query(
      [&](const Aabb& box) {  // no corner in the box is nearer than its middle less its size
        return box.overlaps(near_b) &&
               a.sample(b_in_a * box.centre(), unused) - 0.5 * box.extents().norm() <=
                   margin + a.spacing;
      },
      [&](int f) {
        for (int k = 0; k < 3; ++k) vertices.push_back(b.mesh.faces(f, k));
      });
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (int v : vertices) {
    const Touch t = touch(a, b_in_a * b.vertex(v));
    if (t.gap < best.gap) best = t;
    if (t.gap <= margin && b.vertex_sharp[v]) patch.add(measured(a, t), 0, feature::vertex(v));
  }
  const Aabb all_b = moved(b.tree.nodes[0].box, b_in_a);
  vertices_near(a, all_b.inflated(margin), margin, seen_by_b, patch.near);
  const Touch nearest = patch.near.empty() ? Touch{} : patch.near[0].touch;
  Touch level;
  if (nearest.gap < inf) {
    const Vector3d q = b_in_a * closest_point(b, a_in_b * nearest.x, inf).point;
    if (const Touch t = touch(a, q); t.gap < best.gap) best = t;
    level = settle_on_level_seen_from(a.spacing, a, nearest.x, seen_by_b);
  }
  if (best.gap < inf) best = settle(a, best, on_b);
  if (best.gap < inf) best.gap = measured(a, best).gap;
  patch.add_both(best, level, blur(a), margin);
  if (nearest.gap < inf) patch.add_supports(a, level.x, seen_by_b, margin, -1, Frame{});
  if (patch.found.empty() && nearest.gap < 0 && solid)
    patch.part(a, b_in_a, all_b.centre(), 0,
               [&](const Vector3d& n) { return lowest_vertex(b, b_in_a, n); });
  emit(patch.found, tolerance::similar_normal, out);
}

namespace {

/// Deepest point of the zero level of `body` in the other field, in the frame of `field`, and what
/// else of it is near.
/// @param side  of the normals found, 1 where candidates are in the frame of `field`
Touch deepest(const SdfGrid& field, const SdfGrid& body, const Frame& body_in_field, double margin,
              double side, const Frame& to_a, SdfPatch& patch) {
  const Frame field_in_body = body_in_field.inverse();
  const Aabb near = moved(field.surface->tree.nodes[0].box, field_in_body).inflated(margin);
  const auto seen = [&](const Vector3d& x) {
    const Touch t = touch(field, body_in_field * x);
    return Touch{x, field_in_body.rotation * t.normal, t.gap};
  };
  vertices_near(body, near, margin, seen, patch.near);
  if (patch.near.empty()) return {};
  Touch low = settle_on_level(body, patch.near[0].touch.x, seen);
  patch.add_supports(body, low.x, seen, margin, side, to_a);
  low.x = body_in_field * low.x, low.normal = body_in_field.rotation * low.normal;
  low.gap = measured(field, low).gap;
  return low;
}

}  // namespace

void sdf_sdf(const SdfGrid& a, const SdfGrid& b, const Frame& b_in_a, double margin,
             std::vector<Manifold>& out) {
  thread_local SdfPatch patch;
  patch.found.clear();
  const Touch on_b = deepest(a, b, b_in_a, margin, 1, b_in_a, patch);
  Touch on_a = deepest(b, a, b_in_a.inverse(), margin, -1, Frame{}, patch);
  on_a.x = b_in_a * on_a.x;
  on_a.normal = b_in_a.rotation * on_a.normal;
  const bool meet = std::min(on_a.gap, on_b.gap) < std::numeric_limits<double>::infinity();
  if (meet) patch.add_both(on_b, on_a, blur(a) + blur(b), margin);
  const Vector3d centre = b_in_a * b.surface->tree.nodes[0].box.centre();
  Vector3d unused;
  if (meet && std::min(on_a.gap, on_b.gap) > -a.spacing && a.sample(centre, unused) < -a.spacing) {
    patch.found.clear();  // surfaces that lie in one another, or within
    patch.part(a, b_in_a, centre, 0,
               [&](const Vector3d& n) { return lowest_vertex(*b.surface, b_in_a, n); });
  }
  emit(patch.found, tolerance::similar_normal, out);
}

}  // namespace carom
