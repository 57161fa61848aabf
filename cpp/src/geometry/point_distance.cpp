// SPDX-License-Identifier: Apache-2.0
#include "geometry/point_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <Eigen/Geometry>

#include "carom/geometry/separation.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Nearest of points, each with a direction to fall back on where p lies on it.
PointDistance away_from(const Vector3d& point, const Vector3d& p, const Vector3d& fallback) {
  const Vector3d way = p - point;
  const double far = way.norm();
  return {point, far > 0 ? Vector3d(way / far) : fallback, far};
}

PointDistance to_ends(const Convex& body, const Vector3d& p) {
  const Vector3d from = body.ends[0];
  if (body.end_count == 1) return away_from(from, p, Vector3d::UnitZ());
  const Vector3d along = body.ends[1] - from;
  const double square = along.squaredNorm();
  if (!(square > 0)) return away_from(from, p, Vector3d::UnitZ());
  const double t = std::clamp(along.dot(p - from) / square, 0.0, 1.0);
  return away_from(from + t * along, p, along.unitOrthogonal());
}

PointDistance to_box(const Vector3d& half, const Vector3d& p) {
  int axis = 0;
  const double inside = (p.cwiseAbs() - half).maxCoeff(&axis);
  if (inside > 0) return away_from(p.cwiseMin(half).cwiseMax(-half), p, Vector3d::UnitZ());
  const double sign = p[axis] < 0 ? -1 : 1;
  Vector3d on = p;
  on[axis] = sign * half[axis];
  return {on, sign * Vector3d::Unit(axis), inside};
}

/// A body of revolution about z whose half section, at radius >= 0, is convex: its corners from the
/// top of the axis to the bottom, so that outward is to the left of the way.
PointDistance to_revolved(std::span<const Vector2d> section, const Vector3d& p) {
  const double across = std::hypot(p.x(), p.y());
  const Vector2d q(across, p.z());
  const Vector3d out = across > 0 ? Vector3d(p.x() / across, p.y() / across, 0) : Vector3d::UnitX();
  const auto lifted = [&](const Vector2d& v) {
    return Vector3d(v.x() * out + v.y() * Vector3d::UnitZ());
  };
  Vector2d best_point = section[0], best_normal = Vector2d::UnitY();
  double inside = -infinity, outside = infinity;
  for (std::size_t i = 0; i + 1 < section.size(); ++i) {
    const Vector2d along = section[i + 1] - section[i];
    const double length = along.norm();
    const Vector2d normal = Vector2d(-along.y(), along.x()) / length;
    const double over = normal.dot(q - section[i]),
                 t = along.dot(q - section[i]) / (length * length);
    if (over > 0) {  // seen from here: apart by the height over it, or from a corner
      const Vector2d foot = section[i] + std::clamp(t, 0.0, 1.0) * along;
      const bool above = t >= 0 && t <= 1;
      const double far = above ? over : (q - foot).norm();
      if (far < outside)
        outside = far, best_point = foot, best_normal = above ? normal : Vector2d((q - foot) / far);
    } else if (outside == infinity && over > inside) {
      inside = over, best_point = q - over * normal, best_normal = normal;
    }
  }
  return {lifted(best_point), lifted(best_normal), outside < infinity ? outside : inside};
}

PointDistance to_cylinder(const Vector3d& size, const Vector3d& p) {
  const double r = size.x(), h = size.z();
  return to_revolved(std::array{Vector2d(0, h), Vector2d(r, h), Vector2d(r, -h), Vector2d(0, -h)},
                     p);
}

PointDistance to_cone(const Vector3d& size, const Vector3d& p) {
  const double r = size.x(), h = size.z();
  return to_revolved(std::array{Vector2d(0, 1.5 * h), Vector2d(r, -0.5 * h), Vector2d(0, -0.5 * h)},
                     p);
}

/// The nearest point is x_i = r_i^2 p_i / (t + r_i^2), where t is the largest root of
/// sum (r_i p_i / (t + r_i^2))^2 = 1. In s = t + r_min^2, from where one term is 1 and the others
/// less, Newton's method on one over the root of the sum ascends: of one term that is a line. Of a
/// point that all but lies in the plane of the longer axes it starts near a pole, which it leaves
/// by half as much again in each step. Source: D. Eberly, Distance from a Point to an Ellipse, an
/// Ellipsoid, or a Hyperellipsoid, 2013; J. More, D. Sorensen, SIAM J. Sci. Stat. Comput. 4(3),
/// 1983.
PointDistance to_ellipsoid(const Vector3d& radii, const Vector3d& p) {
  int least = 0;
  radii.minCoeff(&least);
  const Vector3d square = radii.cwiseAbs2(), scaled = radii.cwiseProduct(p.cwiseAbs());
  // Differences of squares as products: of nearly equal radii they keep their digits.
  Vector3d more;
  for (int i = 0; i < 3; ++i) more[i] = (radii[i] - radii[least]) * (radii[i] + radii[least]);
  double s = (scaled - more).maxCoeff();
  Vector3d x;
  if (s > 0) {
    for (int i = 0; i < tolerance::ellipsoid_iterations; ++i) {
      const Eigen::Array3d ratio = scaled.array() / (s + more.array());
      const double whole = ratio.square().sum(), root = std::sqrt(whole);
      const double slope = (ratio.square() / (s + more.array())).sum();
      const double step = whole * (root - 1) / slope;
      if (!(step > 0)) break;
      s += step;
      if (step <= tolerance::unit_roundoff * s) break;
    }
    x = square.cwiseProduct(p).cwiseQuotient((more.array() + s).matrix());
  } else {  // in the plane of the two longer axes, too near to the middle for its rim
    x.setZero();
    double left = 1;
    for (int i = 0; i < 3; ++i)
      if (more[i] > 0) x[i] = square[i] * p[i] / more[i], left -= x[i] * x[i] / square[i];
    x[least] = radii[least] * std::sqrt(std::max(left, 0.0));
    s = 0;
  }
  const Vector3d gradient = x.cwiseQuotient(square);
  const double slope = gradient.norm();
  return {x, gradient / slope, (s - square[least]) * slope};
}

PointDistance to_hull(const Convex& body, const Vector3d& p) {
  if (body.polytope != nullptr) {
    const Polytope& hull = *body.polytope;
    double inside = -infinity;
    int nearest = 0;
    for (int f = 0; f < hull.face_count() && inside <= 0; ++f)
      if (const double d = hull.normals[f].dot(p) - hull.offsets[f]; d > inside)
        inside = d, nearest = f;
    if (inside <= 0) return {p - inside * hull.normals[nearest], hull.normals[nearest], inside};
  }
  const Separation s = separation(Convex::point(p), Convex::hull(body.points), Frame{}, infinity);
  return {s.point_b, -s.normal, s.distance};
}

PointDistance to_core(const Convex& body, const Vector3d& p) {
  switch (body.kind) {
    case Convex::Kind::box:
      return to_box(body.size, p);
    case Convex::Kind::cylinder:
      return to_cylinder(body.size, p);
    case Convex::Kind::cone:
      return to_cone(body.size, p);
    case Convex::Kind::ellipsoid:
      return to_ellipsoid(body.size, p);
    case Convex::Kind::points:
      break;
  }
  return body.end_count > 0 ? to_ends(body, p) : to_hull(body, p);
}

}  // namespace

PointDistance point_distance(const Convex& body, const Vector3d& p) {
  PointDistance out = to_core(body, p);
  out.point += body.radius * out.normal;
  out.distance -= body.radius;
  return out;
}

}  // namespace carom
