// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/separation.hpp"

#include "geometry/minkowski.hpp"

namespace carom {

Separation separation(const Convex& a, const Convex& b, const Frame& b_in_a, double beyond) {
  const detail::Difference difference{a, b, b_in_a};
  const double grown = a.radius + b.radius;
  detail::Found found = detail::gjk(difference, beyond + grown);
  Separation out;
  if (found.beyond) {
    out.status = SeparationStatus::beyond;
  } else {
    if (found.overlap) found = detail::expand(difference);
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
