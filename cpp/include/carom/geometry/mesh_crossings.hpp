// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <utility>
#include <vector>

#include "carom/geometry/mesh.hpp"

namespace carom {

/// Pairs of faces (i < j, ascending) of which an edge of one passes through the other, edges that
/// meet a shared corner left out. Surfaces that only touch, or lie in one plane, do not cross. By
/// exact signs; an edge that goes exactly through another counts where it changes sides there. A
/// tree of boxes keeps it near n log n.
///
/// @param vertices (V,3) m, finite  @param faces (F,3) indices, one per place for a shared corner
[[nodiscard]] std::vector<std::pair<int, int>> mesh_crossings(
    const TriangleMesh::Vertices& vertices, const TriangleMesh::Faces& faces);

}  // namespace carom
