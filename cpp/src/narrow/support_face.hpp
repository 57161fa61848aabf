// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/geometry/convex.hpp"
#include "carom/geometry/frame.hpp"

#include "narrow/clip.hpp"

namespace carom {

/// What a convex body turns towards `direction` (unit, its own frame): a flat face, a straight edge
/// or side, or a point; of the core moved out by the growth. Placed by `frame`. A round face is an
/// octagon that turns with the body.
void support_face(const Convex& body, const Eigen::Vector3d& direction, const Frame& frame,
                  Face& out);

}  // namespace carom
