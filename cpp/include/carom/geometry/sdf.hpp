// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "carom/geometry/aabb.hpp"
#include "carom/geometry/mesh_surface.hpp"

namespace carom {

/// Signed distance to a surface, negative inside, sampled on a regular grid and interpolated by
/// cubic splines, which have no kinks: exact for cubic distances; of smooth ones off by
/// h^4/384 |d4 phi / dx4| along each axis, slopes by sqrt(3)/216 h^3 of the same; by about a tenth
/// of a cell at a sharp edge, and four cells away from it not at all.
struct SdfGrid {
  Eigen::Vector3d lower;                            ///< m, first sample
  double spacing = 0;                               ///< m, cell size h
  Eigen::Vector3i count = Eigen::Vector3i::Zero();  ///< samples along each axis, >= 4
  std::vector<double> coefficients;                 ///< m, of B-splines, count + 2, x fastest
  double error =
      0;  ///< m, largest |interpolated - true| met at the centres of cells the surface cuts
  std::shared_ptr<const MeshSurface> surface;  ///< of the zero level, vertices put onto it

  using Distance = std::function<double(const Eigen::Vector3d&)>;

  /// Samples a function over a box grown by two cells.
  /// @throws InvalidInput naming the spacing or a distance that is not finite
  [[nodiscard]] static SdfGrid from_function(const Distance& distance, const Aabb& box,
                                             double spacing);
  /// Of a closed mesh. @throws InvalidInput also when the mesh is open or turned inside out
  [[nodiscard]] static SdfGrid from_mesh(const MeshSurface& mesh, double spacing);

  [[nodiscard]] Aabb box() const {
    return {lower, lower + spacing * (count - Eigen::Vector3i::Ones()).cast<double>()};
  }
  /// Distance at p, and its gradient (not normalised). Outside the box: that of the nearest point
  /// in it plus the way there.
  [[nodiscard]] double sample(const Eigen::Vector3d& p, Eigen::Vector3d& gradient) const;
};

}  // namespace carom
