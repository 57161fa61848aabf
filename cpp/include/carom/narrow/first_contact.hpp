// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include <Eigen/Core>

#include "carom/geometry/shape.hpp"
#include "carom/narrow/body_path.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {

/// What first_contact() found.
struct FirstContact {
  enum class Status : std::uint8_t {
    clear,    ///< certified apart until the end
    contact,  ///< at `time` they are within reach of touching, or have come as near as allowed
    gave_up,  ///< certified apart up to `time` only: the cap on queries was met
  };
  Status status = Status::clear;
  double time = 0;  ///< s: nothing touches before it
  double gap = 0;   ///< m, least separation seen; of no meaning when they never came near
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, world, from a to b, at `time`
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< m, world, midway between the surfaces
  int queries = 0;                                    ///< distances asked for
};

/// First time in [from, end] at which two moving bodies touch, rotation included.
///
/// They may come as near as tolerance::sweep_clear; a pair that is nearer at `from` already (it
/// rests, or was just hit) may come nearer by tolerance::sweep_slop, the less the more of `deepest`
/// (m) it overlaps already: whatever happens, it does not sink deeper step after step. Between two
/// looks the gap along a fixed direction n is bounded from below in two ways: no point closes
/// faster than the speeds say (Mirtich's conservative advancement), and, since the support of a
/// turning body along n is a maximum of points whose acceleration is at most w^2 r, it dips below
/// its chord by at most w^2 r h^2 / 8. So whatever is stepped over is free of contact: never a
/// miss. Convex parts ask exact distances; surfaces are taken triangle by triangle, from both
/// sides, so sheets without thickness hold. Distance grids move no faster than their gap allows.
/// Source: B. Mirtich, PhD thesis, UC Berkeley 1996; the second bound is ours.
[[nodiscard]] FirstContact first_contact(const Shape& a, const BodyPath& path_a, const Shape& b,
                                         const BodyPath& path_b, double from, double end,
                                         double deepest = tolerance::sweep_deepest);

}  // namespace carom
