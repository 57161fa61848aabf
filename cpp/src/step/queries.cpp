// SPDX-License-Identifier: Apache-2.0
#include "carom/step/queries.hpp"

#include <algorithm>
#include <cmath>

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

/// A question of no end reaches no farther than twice the way across all finite boxes.
double finite_reach(double asked, const Vector3d& origin, const std::vector<Aabb>& boxes) {
  if (std::isfinite(asked)) return asked;
  double far = 1;
  for (const Aabb& box : boxes)
    for (const Vector3d& corner : {box.lower, box.upper})
      for (int i = 0; i < 3; ++i)
        if (std::isfinite(corner[i])) far = std::max(far, std::abs(corner[i] - origin[i]));
  return 4 * far;
}

/// m, as far as it likes; infinite is no end.
void require_reach(double reach, std::string_view field) {
  if (!(reach >= 0)) throw InvalidInput(field, with_unit(reach, "m"), "must be >= 0");
}

void require_pose(const Shape& shape, const Pose& pose) {
  require_valid(shape, "shape");
  for (int i = 0; i < 3; ++i) require_finite(pose.position[i], "position", "m");
}

}  // namespace

SceneQueries::SceneQueries(const Simulation& simulation, std::uint32_t groups)
    : simulation_(simulation) {
  for (int i = 0; i < simulation.size(); ++i) {
    const Scene::Body& body = simulation.scene().bodies[i];
    poses_.push_back(simulation.states().pose(i));
    boxes_.push_back(body.groups & groups ? bounds(body.shape, poses_.back()) : Aabb{});
  }
  const std::vector<std::uint8_t> still(boxes_.size(), 0);  // no pairs are wanted
  (void)tree_.update(boxes_, still);
}

const Shape& SceneQueries::shape_of(int row) const {
  return simulation_.scene().bodies[row].shape;
}

const std::vector<int>& SceneQueries::near(const Aabb& box) const {
  tree_.overlaps(box, rows_);
  return rows_;
}

BodyHit SceneQueries::along(const Vector3d& origin, const Vector3d& d, double length) const {
  const double reach = finite_reach(length, origin, boxes_);
  tree_.crossed(origin, origin + reach * d, rows_);
  BodyHit best;
  for (const int i : rows_) {
    const double limit = std::min(length, best.cast.distance);
    if (std::isfinite(limit) && !swept_box_meets({origin, origin}, limit * d, boxes_[i])) continue;
    const CastHit hit = ray_cast(shape_of(i), poses_[i], origin, d, limit);
    if (hit.hit && hit.distance < best.cast.distance) best = {i, hit};
  }
  return best;
}

BodyHit SceneQueries::ray(const Vector3d& origin, const Vector3d& direction,
                          double max_distance) const {
  const Vector3d d = unit(direction, origin);
  require_reach(max_distance, "max_distance");
  return along(origin, d, max_distance);
}

BodyHit SceneQueries::segment(const Vector3d& start, const Vector3d& end) const {
  for (int i = 0; i < 3; ++i) {
    require_finite(start[i], "start", "m");
    require_finite(end[i], "end", "m");
  }
  const Vector3d way = end - start;
  const double length = way.norm();
  BodyHit hit =
      along(start, length > 0 ? Vector3d(way / length) : Vector3d(Vector3d::UnitX()), length);
  if (hit.row >= 0) hit.cast.distance = length > 0 ? std::min(1.0, hit.cast.distance / length) : 0;
  return hit;
}

BodyHit SceneQueries::shape(const Shape& moving, const Pose& start, const Vector3d& direction,
                            double max_distance) const {
  require_pose(moving, start);
  const Vector3d d = unit(direction, start.position);
  require_reach(max_distance, "max_distance");
  max_distance = finite_reach(max_distance, start.position, boxes_);
  const Aabb box = bounds(moving, start);
  const Vector3d way = max_distance * d;
  BodyHit best;
  for (const int i :
       near({box.lower.cwiseMin(box.lower + way), box.upper.cwiseMax(box.upper + way)})) {
    const double limit = std::min(max_distance, best.cast.distance);
    if (!swept_box_meets(box, limit * d, boxes_[i])) continue;
    const CastHit hit = shape_cast(moving, start, d, limit, shape_of(i), poses_[i]);
    if (hit.hit && hit.distance < best.cast.distance) best = {i, hit};
  }
  return best;
}

std::vector<int> SceneQueries::overlaps(const Shape& shape, const Pose& pose) const {
  require_pose(shape, pose);
  std::vector<int> rows;
  for (const int i : near(bounds(shape, pose)))
    if (closest_points(shape_of(i), poses_[i], shape, pose, 0).distance <= 0) rows.push_back(i);
  return rows;
}

BodyPoint SceneQueries::closest(const Vector3d& point, double reach) const {
  for (int i = 0; i < 3; ++i) require_finite(point[i], "point", "m");
  const NearestBody found = nearest(Sphere{0}, {point, Eigen::Quaterniond::Identity()}, reach);
  return {found.row, found.row < 0 ? 0 : found.points.distance, found.points.point_a};
}

NearestBody SceneQueries::closest(const Shape& shape, const Pose& pose, double reach) const {
  require_pose(shape, pose);
  return nearest(shape, pose, reach);
}

NearestBody SceneQueries::nearest(const Shape& shape, const Pose& pose, double reach) const {
  require_reach(reach, "reach");
  reach = finite_reach(reach, pose.position, boxes_);
  const Aabb box = bounds(shape, pose);
  NearestBody best;
  for (const int i : near(box.inflated(reach))) {
    if (!boxes_[i].inflated(reach).overlaps(box)) continue;
    const ClosestPoints points = closest_points(shape_of(i), poses_[i], shape, pose, reach);
    if (points.distance <= reach && (best.row < 0 || points.distance < best.points.distance)) {
      best = {i, points};
      reach = std::max(0.0, std::min(reach, points.distance));
    }
  }
  return best;
}

std::vector<BodyContact> SceneQueries::contacts(const Shape& shape, const Pose& pose,
                                                double margin) const {
  require_pose(shape, pose);
  require_non_negative(margin, "margin", "m");
  std::vector<BodyContact> out;
  std::vector<Manifold> manifolds;
  for (const int i : near(bounds(shape, pose).inflated(margin))) {
    manifolds.clear();
    collide(shape_of(i), poses_[i], shape, pose, margin, manifolds);
    for (const Manifold& m : manifolds) out.push_back({i, m});
  }
  return out;
}

}  // namespace carom
