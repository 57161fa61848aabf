// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "carom/geometry/aabb.hpp"
#include "carom/geometry/mesh.hpp"

namespace carom {

/// Position and orientation of a body frame B in the world: x_w = orientation * x_b + position.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< unit, body to world

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point_b) const {
    return orientation * point_b + position;
  }
};

struct Sphere {
  double radius = 0.5;  ///< m
};

struct Box {
  Eigen::Vector3d extents = Eigen::Vector3d::Ones();  ///< m, full edge lengths
};

/// Half-space: the body is where normal . x <= offset, in its own frame. Static bodies only.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< any length > 0; used as a direction
  double offset = 0.0;                                ///< m, along the unit normal
};

struct MeshSurface;

/// Triangle mesh, shared: a thousand bodies of one mesh hold one copy. Moving bodies need a closed
/// one, solid inside; a static one may be open and is then a sheet without thickness: whatever its
/// winding, a body is held on the side its centre lies on (each part of a compound by its own).
struct Mesh {
  std::shared_ptr<const TriangleMesh> triangles;
  std::shared_ptr<const MeshSurface> surface;  ///< its neighbourhoods; none for an invalid mesh

  Mesh() = default;
  /// Derives the surface once. Never throws for a bad mesh: require_valid() says what is wrong.
  explicit Mesh(TriangleMesh mesh);
};

/// Segment along z of `length` (without the caps), grown by `radius`.
struct Capsule {
  double radius = 0.5;  ///< m
  double length = 1.0;  ///< m, >= 0
};

/// Solid cylinder along z about the origin.
struct Cylinder {
  double radius = 0.5;  ///< m
  double length = 1.0;  ///< m
};

/// Solid cone, apex towards +z; the origin is its centre of mass, a quarter of the length above the
/// base.
struct Cone {
  double radius = 0.5;  ///< m, of the base
  double length = 1.0;  ///< m, base to apex
};

/// Solid ellipsoid about the origin.
struct Ellipsoid {
  Eigen::Vector3d radii = Eigen::Vector3d::Constant(0.5);  ///< m, semi-axes
};

/// Convex hull of points, found once and shared. What the points do not span (all in a plane, or
/// fewer than four) is refused.
struct ConvexHull {
  std::shared_ptr<const TriangleMesh> triangles;  ///< of the hull
  std::shared_ptr<const MeshSurface> surface;

  ConvexHull() = default;
  /// @throws InvalidInput naming what is wrong with the points
  explicit ConvexHull(const TriangleMesh::Vertices& points);
};

struct SdfGrid;

/// Body given by the signed distance to its surface, sampled on a grid; see sdf.hpp.
struct Sdf {
  std::shared_ptr<const SdfGrid> grid;
};

/// Terrain: heights over a regular grid in x and y, two triangles a cell, solid below. Static only.
struct HeightField {
  using Heights = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Heights heights;     ///< m; row i lies at y = i * spacing, column j at x = j * spacing
  double spacing = 1;  ///< m
  std::shared_ptr<const MeshSurface> surface;

  HeightField() = default;
  /// @throws InvalidInput
  HeightField(Heights heights, double spacing);
};

/// Equal balls held together: the lecture's body of particles.
struct ParticleSet {
  TriangleMesh::Vertices positions;  ///< m, body frame
  double radius = 0.01;              ///< m, of each
};

struct CompoundPart;

/// Several shapes as one body. Parts may overlap; where they do, mass counts twice.
struct Compound {
  std::shared_ptr<const std::vector<CompoundPart>> parts;

  Compound() = default;
  explicit Compound(std::vector<CompoundPart> parts);
};

using Shape = std::variant<Sphere, Box, Plane, Mesh, Capsule, Cylinder, Cone, Ellipsoid, ConvexHull,
                           Sdf, HeightField, ParticleSet, Compound>;

struct CompoundPart {
  Shape shape;
  Pose pose;  ///< of the part in the body frame
};

/// "sphere", "box", "plane", "mesh", "capsule", "cylinder", "cone", "ellipsoid", "convex_hull",
/// "sdf", "height_field", "particles", "compound".
[[nodiscard]] std::string_view name_of(const Shape& shape);

/// @throws InvalidInput naming `field` and what is wrong with the shape (sizes, indices, not
/// finite)
void require_valid(const Shape& shape, std::string_view field);

/// Smallest axis-aligned box of the shape at a pose; infinite for a plane along the axes it fills.
[[nodiscard]] Aabb bounds(const Shape& shape, const Pose& pose);

/// Radius about the origin of the body frame that holds the whole shape, m; infinite for a plane.
[[nodiscard]] double bounding_radius(const Shape& shape);

}  // namespace carom
