// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/polytope.hpp"
#include "carom/geometry/shape.hpp"

namespace carom {

// A box as polytope or as mesh surface, in scratch of this thread: its neighbourhoods never change,
// only corners are set. Valid until the next call with the same slot (0 or 1).
[[nodiscard]] const Polytope& scratch_polytope(const Box& box, int slot);
[[nodiscard]] const MeshSurface& scratch_surface(const Box& box);

}  // namespace carom
