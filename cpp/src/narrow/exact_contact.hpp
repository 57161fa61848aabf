// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace carom::narrow {

/// What the exact stage found out about one query.
struct ExactContact {
  bool hit = false;
  bool coplanar = false;  // the four points stay in one plane throughout
  double time = 1;        // <= the first contact, and within tolerance::contact_time of it
};

/// Decides a query of 24 finite doubles with integers; no tolerance enters. `Corners` is 3 for
/// point-triangle and 4 for edge-edge. Cost: some microseconds, bounded (no open-ended loop).
template <int Corners>
[[nodiscard]] ExactContact exact_contact(const double* query);

extern template ExactContact exact_contact<3>(const double*);
extern template ExactContact exact_contact<4>(const double*);

}  // namespace carom::narrow
