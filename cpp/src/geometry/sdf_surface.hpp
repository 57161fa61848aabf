// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "carom/geometry/sdf.hpp"

namespace carom {

/// Closed mesh of the zero level: each cell is cut into six tetrahedra about its diagonal, each
/// tetrahedron by a plane; the vertices are then walked onto the level along the gradient.
/// @param samples  the distances at the grid's samples, x fastest
/// @throws InvalidInput when the grid holds no surface
[[nodiscard]] std::shared_ptr<const MeshSurface> zero_level(const SdfGrid& grid,
                                                            const std::vector<double>& samples);

}  // namespace carom
