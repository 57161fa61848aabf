// SPDX-License-Identifier: Apache-2.0
#include "carom/step/queries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

Vector3d unit(const Vector3d& direction, const Vector3d& origin) {
  for (int i = 0; i < 3; ++i) {
    require_finite(direction[i], "direction", "m");
    require_finite(origin[i], "origin", "m");
  }
  const double length = direction.norm();
  require_positive(length, "direction", "m", "give a direction with a length");
  return direction / length;
}

/// Whether a box that travels from `start` by `way` can meet `box`: their swept hull does.
bool swept_box_meets(const Aabb& start, const Vector3d& way, const Aabb& box) {
  return (start.lower.array() + way.array().min(0.0) <= box.upper.array()).all() &&
         (box.lower.array() <= start.upper.array() + way.array().max(0.0)).all();
}

/// @throws InvalidInput for NaN and below 0; infinity is the default of every query
void require_reach(double value, const char* field) {
  if (value != std::numeric_limits<double>::infinity()) require_non_negative(value, field, "m");
}

/// A ray of no end reaches no farther than twice the way across all finite boxes.
double finite_reach(double asked, const Vector3d& origin, const std::vector<Aabb>& boxes) {
  if (std::isfinite(asked)) return asked;
  double far = 1;
  for (const Aabb& box : boxes)
    for (const Vector3d& corner : {box.lower, box.upper})
      for (int i = 0; i < 3; ++i)
        if (std::isfinite(corner[i])) far = std::max(far, std::abs(corner[i] - origin[i]));
  return 4 * far;
}

}  // namespace

SceneQueries::SceneQueries(const Simulation& simulation) : simulation_(simulation) {
  for (int i = 0; i < simulation.size(); ++i) {
    poses_.push_back(simulation.states().pose(i));
    boxes_.push_back(bounds(simulation.scene().bodies[i].shape, poses_.back()));
  }
}

BodyHit SceneQueries::ray(const Vector3d& origin, const Vector3d& direction,
                          double max_distance) const {
  const Vector3d d = unit(direction, origin);
  require_reach(max_distance, "max_distance");
  BodyHit best;
  for (int i = 0; i < static_cast<int>(poses_.size()); ++i) {
    const double limit = std::min(max_distance, best.cast.distance);
    if (std::isfinite(limit) && !swept_box_meets({origin, origin}, limit * d, boxes_[i])) continue;
    const CastHit hit = ray_cast(simulation_.scene().bodies[i].shape, poses_[i], origin, d, limit);
    if (hit.hit && hit.distance < best.cast.distance) best = {i, hit};
  }
  return best;
}

BodyHit SceneQueries::shape(const Shape& moving, const Pose& start, const Vector3d& direction,
                            double max_distance) const {
  require_valid(moving, "shape");
  const Vector3d d = unit(direction, start.position);
  require_reach(max_distance, "max_distance");
  max_distance = finite_reach(max_distance, start.position, boxes_);
  const Aabb box = bounds(moving, start);
  BodyHit best;
  for (int i = 0; i < static_cast<int>(poses_.size()); ++i) {
    const double limit = std::min(max_distance, best.cast.distance);
    if (!swept_box_meets(box, limit * d, boxes_[i])) continue;
    const CastHit hit =
        shape_cast(moving, start, d, limit, simulation_.scene().bodies[i].shape, poses_[i]);
    if (hit.hit && hit.distance < best.cast.distance) best = {i, hit};
  }
  return best;
}

std::vector<int> SceneQueries::overlaps(const Shape& shape, const Pose& pose) const {
  require_valid(shape, "shape");
  const Aabb box = bounds(shape, pose);
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(poses_.size()); ++i)
    if (box.overlaps(boxes_[i]) &&
        closest_points(simulation_.scene().bodies[i].shape, poses_[i], shape, pose, 0).distance <=
            0)
      rows.push_back(i);
  return rows;
}

BodyPoint SceneQueries::closest(const Vector3d& point, double reach) const {
  for (int i = 0; i < 3; ++i) require_finite(point[i], "point", "m");
  require_reach(reach, "reach");
  reach = finite_reach(reach, point, boxes_);
  BodyPoint best;
  const Shape dot = Sphere{0};
  const Pose at{point, Eigen::Quaterniond::Identity()};
  for (int i = 0; i < static_cast<int>(poses_.size()); ++i) {
    if (!boxes_[i].inflated(reach).overlaps({point, point})) continue;
    const ClosestPoints near =
        closest_points(simulation_.scene().bodies[i].shape, poses_[i], dot, at, reach);
    if (near.distance <= reach && (best.row < 0 || near.distance < best.distance)) {
      best = {i, near.distance, near.point_a};
      reach = std::max(0.0, std::min(reach, near.distance));
    }
  }
  return best;
}

}  // namespace carom
