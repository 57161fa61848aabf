// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>

#include "carom/geometry/convex.hpp"
#include "carom/geometry/frame.hpp"

namespace carom {

enum class SeparationStatus {
  exact,            ///< to rounding
  beyond,           ///< certainly farther apart than asked; distance is a lower bound
  iteration_limit,  ///< the cap was met; distance holds along `normal`, another may be shorter
};

/// How far apart two convex bodies are, or how deep they overlap.
struct Separation {
  SeparationStatus status = SeparationStatus::exact;
  double distance = 0;  ///< m; negative: the least translation that parts them
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, from a to b, frame of a
  Eigen::Vector3d point_a, point_b;                   ///< m, on the surfaces, frame of a
  int iterations = 0;                                 ///< support points asked for
};

/// Signed distance of a and b (at b_in_a). Gaps above `beyond` m are not worked out in full.
///
/// Apart: GJK (E. Gilbert, D. Johnson, S. Keerthi, 1988). Overlapping: an expanding polytope (G.
/// van den Bergen, 2001). Both end on a polyhedron; for curved bodies the direction is then
/// refined, as both are the same question: the direction n along which the gap between the support
/// points, -h_a(n) - h_b(-n), is largest. Where n stays on a crease of a support function (the side
/// of a cylinder, the rim of a cone) the search runs along it.
[[nodiscard]] Separation separation(const Convex& a, const Convex& b, const Frame& b_in_a,
                                    double beyond);

}  // namespace carom
