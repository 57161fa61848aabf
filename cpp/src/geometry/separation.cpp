// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/separation.hpp"

#include "geometry/minkowski.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// Round bodies in line or square to one another have flat and doubled places that tear the growing
/// hull; the way out is then along an axis of one of them, square to it, or square to both.
void try_axes(const detail::Difference& difference, detail::Found& found) {
  const Vector3d za = Vector3d::UnitZ(), zb = difference.b_in_a.rotation.col(2);
  const Vector3d t = difference.b_in_a.translation;
  const Vector3d ways[] = {za, zb, za.cross(zb), t - t.dot(za) * za, t - t.dot(zb) * zb};
  for (const Vector3d& way : ways) {
    if (!(way.squaredNorm() > 0)) continue;
    for (const Vector3d& n : {Vector3d(way.normalized()), Vector3d(-way.normalized())}) {
      const detail::Vertex s = difference.support(n);
      const double gap = n.dot(s.w);
      if (!(gap > found.distance)) continue;
      found.distance = gap, found.normal = n;
      found.b = s.b, found.a = s.b - gap * n;
    }
  }
}

}  // namespace

Separation separation(const Convex& a, const Convex& b, const Frame& b_in_a, double beyond) {
  const detail::Difference difference{a, b, b_in_a};
  const double grown = a.radius + b.radius;
  detail::Found found = detail::gjk(difference, beyond + grown);
  Separation out;
  if (found.beyond) {
    out.status = SeparationStatus::beyond;
  } else {
    if (found.overlap) {
      found = detail::expand(difference);
      if (!a.is_polyhedral() || !b.is_polyhedral()) try_axes(difference, found);
    }
    detail::refine(difference, found);
    if (found.capped && a.is_polyhedral() && b.is_polyhedral())
      out.status = SeparationStatus::iteration_limit;
  }
  out.distance = found.distance - grown;
  out.normal = found.normal;
  out.point_a = found.a + a.radius * found.normal;
  out.point_b = found.b - b.radius * found.normal;
  out.iterations = difference.asked;
  return out;
}

}  // namespace carom
