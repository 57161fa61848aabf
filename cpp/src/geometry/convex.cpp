// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/convex.hpp"

#include <algorithm>
#include <cmath>

#include "carom/geometry/mesh_surface.hpp"

namespace carom {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Rim point of a disc of radius r about z in direction d; the axis itself has none to prefer.
Vector3d rim(const Vector3d& d, double r) {
  const double across = std::hypot(d.x(), d.y());
  return across > 0 ? Vector3d(r * d.x() / across, r * d.y() / across, 0) : Vector3d(r, 0, 0);
}

/// Cone: base at -h/4, apex at 3h/4, size.z = h / 2.
double apex(const Convex& c) {
  return 1.5 * c.size.z();
}
double base(const Convex& c) {
  return -0.5 * c.size.z();
}

bool meets_apex(const Convex& c, const Vector3d& d) {
  return apex(c) * d.z() >= c.size.x() * std::hypot(d.x(), d.y()) + base(c) * d.z();
}

Matrix3d disc_derivative(const Vector3d& n, double r) {
  const double across = std::hypot(n.x(), n.y());
  Matrix3d out = Matrix3d::Zero();
  if (!(across > 0)) return out;
  const Eigen::Vector2d t(-n.y() / across, n.x() / across);
  out.topLeftCorner<2, 2>() = r / across * t * t.transpose();
  return out;
}

struct Visit {
  std::optional<Convex> operator()(const Sphere& s) const {
    return Convex::point(Vector3d::Zero(), s.radius);
  }
  std::optional<Convex> operator()(const Box& b) const {
    return of_size(Convex::Kind::box, 0.5 * b.extents);
  }
  std::optional<Convex> operator()(const Mesh& m) const {
    if (!m.surface->polytope) return {};
    return Convex::hull(*m.surface->polytope);
  }
  std::optional<Convex> operator()(const Capsule& c) const {
    return Convex::segment({0, 0, -0.5 * c.length}, {0, 0, 0.5 * c.length}, c.radius);
  }
  std::optional<Convex> operator()(const Cylinder& c) const {
    return of_size(Convex::Kind::cylinder, {c.radius, c.radius, 0.5 * c.length});
  }
  std::optional<Convex> operator()(const Cone& c) const {
    return of_size(Convex::Kind::cone, {c.radius, c.radius, 0.5 * c.length});
  }
  std::optional<Convex> operator()(const Ellipsoid& e) const {
    return of_size(Convex::Kind::ellipsoid, e.radii);
  }
  std::optional<Convex> operator()(const ConvexHull& h) const {
    return Convex::hull(*h.surface->polytope);
  }
  std::optional<Convex> operator()(const auto&) const { return {}; }

  static Convex of_size(Convex::Kind kind, const Vector3d& size) {
    Convex c;
    c.kind = kind;
    c.size = size;
    return c;
  }
};

}  // namespace

Convex Convex::point(const Vector3d& at, double radius) {
  Convex c;
  c.radius = radius;
  c.ends[0] = at;
  c.end_count = 1;
  return c;
}

Convex Convex::segment(const Vector3d& from, const Vector3d& to, double radius) {
  Convex c = point(from, radius);
  c.ends[1] = to;
  c.end_count = 2;
  return c;
}

Convex Convex::hull(std::span<const Vector3d> points) {
  Convex c;
  c.points = points;
  return c;
}

Convex Convex::hull(const Polytope& polytope) {
  Convex c = hull(polytope.vertices);
  c.polytope = &polytope;
  return c;
}

Vector3d Convex::support(const Vector3d& d) const {
  switch (kind) {
    case Kind::box:
      return {d.x() < 0 ? -size.x() : size.x(), d.y() < 0 ? -size.y() : size.y(),
              d.z() < 0 ? -size.z() : size.z()};
    case Kind::cylinder:
      return rim(d, size.x()) + Vector3d(0, 0, d.z() < 0 ? -size.z() : size.z());
    case Kind::cone:
      if (meets_apex(*this, d)) return {0, 0, apex(*this)};
      return rim(d, size.x()) + Vector3d(0, 0, base(*this));
    case Kind::ellipsoid: {
      const Vector3d scaled = size.cwiseProduct(d);
      return size.cwiseProduct(scaled) / scaled.norm();
    }
    case Kind::points:
      break;
  }
  const auto all = corners();
  std::size_t best = 0;
  double top = all[0].dot(d);
  for (std::size_t i = 1; i < all.size(); ++i)
    if (const double s = all[i].dot(d); s > top) top = s, best = i;
  return all[best];
}

Matrix3d Convex::support_derivative(const Vector3d& n) const {
  switch (kind) {
    case Kind::cylinder:
      return disc_derivative(n, size.x());
    case Kind::cone:
      return meets_apex(*this, n) ? Matrix3d::Zero() : disc_derivative(n, size.x());
    case Kind::ellipsoid: {
      const Vector3d s2n = size.cwiseAbs2().cwiseProduct(n);
      const double h = size.cwiseProduct(n).norm();
      return Matrix3d(size.cwiseAbs2().asDiagonal()) / h - s2n * s2n.transpose() / (h * h * h);
    }
    case Kind::box:
    case Kind::points:
      break;
  }
  return Matrix3d::Zero();
}

double Convex::bounding_radius() const {
  double core = 0;
  switch (kind) {
    case Kind::box:
      core = size.norm();
      break;
    case Kind::cylinder:
      core = std::hypot(size.x(), size.z());
      break;
    case Kind::cone:
      core = std::max(apex(*this), std::hypot(size.x(), base(*this)));
      break;
    case Kind::ellipsoid:
      core = size.maxCoeff();
      break;
    case Kind::points:
      for (const Vector3d& p : corners()) core = std::max(core, p.norm());
  }
  return core + radius;
}

std::optional<Convex> convex_of(const Shape& shape) {
  return std::visit(Visit{}, shape);
}

}  // namespace carom
