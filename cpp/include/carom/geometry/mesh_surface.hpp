// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "carom/geometry/mesh.hpp"
#include "carom/geometry/mesh_tree.hpp"
#include "carom/geometry/polytope.hpp"

namespace carom {

/// What is wrong with a mesh, counted. None of it is refused for a static body; the policy:
/// a face without area, a duplicate of another face and an edge of more than two faces are left
/// out of neighbourhoods (the surface is kept); an open edge counts as convex on its one side, and
/// a mesh that has one is a sheet with two sides, see MeshSurface::back; an inverted closed mesh is
/// reported, not turned.
struct MeshFaults {
  int open_edges = 0;          ///< of one face only
  int non_manifold_edges = 0;  ///< of three faces and more, or of two that run the same way
  int degenerate_faces = 0;    ///< without area
  int duplicate_faces = 0;     ///< same three corners as an earlier face
  int unused_vertices = 0;
  bool inverted = false;  ///< closed, and its volume is negative: faces turned inward

  [[nodiscard]] bool closed() const { return open_edges == 0 && non_manifold_edges == 0; }
  [[nodiscard]] bool any() const {
    return !closed() || degenerate_faces || duplicate_faces || inverted;
  }
  /// One line for a person: "2 open edges, 1 face without area"; empty when sound.
  [[nodiscard]] std::string to_string() const;
};

/// Neighbourhoods and normals of a mesh, derived once: what contact needs to know of its edges.
struct MeshSurface {
  enum class Bend : std::uint8_t { flat, convex, concave };
  struct Edge {
    int v0, v1;
    int f0, f1;  ///< f1 = -1 on an open edge
    Bend bend;
    Eigen::Vector3d inward0, inward1;  ///< unit, in each face, perpendicular to the edge
    Eigen::Vector3d normal;            ///< unit, halfway between the two face normals
  };

  explicit MeshSurface(const TriangleMesh& mesh);

  TriangleMesh mesh;                            ///< a copy: the surface stands alone
  std::vector<Eigen::Vector3d> face_normals;    ///< unit; zero for a face without area
  std::vector<Eigen::Vector3d> vertex_normals;  ///< unit, weighted by angle; zero where none
  std::vector<std::array<int, 3>> face_edges;   ///< edge k of a face runs from corner k to k + 1
  std::vector<int> face_cluster;                ///< faces of one plane that hang together share it
  std::vector<Edge> edges;
  std::vector<int> vertex_first, vertex_edges;  ///< edges of vertex v: first[v] .. first[v + 1]
  std::vector<std::uint8_t> vertex_sharp;       ///< 1 where a vertex ends a convex edge
  MeshFaults faults;
  MeshTree tree;
  std::vector<int> plain;            ///< by node of the tree: the one cluster it is flat in, or -1
  double volume = 0;                 ///< m^3, signed; of no meaning when open
  std::optional<Polytope> polytope;  ///< when the mesh is convex
  /// An open mesh has no inside: a body is held on the side its centre lies on. From behind it
  /// meets this, the same faces turned over; null for closed meshes and height fields, which are
  /// solid.
  std::shared_ptr<const MeshSurface> back;

  [[nodiscard]] Eigen::Vector3d vertex(int v) const { return mesh.vertices.row(v).transpose(); }
  [[nodiscard]] Eigen::Vector3d corner(int f, int k) const { return vertex(mesh.faces(f, k)); }
};

struct SurfacePoint {
  int face = -1;                  ///< -1: nothing within reach
  double distance = 0;            ///< m, signed: negative inside
  Eigen::Vector3d point, normal;  ///< normal: unit, along which the distance grows
  std::uint32_t feature = 0;      ///< names face cluster, edge or vertex
};

/// Closest point of the surface to p (mesh frame) no farther than `reach` m, and on which side p
/// is.
///
/// The sign is that of the angle-weighted pseudonormal of the closest feature, right for closed
/// surfaces. Source: J. A. Baerentzen, H. Aanaes, IEEE TVCG 11(3), 2005.
[[nodiscard]] SurfacePoint closest_point(const MeshSurface& surface, const Eigen::Vector3d& p,
                                         double reach);

/// The side of a sheet that p (mesh frame) sees; none: it is farther than `reach` m away. In the
/// plane of a rim, where p sees neither: the front.
enum class Side : std::int8_t { none, front, behind };
[[nodiscard]] Side side_of(const MeshSurface& surface, const Eigen::Vector3d& p, double reach);

}  // namespace carom
