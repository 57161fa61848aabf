// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/geometry/convex.hpp"
#include "carom/narrow/first_contact.hpp"

namespace carom::narrow {

/// A convex part of a moving body, or a half-space that stands still.
struct MovingPart {
  Convex convex;
  Frame in_body;
  const BodyPath* path = nullptr;
  double arm = 0;   ///< m, of the farthest point of the core from the centre of mass
  double spin = 0;  ///< rad/s, of the fastest arc of its path
  bool half_space = false;
  Eigen::Vector3d normal_b = Eigen::Vector3d::UnitZ();  ///< of a half-space, unit
  double offset = 0;                                    ///< m

  [[nodiscard]] static MovingPart of(const Convex& convex, const Frame& in_body,
                                     const BodyPath& path, double spin);
};

/// rad/s, of the fastest arc of a path. A body that tumbles has hundreds of arcs: asked once.
[[nodiscard]] double fastest_spin(const BodyPath& path);

/// Signed distance of two parts at one time. Gaps above `beyond` m are bounds from below. Of two
/// half-spaces nothing is asked; one comes first.
[[nodiscard]] FirstContact gap_at(const MovingPart& a, const MovingPart& b, double t,
                                  double beyond);

/// Advances from `from` to the first time at which the parts are `target` m apart, or to the end;
/// see first_contact(). Improves on `best` only with an earlier time.
void advance(const MovingPart& a, const MovingPart& b, double from, double end, double target,
             FirstContact& best);

}  // namespace carom::narrow
