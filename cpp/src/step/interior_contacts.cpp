// SPDX-License-Identifier: Apache-2.0
#include "step/interior_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "carom/geometry/frame.hpp"
#include "carom/narrow/interior_normal.hpp"
#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

const SdfGrid* grid_of(const Shape& shape) {
  const auto* sdf = std::get_if<Sdf>(&shape);
  return sdf ? sdf->grid.get() : nullptr;
}

/// m; nothing for what is not made of balls.
double ball_radius(const Shape& shape) {
  if (const auto* ball = std::get_if<Sphere>(&shape)) return ball->radius;
  if (const auto* set = std::get_if<ParticleSet>(&shape)) return set->radius;
  return 0;
}

/// Way out along n, m: steps of the distance left, and never less than a tenth of a cell.
double way_out(const SdfGrid& grid, const Vector3d& x, const Vector3d& n) {
  Vector3d unused;
  double s = 0;
  for (int i = 0; i < 16 * tolerance::projections; ++i) {
    const double gap = grid.sample(x + s * n, unused);
    if (gap >= -tolerance::sdf_settled * grid.spacing) break;
    s += std::max(-gap, 0.1 * grid.spacing);
  }
  return s;
}

/// The contact of the same two features a step ago, where it overlapped.
const Contact* before(const World& world, const Contact& c) {
  const auto key = [](const Contact& x) { return std::pair(x.a, x.b); };
  const auto [first, last] = std::ranges::equal_range(world.contacts_before, key(c), {}, key);
  const auto at = std::find_if(first, last, [&](const Contact& old) {
    return old.feature == c.feature && old.separation < 0;
  });
  return at == last ? nullptr : &*at;
}

void refine(World& world, Contact& c, const SdfGrid& grid, bool grid_is_a, double radius) {
  RepulsionReport& report = world.report.repulsion;
  const double sign = grid_is_a ? 1 : -1;
  const int row = grid_is_a ? c.a : c.b, other = grid_is_a ? c.b : c.a;
  const Frame frame(world.states.pose(row));
  const Vector3d x = c.position + (radius + 0.5 * c.separation) * sign * c.normal;
  const Vector3d to = frame.to_local(x);
  Vector3d unused;
  if (grid.sample(to, unused) >= 0) return;  // outside, the gradient is right
  const Vector3d motion =
      world.dt * (world.states.velocity_at(other, x) - world.states.velocity_at(row, x));
  const Vector3d from = frame.to_local(x - motion);
  Vector3d n;
  double depth;
  if (grid.sample(from, unused) > 0) {
    NormalCounts counts;
    const InteriorNormal found = interior_normal(grid, from, to, counts);
    report.gradient += counts.gradient;
    report.swept_hit += counts.swept_hit;
    report.velocity += counts.velocity;
    n = found.normal;
    depth = found.depth;
  } else if (const Contact* old = before(world, c)) {
    const Vector3d turn = world.dt * world.states.angular_velocity(row);
    n = frame.rotation.transpose() * (rotation_exponential(turn) * (sign * old->normal));
    depth = way_out(grid, to, n);
    ++report.kept;
  } else {  // put there: no path tells more than the gradient
    ++report.gradient;
    return;
  }
  const Vector3d out = frame.rotation * n;
  c.normal = sign * out;
  c.separation = -depth - radius;
  c.position = x - (radius + 0.5 * c.separation) * out;
}

}  // namespace

void refine_interior_contacts(World& world) {
  for (Contact& c : world.contacts) {
    if (!(c.separation < 0)) continue;
    const Shape &a = world.scene.bodies[c.a].shape, &b = world.scene.bodies[c.b].shape;
    const SdfGrid *grid_a = grid_of(a), *grid_b = grid_of(b);
    if (grid_a && ball_radius(b) > 0) refine(world, c, *grid_a, true, ball_radius(b));
    if (grid_b && ball_radius(a) > 0) refine(world, c, *grid_b, false, ball_radius(a));
  }
}

}  // namespace carom
