// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "carom/geometry/mesh_surface.hpp"

namespace carom {

/// The polytope a mesh is, if it is one: closed, of one piece without handles, no concave edge.
/// (A closed connected surface that is convex at every edge and has the topology of a sphere is
/// convex: Tietze-Nakajima.) Corners in the middle of a straight edge are left out.
[[nodiscard]] std::optional<Polytope> polytope_of(const MeshSurface& surface);

}  // namespace carom
