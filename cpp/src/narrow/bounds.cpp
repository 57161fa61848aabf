// SPDX-License-Identifier: Apache-2.0
#include "narrow/bounds.hpp"

namespace carom {

using Eigen::Vector3d;

Aabb moved(const Aabb& box, const Frame& frame) {
  const Vector3d half = 0.5 * frame.rotation.cwiseAbs() * box.extents();
  const Vector3d centre = frame * box.centre();
  return {centre - half, centre + half};
}

Aabb bounds_of(const Convex& body, const Frame& frame) {
  Aabb box;
  for (int i = 0; i < 3; ++i)
    for (double sign : {-1.0, 1.0}) {
      const Vector3d d = sign * frame.rotation.row(i).transpose();
      (sign < 0 ? box.lower : box.upper)[i] = (frame * body.support(d))[i];
    }
  return box.inflated(body.radius);
}

}  // namespace carom
