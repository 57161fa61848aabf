// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include <Eigen/Core>

#include "carom/geometry/sdf.hpp"

namespace carom {

/// Where the way out of a distance grid was taken from.
enum class NormalSource { gradient, swept_hit, velocity };

/// Which answers may be tried, in this order; the opposite of the velocity always remains.
struct InteriorNormalOptions {
  bool gradient = true;
  bool swept_hit = true;
};

/// How often each answer was used: the fallbacks are to be seen, not guessed.
struct NormalCounts {
  std::int64_t gradient = 0, swept_hit = 0, velocity = 0;
  void count(NormalSource source) {
    ++(source == NormalSource::gradient    ? gradient
       : source == NormalSource::swept_hit ? swept_hit
                                           : velocity);
  }
};

struct InteriorNormal {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, out of the body
  NormalSource source = NormalSource::gradient;
  double depth = 0;  ///< m, way out along it
};

/// Normal for a particle that went from `from` (outside) to `to` (inside), both in the grid's
/// frame.
///
/// Inside, near a corner, the gradient points to the nearest face, which need not be the one the
/// particle came through. It is used when it has a length, leads out where the distance says, and
/// opposes the motion; otherwise the normal at the point where the path met the surface, if that
/// opposes the motion; otherwise the opposite of the motion.
/// @throws InvalidInput when a point is not finite, or from and to are one
/// Source: lecture notes, "Approximate interior normal may be quite wrong" and the fixes after it.
[[nodiscard]] InteriorNormal interior_normal(const SdfGrid& grid, const Eigen::Vector3d& from,
                                             const Eigen::Vector3d& to, NormalCounts& counts,
                                             const InteriorNormalOptions& options = {});

/// The lecture's repulsion: normal velocity to add for a particle `depth` m inside, depth / dt, so
/// that it is just out after dt s. It adds energy; with `bounded`, only what the particle lacks of
/// that speed is added, and never more than leaves it at `cap` m/s.
/// Source: lecture notes, "Use a repulsion impulse"; the bound is ours.
[[nodiscard]] double repulsion_speed(double depth, double normal_velocity, double dt, bool bounded,
                                     double cap);

}  // namespace carom
