// SPDX-License-Identifier: Apache-2.0
// A second look at a step by another routine: the exact predicates of moving corners and edges.
#pragma once
#include "carom/narrow/body_path.hpp"
#include "carom/narrow/sweep.hpp"

namespace carom {

struct World;

/// One stretch of the way a body really went in a step.
struct TrailPiece {
  int row = 0;
  double from = 0, to = 0;  // s
  BodyPath path;
};

/// Triangles that stand for a body in the second look, in its frame, about its centre of mass: the
/// surface of what does not move or is not convex, within `near` (world) of the other body; of what
/// moves an octahedron or box of half the size, which no contact reaches. Empty where there is
/// nothing to stand for it (distance grids).
[[nodiscard]] SweptBody core_of(const World& world, int row, const Aabb& near);

/// Keeps the way up to t of a row whose path is about to change.
void keep_trail(World& world, int row, double t);

/// Checks all pairs of ways of the step that came near each other; adds to the report.
void verify_step(World& world);

}  // namespace carom
