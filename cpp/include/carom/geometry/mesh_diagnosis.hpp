// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "carom/geometry/mesh.hpp"

namespace carom {

/// What is odd about a triangle mesh as the boundary of a solid.
struct MeshDiagnosis {
  int components = 0;           ///< parts joined over edges
  long open_edges = 0;          ///< edges with a face on one side only
  long mixed_edges = 0;         ///< edges along which two faces run the same way
  long non_manifold_edges = 0;  ///< edges of four or more faces
  long duplicate_faces = 0;     ///< copies of a face, and pairs back to back
  long degenerate_faces = 0;    ///< faces that use a corner twice
  long crossings = 0;           ///< pairs of faces that pass through each other
  int inverted = 0;             ///< closed parts that were inside out
  int cavities = 0;             ///< closed parts that bound a hole in another
  int nested = 0;               ///< closed parts inside the solid of another: counted twice
  bool orientable = true;       ///< false for a surface with one side, as a Klein bottle
  double volume = 0.0;          ///< m^3, of the mended mesh; 0 while open or one-sided

  [[nodiscard]] bool closed() const { return open_edges == 0; }
  /// One sentence for each finding, with its number and what was done about it; empty for a sound
  /// mesh.
  [[nodiscard]] std::vector<std::string> findings() const;
};

/// A mesh with its faults taken out as far as that has one answer.
struct MendedMesh {
  TriangleMesh mesh;  ///< joined corners, no copies, wound outward; cavities inward
  MeshDiagnosis diagnosis;
};

/// Joins corners at one place, leaves out copies, turns faces that disagree with their part, and
/// turns parts that are inside out (a part that lies in another and was wound the other way is a
/// cavity and stays). Open and one-sided meshes come back with that said and their winding as is.
/// @throws InvalidInput when the mesh is not valid (see require_valid)
[[nodiscard]] MendedMesh mended(const TriangleMesh& mesh);

/// The findings alone.
[[nodiscard]] MeshDiagnosis diagnose(const TriangleMesh& mesh);

/// How often the surface winds about a point: 1 inside, 0 outside, by the solid angles of the
/// faces. Source: A. Van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30, 1983.
[[nodiscard]] double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& point);

}  // namespace carom
