// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/body_path.hpp"

#include <algorithm>

#include "carom/numerics/rotation.hpp"

namespace carom {

const BodyPath::Arc& BodyPath::arc_at(double t) const {
  const auto next = std::ranges::upper_bound(arcs, t, {}, &Arc::time);
  return next == arcs.begin() ? arcs.front() : *(next - 1);
}

double BodyPath::arc_end(double t, double end) const {
  const auto next = std::ranges::upper_bound(arcs, t, {}, &Arc::time);
  return next == arcs.end() ? end : std::min(next->time, end);
}

Eigen::Vector3d BodyPath::centre_at(double t) const {
  const double s = t - start;
  return centre + s * velocity + (0.5 * s * s) * acceleration;
}

Pose BodyPath::pose_at(double t) const {
  const Arc& arc = arc_at(t);
  const Eigen::Vector3d turn = (t - arc.time) * arc.rate;
  const Eigen::Quaterniond q = turn.isZero(0)
                                   ? arc.orientation
                                   : (rotation_exponential(turn) * arc.orientation).normalized();
  return {centre_at(t) - q * com_b, q};
}

bool BodyPath::moves() const {
  return !velocity.isZero(0) || !acceleration.isZero(0) ||
         std::ranges::any_of(arcs, [](const Arc& a) { return !a.rate.isZero(0); });
}

Aabb BodyPath::centre_bounds(double from, double to) const {
  Aabb box;
  box.extend(centre_at(from));
  box.extend(centre_at(to));
  for (int k = 0; k < 3; ++k) {  // where a coordinate turns round
    const double t = start - velocity[k] / acceleration[k];
    if (acceleration[k] != 0 && t > from && t < to) box.extend(centre_at(t));
  }
  return box;
}

}  // namespace carom
