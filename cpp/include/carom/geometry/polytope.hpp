// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

namespace carom {

/// Convex polyhedron with the neighbourhoods contact needs. Faces are convex polygons, coplanar
/// neighbours merged, corners counter-clockwise from outside.
struct Polytope {
  struct Edge {
    int v0, v1;  ///< as face f0 runs along it
    int f0, f1;
  };

  std::vector<Eigen::Vector3d> vertices;  ///< m
  std::vector<Eigen::Vector3d> normals;   ///< unit, outward, one per face
  std::vector<double> offsets;            ///< m: a face lies on normal . x = offset
  std::vector<int> first;                 ///< face f owns corners first[f] to first[f + 1]
  std::vector<int> corners;               ///< vertex at each corner
  std::vector<int> corner_edges;          ///< edge that starts at each corner
  std::vector<Edge> edges;

  [[nodiscard]] int face_count() const { return static_cast<int>(normals.size()); }
  [[nodiscard]] std::span<const int> face(int f) const {
    return std::span(corners).subspan(first[f], first[f + 1] - first[f]);
  }
};

/// Finishes a polytope from its vertices and face loops: normals, offsets, edges.
/// Returns false when the loops do not close up (each edge met once each way).
[[nodiscard]] bool finish(Polytope& polytope);

/// The polytope of a box centred at the origin. extents: m, full edge lengths.
[[nodiscard]] Polytope box_polytope(const Eigen::Vector3d& extents);

}  // namespace carom
