// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/geometry/mesh.hpp"

namespace carom {

/// Twelve outward faces on the corners of a box.
inline TriangleMesh box_mesh(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  TriangleMesh mesh;
  mesh.vertices.resize(8, 3);
  for (int i = 0; i < 8; ++i)
    mesh.vertices.row(i) << (i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
        (i & 4 ? upper : lower).z();
  mesh.faces.resize(12, 3);
  mesh.faces << 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0,
      3, 1, 4, 5, 7, 4, 7, 6;
  return mesh;
}

/// Both meshes in one.
inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both;
  both.vertices.resize(a.vertices.rows() + b.vertices.rows(), 3);
  both.vertices << a.vertices, b.vertices;
  both.faces.resize(a.faces.rows() + b.faces.rows(), 3);
  both.faces << a.faces, b.faces.array() + static_cast<int>(a.vertices.rows());
  return both;
}

inline TriangleMesh reversed(TriangleMesh mesh) {
  mesh.faces.col(1).swap(mesh.faces.col(2));
  return mesh;
}

}  // namespace carom
