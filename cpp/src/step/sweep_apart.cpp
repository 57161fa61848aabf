// SPDX-License-Identifier: Apache-2.0
// What the solver holds need not be followed: one direction parts the two all the way.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "carom/geometry/convex.hpp"
#include "carom/geometry/frame.hpp"
#include "carom/numerics/tolerance.hpp"

#include "step/sweep.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// How far a shape reaches along n, m; infinite where it has no end or no support function.
double reach_along(const Shape& shape, const Frame& frame, const Vector3d& n) {
  const Vector3d n_b = frame.rotation.transpose() * n;
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    const Vector3d up = plane->normal.normalized();
    if (up.dot(n_b) < 1 - tolerance::same_normal) return std::numeric_limits<double>::infinity();
    return n.dot(frame.translation) + plane->offset;
  }
  const std::optional<Convex> convex = convex_of(shape);
  if (!convex) return std::numeric_limits<double>::infinity();
  return n.dot(frame * convex->support(n_b)) + convex->radius;
}

/// How far beyond the ends of a way its middle may lie along n, m: a h^2 / 8 of what is bent, the
/// centripetal acceleration of what turns included.
double bulge(const World& world, int i, const Vector3d& n, double t) {
  const BodyPath& path = world.sweep.paths[i];
  double rate = 0;
  for (const BodyPath::Arc& arc : path.arcs) rate = std::max(rate, arc.rate.squaredNorm());
  const double h = world.dt - t;
  return 0.125 * h * h *
         (std::abs(n.dot(path.acceleration)) + rate * world.sweep.turning_radius[i]);
}

}  // namespace

bool stays_apart(const World& world, int a, int b, double t) {
  const SweepWork& w = world.sweep;
  const double thin = std::min(w.thickness[a], w.thickness[b]);
  if (!(thin > 0)) return false;
  const auto key = [](const Contact& c) { return BodyPair{c.a, c.b}; };
  const auto [first, last] = std::ranges::equal_range(world.contacts, BodyPair{a, b}, {}, key);
  if (first == last) return false;
  const Vector3d n = first->normal;
  if (std::any_of(first, last, [&](const Contact& c) { return c.normal != n; })) return false;
  const Shape &of_a = world.scene.bodies[a].shape, &of_b = world.scene.bodies[b].shape;
  double overlap = 0;
  for (const double at : {t, world.dt}) {
    const double end_of_a = reach_along(of_a, Frame(w.paths[a].pose_at(at)), n);
    const double end_of_b = reach_along(of_b, Frame(w.paths[b].pose_at(at)), -n);
    overlap = std::max(overlap, end_of_a + end_of_b);
  }
  return overlap + bulge(world, a, n, t) + bulge(world, b, n, t) <= tolerance::sweep_held * thin;
}

}  // namespace carom
