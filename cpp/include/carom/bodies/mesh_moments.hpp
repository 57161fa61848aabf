// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>

#include "carom/geometry/mesh.hpp"

namespace carom {

/// Integrals of 1, p and p p^T over a solid or a surface of density 1.
struct MeshMoments {
  double measure = 0.0;                                ///< m^3 or m^2
  double measure_error = 0.0;                          ///< bound on its rounding error
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< m
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();    ///< m^5 or m^4, about the centroid
  bool extended = false;                               ///< summed in double-double
};

/// The solid inside: signed tetrahedra from a point near the mesh, so a far origin costs no digits.
///
/// Plain doubles with a running error bound, 40 ns a face; where the bound leaves a moment less
/// sure than tolerance::mesh_integral (slivers, thin plates) all is summed again in double-double,
/// 500 ns. Faces must be wound outward; the measure of an inside-out mesh is negative. The mesh
/// must be valid. Source: lecture notes, "Computing Inertia Tensors"; B. Mirtich, J. Graphics Tools
/// 1(2), 1996.
[[nodiscard]] MeshMoments volume_moments(const TriangleMesh& mesh);

/// The faces themselves as a skin; winding does not matter. The mesh must be valid.
[[nodiscard]] MeshMoments surface_moments(const TriangleMesh& mesh);

}  // namespace carom
