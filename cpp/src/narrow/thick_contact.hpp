// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/narrow/moving_triangle.hpp"

namespace carom::narrow {

/// First time two moving primitives come within `thickness` > 0, see point_triangle(). `cells`, if
/// given, receives the number of time cells looked at.
template <int Corners>
[[nodiscard]] CcdHit thick_contact(const double* query, double thickness, int* cells = nullptr);

extern template CcdHit thick_contact<3>(const double*, double, int*);
extern template CcdHit thick_contact<4>(const double*, double, int*);

}  // namespace carom::narrow
