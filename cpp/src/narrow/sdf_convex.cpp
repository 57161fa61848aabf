// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "carom/geometry/sdf.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "geometry/point_distance.hpp"
#include "narrow/bounds.hpp"
#include "narrow/routines.hpp"
#include "narrow/sdf_patch.hpp"
#include "narrow/support_face.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// A ball is its centre and its radius.
void sdf_ball(const SdfGrid& a, const Vector3d& centre, double radius, double margin,
              SdfPatch& patch) {
  Touch t = measured(a, touch(a, centre));
  t.gap -= radius;
  if (t.gap <= margin) patch.add(t, radius, feature::vertex(1));
}

}  // namespace

void sdf_convex(const SdfGrid& a, const Convex& b, const Frame& b_in_a, double margin,
                std::vector<Manifold>& out) {
  thread_local SdfPatch patch;
  patch.found.clear();
  const Aabb near = bounds_of(b, b_in_a);
  if (!near.inflated(margin).overlaps(a.surface->tree.nodes[0].box)) return;
  if (b.kind == Convex::Kind::points && b.corners().size() == 1) {
    sdf_ball(a, b_in_a * b.corners()[0], b.radius, margin, patch);
    return emit(patch.found, tolerance::similar_normal, out);
  }
  const double inf = std::numeric_limits<double>::infinity();
  const auto apart = [&](const Vector3d& q) { return point_distance(b, b_in_a.to_local(q)); };
  // The least over all of b, not only its surface: a step inside is one down the field as well, and
  // is not thrown across to another side.
  const auto on_b = [&](Vector3d& q) {
    if (const PointDistance d = apart(q); d.distance > 0) q = b_in_a * d.point;
  };
  const auto seen_by_b = [&](const Vector3d& x) {
    const PointDistance d = apart(x);
    return Touch{x, b_in_a.rotation * d.normal, d.distance};
  };
  const auto grown = [&](const Vector3d& n) {  // lowest against a unit n
    return Vector3d(b_in_a * b.support(-(b_in_a.rotation.transpose() * n)) - b.radius * n);
  };
  Touch best;
  const auto offer = [&](const Vector3d& x, std::uint32_t name) {
    const Touch t = touch(a, x);
    if (t.gap < best.gap) best = t;
    if (name != 0 && t.gap <= margin) patch.add(measured(a, t), 0, name);
  };
  // A corner of the core, moved out by the growth towards the grid.
  const auto corner = [&](const Vector3d& x, std::uint32_t name) {
    const Vector3d n =
        b.radius > 0 ? closest_point(*a.surface, x, inf).normal : Vector3d(Vector3d::Zero());
    offer(x - b.radius * n, name);
  };
  int number = 0;
  if (b.kind == Convex::Kind::box)
    for (int i = 0; i < 8; ++i)
      corner(b_in_a * Vector3d(i & 1 ? b.size.x() : -b.size.x(), i & 2 ? b.size.y() : -b.size.y(),
                               i & 4 ? b.size.z() : -b.size.z()),
             feature::vertex(++number));
  for (const Vector3d& c : b.corners()) corner(b_in_a * c, feature::vertex(++number));
  for (int i = 0; i < 27; ++i)
    if (i != 13) offer(grown(Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized()), 0);
  vertices_near(a, near.inflated(margin), margin, seen_by_b, patch.near);
  const Touch nearest = patch.near.empty() ? Touch{} : patch.near[0].touch;
  if (nearest.gap < inf) offer(b_in_a * apart(nearest.x).point, 0);
  best = settle(a, best, on_b);
  best.gap = measured(a, best).gap;  // its gradient is square to the other body
  if (best.gap <= margin) {
    thread_local Face face;
    support_face(b, -(b_in_a.rotation.transpose() * best.normal), b_in_a, face);
    if (face.points.size() > 1 && !b.is_polyhedral())
      for (std::size_t i = 0; i < face.points.size(); ++i)
        offer(face.points[i], face.vertex_features[i]);
  }
  if (nearest.gap < inf) {
    const double off = 0.5 * a.box().extents().norm();
    const Touch level = settle_on_level_seen_from(off, a, nearest.x, seen_by_b);
    patch.add_both(best, level, blur(a), margin);
    patch.add_supports(a, level.x, seen_by_b, margin, -1, Frame{});
  } else {
    patch.add_both(best, {}, blur(a), margin);
  }
  if (patch.found.empty() && nearest.gap < 0)
    patch.part(a, b_in_a, b_in_a.translation, b.radius, [&](const Vector3d& n) {
      return Vector3d(b_in_a * b.support(-(b_in_a.rotation.transpose() * n)));
    });
  emit(patch.found, tolerance::similar_normal, out);
}

}  // namespace carom
