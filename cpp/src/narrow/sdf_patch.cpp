// SPDX-License-Identifier: Apache-2.0
#include "narrow/sdf_patch.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "carom/numerics/tolerance.hpp"

namespace carom {

using Eigen::Vector3d;

void SdfPatch::add(const Touch& t, double radius, std::uint32_t name) {
  found.push_back(
      {t.normal,
       {t.x - (radius + 0.5 * t.gap) * t.normal, t.gap, feature::pair(feature::curve(0), name)}});
}

void SdfPatch::add_both(const Touch& on_other, const Touch& on_grid, double error, double margin) {
  Candidate one{on_other.normal,
                {on_other.x - 0.5 * on_other.gap * on_other.normal, on_other.gap,
                 feature::pair(feature::curve(0), feature::curve(1))}};
  Candidate two{-on_grid.normal,
                {on_grid.x - 0.5 * on_grid.gap * on_grid.normal, on_grid.gap,
                 feature::pair(feature::curve(0), feature::curve(3))}};
  const double between = on_grid.gap - on_other.gap;
  if (std::isfinite(between) && one.normal.dot(two.normal) > 0 &&
      one.normal.cross(two.normal).norm() < tolerance::similar_normal) {
    const double share = std::clamp(0.5 + 0.5 * between / error, 0.0, 1.0);
    one.normal = (share * one.normal + (1 - share) * two.normal).normalized();
    one.point.position = share * one.point.position + (1 - share) * two.point.position;
    one.point.separation = std::min(on_other.gap, on_grid.gap);
    two.point.separation = std::numeric_limits<double>::infinity();
  }
  for (const Candidate& c : {one, two})
    if (c.point.separation <= margin) found.push_back(c);
}

double blur(const SdfGrid& grid) {
  return std::max(grid.error, tolerance::sdf_settled * grid.spacing);
}

Vector3d lowest_vertex(const MeshSurface& surface, const Frame& frame, const Vector3d& n) {
  Eigen::Index row;
  (surface.mesh.vertices * (frame.rotation.transpose() * n)).minCoeff(&row);
  return frame * Vector3d(surface.mesh.vertices.row(row).transpose());
}

}  // namespace carom
