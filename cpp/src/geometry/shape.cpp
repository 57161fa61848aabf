// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/shape.hpp"

#include <string>

#include "carom/geometry/convex.hpp"
#include "carom/geometry/frame.hpp"
#include "carom/geometry/hull.hpp"
#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/sdf.hpp"
#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

struct Validate {
  std::string field;

  void operator()(const Sphere& s) const { require_positive(s.radius, field + ".radius", "m"); }
  void operator()(const Box& b) const {
    for (int i = 0; i < 3; ++i) require_positive(b.extents[i], field + ".extents", "m");
  }
  void operator()(const Plane& p) const {
    if (!p.normal.allFinite() || !(p.normal.norm() > 0))
      throw InvalidInput(field + ".normal", with_unit(p.normal.transpose(), ""),
                         "must be finite and not zero");
    require_finite(p.offset, field + ".offset", "m");
  }
  void operator()(const Mesh& m) const {
    if (!m.triangles) throw InvalidInput(field, "no triangles", "must hold a mesh");
    require_valid(*m.triangles, field);
  }
  void operator()(const Capsule& c) const {
    require_positive(c.radius, field + ".radius", "m");
    require_non_negative(c.length, field + ".length", "m");
  }
  void operator()(const Cylinder& c) const {
    require_positive(c.radius, field + ".radius", "m");
    require_positive(c.length, field + ".length", "m");
  }
  void operator()(const Cone& c) const {
    require_positive(c.radius, field + ".radius", "m");
    require_positive(c.length, field + ".length", "m");
  }
  void operator()(const Ellipsoid& e) const {
    for (int i = 0; i < 3; ++i) require_positive(e.radii[i], field + ".radii", "m");
  }
  void operator()(const ConvexHull& h) const {
    if (!h.surface) throw InvalidInput(field, "no points", "must hold a hull");
  }
  void operator()(const Sdf& s) const {
    if (!s.grid || !s.grid->surface) throw InvalidInput(field, "no grid", "must hold a grid");
  }
  void operator()(const HeightField& h) const {
    if (!h.surface) throw InvalidInput(field, "no heights", "must hold 2 x 2 heights or more");
  }
  void operator()(const ParticleSet& p) const {
    require_positive(p.radius, field + ".radius", "m");
    if (p.positions.rows() == 0) throw InvalidInput(field + ".positions", "none", "must hold one");
    if (!p.positions.allFinite())
      throw InvalidInput(field + ".positions", "not finite", "must be finite");
  }
  void operator()(const Compound& c) const {
    if (!c.parts || c.parts->empty()) throw InvalidInput(field + ".parts", "none", "must hold one");
    for (std::size_t i = 0; i < c.parts->size(); ++i) {
      const CompoundPart& part = (*c.parts)[i];
      const std::string at = field + ".parts[" + std::to_string(i) + "]";
      if (std::holds_alternative<Plane>(part.shape))
        throw InvalidInput(at, "plane", "must be bounded", "add the plane as a body of its own");
      require_valid(part.shape, at);
      if (!part.pose.position.allFinite())
        throw InvalidInput(at + ".position", with_unit(part.pose.position.transpose(), "m"),
                           "must be finite");
    }
  }
};

struct Bounds {
  const Pose& pose;

  Aabb operator()(const Sphere& s) const {
    return Aabb{pose.position, pose.position}.inflated(s.radius);
  }
  Aabb operator()(const Box& b) const {
    const Eigen::Vector3d half = 0.5 * (pose.orientation.toRotationMatrix().cwiseAbs() * b.extents);
    return {pose.position - half, pose.position + half};
  }
  Aabb operator()(const Plane& p) const {
    const double inf = std::numeric_limits<double>::infinity();
    Aabb box{Eigen::Vector3d::Constant(-inf), Eigen::Vector3d::Constant(inf)};
    const Eigen::Vector3d n = pose.orientation * p.normal.normalized();
    for (int i = 0; i < 3; ++i) {  // a normal along an axis bounds that axis on one side
      if (n[i] == 1) box.upper[i] = pose.position[i] + p.offset;
      if (n[i] == -1) box.lower[i] = pose.position[i] - p.offset;
    }
    return box;
  }
  Aabb operator()(const ConvexHull& h) const { return of_vertices(*h.triangles); }
  Aabb operator()(const HeightField& h) const { return of_vertices(h.surface->mesh); }
  Aabb operator()(const Sdf& s) const { return of_vertices(s.grid->surface->mesh); }
  Aabb operator()(const ParticleSet& p) const {
    const Frame frame(pose);
    Aabb box;
    for (Eigen::Index i = 0; i < p.positions.rows(); ++i)
      box.extend(frame * Eigen::Vector3d(p.positions.row(i).transpose()));
    return box.inflated(p.radius);
  }
  Aabb operator()(const Compound& c) const {
    Aabb box;
    for (const CompoundPart& part : *c.parts) {
      const Pose placed{pose * part.pose.position, pose.orientation * part.pose.orientation};
      const Aabb inner = bounds(part.shape, placed);
      box.extend(inner.lower);
      box.extend(inner.upper);
    }
    return box;
  }
  Aabb operator()(const auto& curved) const {  // six support points bound it exactly
    const Convex body = *convex_of(Shape(curved));
    const Frame frame(pose);
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d up = frame.rotation.row(i).transpose();
      box.lower[i] = (frame * body.support(-up))[i] - body.radius;
      box.upper[i] = (frame * body.support(up))[i] + body.radius;
    }
    return box;
  }
  Aabb operator()(const Mesh& m) const { return of_vertices(*m.triangles); }

  Aabb of_vertices(const TriangleMesh& mesh) const {
    const Eigen::Matrix3d R_wb = pose.orientation.toRotationMatrix();
    Aabb box;
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
      box.extend(R_wb * mesh.vertices.row(i).transpose() + pose.position);
    return box;
  }
};

struct Radius {
  double operator()(const Sphere& s) const { return s.radius; }
  double operator()(const Box& b) const { return 0.5 * b.extents.norm(); }
  double operator()(const Plane&) const { return std::numeric_limits<double>::infinity(); }
  double operator()(const Mesh& m) const { return of_rows(m.triangles->vertices); }
  double operator()(const ConvexHull& h) const { return of_rows(h.triangles->vertices); }
  double operator()(const HeightField& h) const { return of_rows(h.surface->mesh.vertices); }
  double operator()(const Sdf& s) const { return of_rows(s.grid->surface->mesh.vertices); }
  double operator()(const ParticleSet& p) const { return of_rows(p.positions) + p.radius; }
  double operator()(const Compound& c) const {
    double radius = 0;
    for (const CompoundPart& part : *c.parts)
      radius = std::max(radius, part.pose.position.norm() + bounding_radius(part.shape));
    return radius;
  }
  double operator()(const auto& curved) const {
    return convex_of(Shape(curved))->bounding_radius();
  }
  static double of_rows(const TriangleMesh::Vertices& rows) {
    return rows.rowwise().norm().maxCoeff();
  }
};

}  // namespace

Mesh::Mesh(TriangleMesh mesh) {
  try {
    require_valid(mesh, "mesh");
  } catch (const InvalidInput&) {
    triangles = std::make_shared<const TriangleMesh>(std::move(mesh));
    return;
  }
  auto made = std::make_shared<MeshSurface>(mesh);
  if (made->faults.open_edges > 0) {
    mesh.faces.col(1).swap(mesh.faces.col(2));
    made->back = std::make_shared<const MeshSurface>(mesh);
  }
  surface = made;
  triangles = std::shared_ptr<const TriangleMesh>(surface, &surface->mesh);  // one copy, two views
}

ConvexHull::ConvexHull(const TriangleMesh::Vertices& points) {
  auto made = std::make_shared<MeshSurface>(convex_hull(points, "ConvexHull.points"));
  if (!made->polytope) {  // faces so thin that neighbours cannot be told to be convex: take each
    Polytope p;
    p.first = {0};
    for (int v = 0; v < static_cast<int>(made->mesh.vertices.rows()); ++v)
      p.vertices.push_back(made->vertex(v));
    for (Eigen::Index f = 0; f < made->mesh.faces.rows(); ++f) {
      for (int k = 0; k < 3; ++k) p.corners.push_back(made->mesh.faces(f, k));
      p.first.push_back(static_cast<int>(p.corners.size()));
    }
    (void)finish(p);
    made->polytope = std::move(p);
  }
  surface = made;
  triangles = std::shared_ptr<const TriangleMesh>(surface, &surface->mesh);
}

HeightField::HeightField(Heights given, double cell) : heights(std::move(given)), spacing(cell) {
  require_positive(spacing, "HeightField.spacing", "m");
  const auto rows = heights.rows(), columns = heights.cols();
  if (rows < 2 || columns < 2)
    throw InvalidInput("HeightField.heights", with_unit(rows, "rows"), "must be 2 x 2 or more");
  if (!heights.allFinite())
    throw InvalidInput("HeightField.heights", "not finite", "must be finite");
  TriangleMesh mesh;
  mesh.vertices.resize(rows * columns, 3);
  mesh.faces.resize(2 * (rows - 1) * (columns - 1), 3);
  const auto number = [&](Eigen::Index i, Eigen::Index j) {
    return static_cast<int>(i * columns + j);
  };
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) {
      mesh.vertices.row(number(i, j)) << static_cast<double>(j) * spacing,
          static_cast<double>(i) * spacing, heights(i, j);
      if (i + 1 == rows || j + 1 == columns) continue;
      mesh.faces.row(row++) << number(i, j), number(i, j + 1), number(i + 1, j + 1);
      mesh.faces.row(row++) << number(i, j), number(i + 1, j + 1), number(i + 1, j);
    }
  surface = std::make_shared<const MeshSurface>(mesh);
}

Compound::Compound(std::vector<CompoundPart> given)
    : parts(std::make_shared<const std::vector<CompoundPart>>(std::move(given))) {}

std::string_view name_of(const Shape& shape) {
  constexpr std::string_view names[] = {
      "sphere",    "box",         "plane", "mesh",         "capsule",   "cylinder", "cone",
      "ellipsoid", "convex_hull", "sdf",   "height_field", "particles", "compound"};
  static_assert(std::size(names) == std::variant_size_v<Shape>);
  return names[shape.index()];
}

void require_valid(const Shape& shape, std::string_view field) {
  std::visit(Validate{std::string(field)}, shape);
}

Aabb bounds(const Shape& shape, const Pose& pose) {
  return std::visit(Bounds{pose}, shape);
}

double bounding_radius(const Shape& shape) {
  return std::visit(Radius{}, shape);
}

}  // namespace carom
