// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/geometry/aabb.hpp"
#include "carom/geometry/convex.hpp"
#include "carom/geometry/frame.hpp"

namespace carom {

/// Box of a box that `frame` carries.
[[nodiscard]] Aabb moved(const Aabb& box, const Frame& frame);
/// Box of a convex body, growth included.
[[nodiscard]] Aabb bounds_of(const Convex& body, const Frame& frame);

}  // namespace carom
