// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/interior_normal.hpp"

#include <algorithm>
#include <cmath>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// Unit gradient at x; false where it has no direction to trust.
bool direction(const SdfGrid& grid, const Vector3d& x, Vector3d& n, double& distance) {
  distance = grid.sample(x, n);
  const double length = n.norm();
  if (!(length > tolerance::sdf_gradient)) return false;
  n /= length;
  return true;
}

/// First point of the path on the surface: steps of the distance left, which cannot jump over it,
/// then halving.
bool first_hit(const SdfGrid& grid, const Vector3d& from, const Vector3d& to, Vector3d& hit) {
  const Vector3d path = to - from;
  const double length = path.norm();
  Vector3d unused;
  double low = 0, high = 1;
  for (int i = 0; i < tolerance::projections; ++i) {
    const double d = grid.sample(from + low * path, unused);
    if (d <= 0) {
      if (low == 0) return false;  // it was inside to begin with
      break;
    }
    const double next = std::min(1.0, low + std::max(d, 0.1 * grid.spacing) / length);
    if (grid.sample(from + next * path, unused) <= 0) {
      high = next;
      break;
    }
    if (next >= 1) return false;
    low = next;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (grid.sample(from + middle * path, unused) > 0 ? low : high) = middle;
  }
  hit = from + low * path;
  return true;
}

}  // namespace

InteriorNormal interior_normal(const SdfGrid& grid, const Vector3d& from, const Vector3d& to,
                               NormalCounts& counts, const InteriorNormalOptions& options) {
  for (int i = 0; i < 3; ++i)
    require_finite(from[i], "from", "m"), require_finite(to[i], "to", "m");
  const Vector3d motion = to - from;
  if (!(motion.norm() > 0))
    throw InvalidInput("to", with_unit(to.transpose(), "m"), "must differ from `from`");
  InteriorNormal out;
  double distance;
  Vector3d n;
  const auto opposes = [&](double cosine) { return n.dot(motion) < -cosine * motion.norm(); };
  const bool has_gradient = direction(grid, to, n, distance);
  out.depth = -distance;
  Vector3d unused, hit;
  const double slack = std::max(grid.error, tolerance::sdf_settled * grid.spacing);
  if (options.gradient && has_gradient && opposes(tolerance::opposing) &&
      std::abs(grid.sample(to - distance * n, unused)) <= 2 * slack) {
    out.normal = n;
    out.source = NormalSource::gradient;
  } else if (options.swept_hit && first_hit(grid, from, to, hit) &&
             direction(grid, hit, n, distance) && opposes(0)) {
    out.normal = n;
    out.source = NormalSource::swept_hit;
    out.depth = n.dot(hit - to);
  } else {
    out.normal = -motion.normalized();
    out.source = NormalSource::velocity;
    out.depth = motion.norm();
  }
  counts.count(out.source);
  return out;
}

double repulsion_speed(double depth, double normal_velocity, double dt, bool bounded, double cap) {
  if (!(depth > 0) || !(dt > 0)) return 0;
  const double push = depth / dt;
  if (!bounded) return push;
  return std::max(0.0, std::min(push, cap) - normal_velocity);
}

}  // namespace carom
