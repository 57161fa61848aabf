// SPDX-License-Identifier: Apache-2.0
#include "narrow/sdf_touch.hpp"

#include <cmath>

namespace carom {

using Eigen::Vector3d;

Touch touch(const SdfGrid& grid, const Vector3d& x) {
  Touch t;
  Vector3d g;
  t.gap = grid.sample(x, g);
  t.x = x;
  // No gradient, no direction: on a ridge inside the body. The way from its middle is as good.
  t.normal = g.norm() > tolerance::sdf_gradient ? g : Vector3d(x - grid.box().centre());
  t.normal = t.normal.norm() > 0 ? Vector3d(t.normal.normalized()) : Vector3d(Vector3d::UnitZ());
  return t;
}

bool onto_level(const SdfGrid& grid, Level& at) {
  const double still = tolerance::sdf_settled * grid.spacing;
  const Vector3d p = at.x;
  Vector3d g, x = p;
  double d = grid.sample(x, g);
  for (int i = 0; i < tolerance::newton_iterations && std::abs(d) > still; ++i) {
    if (!(g.norm() > tolerance::sdf_gradient)) break;
    x -= d / g.squaredNorm() * g;
    d = grid.sample(x, g);
  }
  if (std::abs(d) > still) {  // over a crease: the way along the first gradient, halved
    const double start = grid.sample(p, g);
    if (!(g.norm() > tolerance::sdf_gradient)) return false;
    const Vector3d along = (start > 0 ? -1 : 1) / g.norm() * g;
    double low = 0, high = std::abs(start);
    Vector3d unused;
    const auto beyond = [&](double s) {
      return (grid.sample(p + s * along, unused) > 0) != (start > 0);
    };
    for (int i = 0; i < tolerance::level_doublings && !beyond(high); ++i) high *= 2;
    if (!beyond(high)) return false;
    while (high - low > still) {
      const double middle = 0.5 * (low + high);
      (beyond(middle) ? high : low) = middle;
    }
    x = p + high * along;
    (void)grid.sample(x, g);
  }
  at = {x, g.norm() > 0 ? Vector3d(g.normalized()) : Vector3d(Vector3d::UnitZ())};
  return true;
}

Touch measured(const SdfGrid& grid, const Touch& t) {
  if (!(std::abs(t.gap) > tolerance::sdf_settled * grid.spacing)) return t;
  const auto seen = [&](const Vector3d& y) {
    const Vector3d away = y - t.x;
    return Touch{y, away.normalized(), away.norm()};
  };
  const bool beyond = squared_distance(grid.box(), t.x) > 0;
  Vector3d foot = t.x - t.gap * t.normal;
  if (beyond)
    foot = closest_point(*grid.surface, t.x, std::numeric_limits<double>::infinity()).point;
  const Touch level = settle_on_level(grid, foot, seen);
  if (!std::isfinite(level.gap)) return t;
  const double distance = t.gap < 0 ? -level.gap : level.gap;
  // Beside a ridge of the inside the search may end on another side of the body: no measure then.
  if (!beyond && std::abs(distance - t.gap) > grid.spacing + grid.error) return t;
  // Near the level the way to it is too short to tell a direction: its foot is as far off, along
  // the level, as the field is across it.
  if (std::abs(distance) <= grid.spacing) return {t.x, t.normal, distance};
  return {t.x, t.gap < 0 ? level.normal : Vector3d(-level.normal), distance};
}

}  // namespace carom
