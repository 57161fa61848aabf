// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "carom/geometry/triangle.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "geometry/plain_nodes.hpp"
#include "narrow/normal_cone.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// One point where the ball meets a surface that lies at signed distance `gap` + radius.
void add(const Vector3d& centre, const Vector3d& normal, double distance, double radius,
         std::uint32_t feature_a, std::vector<Manifold>& out) {
  Manifold& m = out.emplace_back();
  const double gap = distance - radius;
  m.normal = normal;
  m.count = 1;
  m.points[0] = {centre - (radius + 0.5 * gap) * normal, gap,
                 feature::pair(feature_a, feature::curve(0))};
}

}  // namespace

void ball_ball(double radius_a, const Vector3d& centre, double radius, double margin,
               std::vector<Manifold>& out) {
  const double reach = radius_a + radius + margin, square = centre.squaredNorm();
  if (square > reach * reach) return;
  const double distance = std::sqrt(square);
  const Vector3d n = distance > 0 ? Vector3d(centre / distance) : Vector3d::UnitZ();
  add(centre, n, distance - radius_a, radius, feature::curve(0), out);
}

void box_ball(const Vector3d& half, const Vector3d& centre, double radius, double margin,
              std::vector<Manifold>& out) {
  const Vector3d nearest = centre.cwiseMax(-half).cwiseMin(half);
  const Vector3d away = centre - nearest;
  const double distance = away.norm();
  if (distance - radius > margin) return;
  if (distance > 0) {
    const int signs = (centre.x() > 0) | (centre.y() > 0) << 1 | (centre.z() > 0) << 2;
    const int outside = (away.x() != 0) | (away.y() != 0) << 1 | (away.z() != 0) << 2;
    return add(centre, away / distance, distance, radius, feature::curve(signs << 3 | outside),
               out);
  }
  int axis;  // the nearest of the six faces, from inside
  const double depth = (half - centre.cwiseAbs()).minCoeff(&axis);
  const double side = centre[axis] < 0 ? -1 : 1;
  const int signs = (centre.x() > 0) | (centre.y() > 0) << 1 | (centre.z() > 0) << 2;
  add(centre, side * Vector3d::Unit(axis), -depth, radius, feature::curve(signs << 3 | 1 << axis),
      out);
}

void surface_ball(const MeshSurface& a, const Vector3d& centre, double radius, double margin,
                  std::vector<Manifold>& out) {
  const double reach = radius + margin;
  const Vector3d around = Vector3d::Constant(reach);
  if (const int f = lone_plane(a, {centre - around, centre + around}); f >= 0)
    if (const double height = a.face_normals[f].dot(centre - a.corner(f, 0)); height > 0) {
      if (height <= reach) add(centre, a.face_normals[f], height, radius, feature::face(f), out);
      return;
    }
  const SurfacePoint nearest = closest_point(a, centre, std::numeric_limits<double>::infinity());
  if (nearest.face < 0 || nearest.distance > reach) return;
  if (nearest.distance <= 0)
    return add(centre, nearest.normal, nearest.distance, radius, nearest.feature, out);
  // Outside: every feature that is nearest to the centre in its own neighbourhood holds the ball.
  // Faces of one plane, and an edge or corner met through several faces, count once.
  const std::size_t begin = out.size();
  const auto known = [&](std::uint32_t feature) {
    for (std::size_t i = begin; i < out.size(); ++i)
      if (out[i].points[0].feature == feature::pair(feature, feature::curve(0))) return true;
    return false;
  };
  a.tree.query([&](const Aabb& box) { return squared_distance(box, centre) <= reach * reach; },
               [&](int f) {
                 if (a.face_normals[f].isZero(0)) return;
                 const TrianglePoint q =
                     closest_point(centre, a.corner(f, 0), a.corner(f, 1), a.corner(f, 2));
                 const Vector3d away = centre - q.point;
                 const double distance = away.norm();
                 if (distance > reach) return;
                 const std::optional<std::uint32_t> feature = held_by(a, f, q.feature, away);
                 if (!feature || known(*feature)) return;
                 const bool on_face = *feature == feature::face(a.face_cluster[f]);
                 add(centre, on_face ? a.face_normals[f] : Vector3d(away / distance), distance,
                     radius, *feature, out);
               });
}

}  // namespace carom
