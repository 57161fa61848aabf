// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>

#include "carom/geometry/sdf.hpp"

namespace carom {

/// Closed mesh of the zero level: each cell is cut into six tetrahedra about its diagonal, each
/// tetrahedron by a plane; the vertices are then walked onto the level along the gradient.
/// @throws InvalidInput when the grid holds no surface
[[nodiscard]] std::shared_ptr<const MeshSurface> zero_level(const SdfGrid& grid);

}  // namespace carom
