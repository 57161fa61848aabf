// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/geometry/shape.hpp"

namespace carom {

/// Radius of a ball that fits inside the shape, m, from below: how far it can be moved and still
/// overlap the place where it was. 0 for a sheet; of parts, the smallest.
///
/// Meshes that are not convex answer volume over area, a third of the radius for a ball and half
/// the thickness of a thin wall.
[[nodiscard]] double inner_radius(const Shape& shape);

/// How far points that decide about contact lie from the origin of the body frame, m: what a turn
/// moves. A ball turns in place.
[[nodiscard]] double turning_radius(const Shape& shape);

}  // namespace carom
