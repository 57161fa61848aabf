// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "carom/geometry/convex.hpp"

namespace carom::detail {

/// Directions n with n . axis = level, where a support point jumps.
struct Crease {
  Eigen::Vector3d axis;
  double level;
};

struct Creases {
  std::vector<Eigen::Vector3d> normals;  ///< of flat faces
  std::vector<Crease> circles;           ///< of edges and straight sides
};

/// The creases of a body's support function within tolerance::crease of a unit direction.
void creases_near(const Convex& body, const Eigen::Vector3d& n, Creases& out);

}  // namespace carom::detail
