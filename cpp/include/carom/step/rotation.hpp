// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string_view>

#include "carom/state/report.hpp"
#include "carom/step/integrators.hpp"

namespace carom {

/// Orientations and what turns them, one array per scalar; row i is body i. Nothing is owned.
struct RotationArrays {
  double *qx, *qy, *qz, *qw;   ///< unit quaternions, principal frame to world
  const double *lx, *ly, *lz;  ///< kg m^2/s, world angular momentum about the centre of mass
  const double *a1, *a2, *a3;  ///< 1/(kg m^2), inverse principal moments: descending, with 0 in
                               ///< front about an axis that resists nothing (rods), all 0 (points)
};

/// Turns the bodies of `rows` (ascending) for dt seconds at constant angular momentum. Bodies too
/// fast for dt take sub-steps of their own; see substeps_wanted. Same bits for a body whatever the
/// other rows are, and whichever CPU level runs it.
/// @param dt      s, finite; negative runs backwards
/// @param report  adds to it; several batches may share one
void advance_rotation(Integrator method, const RotationArrays& arrays, std::span<const int> rows,
                      double dt, RotationReport& report);

/// The same for every row of [begin, end).
void advance_rotation(Integrator method, const RotationArrays& arrays, int begin, int end,
                      double dt, RotationReport& report);

/// "avx2" or "portable": what this machine runs. Both give the same bits.
[[nodiscard]] std::string_view rotation_cpu_level();

}  // namespace carom
