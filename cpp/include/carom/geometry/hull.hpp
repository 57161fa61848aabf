// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string_view>

#include <Eigen/Core>

#include "carom/geometry/mesh.hpp"

namespace carom {

/// Convex hull of points as a closed mesh, faces outward, only the corners of the hull kept.
///
/// Points within tolerance::hull_plane of the size of a face of the hull count as on it, so
/// duplicates, collinear and coplanar points are no trouble.
/// @throws InvalidInput when a coordinate is not finite or the points do not span a volume
/// Source: C. Barber, D. Dobkin, H. Huhdanpaa, The Quickhull Algorithm, ACM TOMS 22(4), 1996.
[[nodiscard]] TriangleMesh convex_hull(const TriangleMesh::Vertices& points,
                                       std::string_view field = "points");

}  // namespace carom
