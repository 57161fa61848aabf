// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "carom/geometry/mesh.hpp"

namespace carom {

/// How the faces of a mesh hang together. Vertices at exactly one place count as one, so a soup of
/// triangles, as STL files hold them, is joined first.
struct MeshTopology {
  TriangleMesh::Faces faces;   ///< kept faces on joined vertices (indices into the mesh)
  std::vector<int> component;  ///< of each kept face, 0 .. components - 1, joined over edges
  std::vector<char> turned;    ///< 1 where a face must be turned to agree with most of its part
  std::vector<char> mixed;     ///< of each component: 1 where its faces disagreed
  int components = 0;
  long open_edges = 0;          ///< an edge of one face, or of an odd number of faces
  long mixed_edges = 0;         ///< two faces run the same way along it
  long non_manifold_edges = 0;  ///< an edge of four or more faces
  long duplicate_faces = 0;     ///< left out: copies of a face, and pairs back to back
  long degenerate_faces = 0;    ///< left out: a corner used twice
  bool orientable = true;       ///< false for a surface with one side
};

/// The mesh must be valid (see require_valid). Cost: one sort of the edges.
[[nodiscard]] MeshTopology mesh_topology(const TriangleMesh& mesh);

}  // namespace carom
