// SPDX-License-Identifier: Apache-2.0
#include "geometry/creases.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "carom/numerics/tolerance.hpp"

namespace carom::detail {
namespace {

using Eigen::Vector3d;

struct Collect {
  const Vector3d& n;
  Creases& out;

  void face(const Vector3d& normal) const {
    if ((n - normal).norm() <= tolerance::crease) out.normals.push_back(normal);
  }
  void circle(const Vector3d& axis, double level) const {
    if (std::abs(n.dot(axis) - level) <= tolerance::crease) out.circles.push_back({axis, level});
  }
};

void of_points(const Convex& body, const Collect& collect) {
  const auto points = body.corners();
  if (body.polytope) {
    for (const Vector3d& f : body.polytope->normals) collect.face(f);
    const Vector3d tip = body.support(collect.n);
    for (const auto& e : body.polytope->edges) {
      const Vector3d &p = points[e.v0], &q = points[e.v1];
      const double length = (q - p).norm();
      if (std::max(collect.n.dot(p - tip), collect.n.dot(q - tip)) >= -tolerance::crease * length)
        collect.circle((q - p) / length, 0);
    }
    return;
  }
  if (points.size() == 3) {
    const Vector3d f = (points[1] - points[0]).cross(points[2] - points[0]).normalized();
    collect.face(f);
    collect.face(-f);
  }
  for (std::size_t i = 0; i < points.size() && points.size() > 1; ++i) {
    if (points.size() == 2 && i == 1) break;
    const Vector3d e = points[(i + 1) % points.size()] - points[i];
    if (e.squaredNorm() > 0) collect.circle(e.normalized(), 0);
  }
}

}  // namespace

void creases_near(const Convex& body, const Vector3d& n, Creases& out) {
  out.normals.clear();
  out.circles.clear();
  const Collect collect{n, out};
  switch (body.kind) {
    case Convex::Kind::box:
      for (int i = 0; i < 3; ++i) {
        collect.face(Vector3d::Unit(i));
        collect.face(-Vector3d::Unit(i));
        collect.circle(Vector3d::Unit(i), 0);
      }
      break;
    case Convex::Kind::cylinder:
      collect.face(Vector3d::UnitZ());
      collect.face(-Vector3d::UnitZ());
      collect.circle(Vector3d::UnitZ(), 0);
      break;
    case Convex::Kind::cone:  // side normals rise by the half angle at the apex
      collect.face(-Vector3d::UnitZ());
      collect.circle(Vector3d::UnitZ(),
                     body.size.x() / std::hypot(body.size.x(), 2 * body.size.z()));
      break;
    case Convex::Kind::ellipsoid:
      break;
    case Convex::Kind::points:
      of_points(body, collect);
  }
}

}  // namespace carom::detail
