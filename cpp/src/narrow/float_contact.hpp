// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/narrow/moving_triangle.hpp"

namespace carom::narrow {

/// CcdMethod::lecture and ::tolerance: the rows the certified method is compared with. They miss
/// and cry wolf on hard input, on purpose. A thickness > 0 replaces tolerance::float_contact.
template <int Corners>
[[nodiscard]] CcdHit float_contact(const double* query, const CcdOptions& options);

extern template CcdHit float_contact<3>(const double*, const CcdOptions&);
extern template CcdHit float_contact<4>(const double*, const CcdOptions&);

}  // namespace carom::narrow
