// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "carom/geometry/mesh_surface.hpp"

namespace carom {

/// By node of the surface's tree: the cluster that all its faces belong to, where they lie in one
/// plane to rounding and have nothing but that plane about them; else -1.
[[nodiscard]] std::vector<int> plain_nodes(const MeshSurface& surface);

/// The cluster that is all of a surface within a region, with no edge and no bend in it; else -1.
/// To what meets it there it is a half-space.
[[nodiscard]] int lone_plane(const MeshSurface& surface, const Aabb& region);

}  // namespace carom
