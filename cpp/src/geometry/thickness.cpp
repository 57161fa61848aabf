// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/sdf.hpp"

namespace carom {
namespace {

/// Distance from the mean of the corners to the nearest face: a ball about it fits.
double inner_radius_of(const Polytope& p) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : p.vertices) centre += v;
  centre /= static_cast<double>(p.vertices.size());
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < p.face_count(); ++f)
    least = std::min(least, p.offsets[f] - p.normals[f].dot(centre));
  return std::max(least, 0.0);
}

double inner_radius_of(const MeshSurface& s) {
  if (s.polytope) return inner_radius_of(*s.polytope);
  if (!s.faults.closed()) return 0;
  double twice_area = 0;
  for (Eigen::Index f = 0; f < s.mesh.faces.rows(); ++f) {
    const int i = static_cast<int>(f);
    const Eigen::Vector3d e = s.corner(i, 1) - s.corner(i, 0);
    twice_area += e.cross(s.corner(i, 2) - s.corner(i, 0)).norm();
  }
  return twice_area > 0 ? 2 * std::abs(s.volume) / twice_area : 0;
}

struct Inner {
  double operator()(const Sphere& s) const { return s.radius; }
  double operator()(const Box& b) const { return 0.5 * b.extents.minCoeff(); }
  double operator()(const Plane&) const { return std::numeric_limits<double>::infinity(); }
  double operator()(const Mesh& m) const { return inner_radius_of(*m.surface); }
  double operator()(const Capsule& c) const { return c.radius; }
  double operator()(const Cylinder& c) const { return std::min(c.radius, 0.5 * c.length); }
  // About the axis, where base and side are equally far.
  double operator()(const Cone& c) const {
    return c.radius * c.length / (c.radius + std::hypot(c.radius, c.length));
  }
  double operator()(const Ellipsoid& e) const { return e.radii.minCoeff(); }
  double operator()(const ConvexHull& h) const { return inner_radius_of(*h.surface->polytope); }
  double operator()(const Sdf& s) const { return s.grid->spacing; }
  double operator()(const HeightField&) const { return 0; }
  double operator()(const ParticleSet& p) const { return p.radius; }
  double operator()(const Compound& c) const {
    double least = std::numeric_limits<double>::infinity();
    for (const CompoundPart& part : *c.parts) least = std::min(least, inner_radius(part.shape));
    return least;
  }
};

}  // namespace

double inner_radius(const Shape& shape) {
  return std::visit(Inner{}, shape);
}

double turning_radius(const Shape& shape) {
  if (std::holds_alternative<Sphere>(shape)) return 0;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return 0.5 * capsule->length;
  return bounding_radius(shape);
}

}  // namespace carom
