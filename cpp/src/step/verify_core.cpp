// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <vector>

#include "carom/geometry/convex.hpp"
#include "carom/geometry/frame.hpp"
#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/polytope.hpp"

#include "step/verify.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

struct Triangles {
  std::vector<Vector3d> vertices;
  std::vector<Eigen::Vector3i> faces;

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const int i = static_cast<int>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    faces.emplace_back(i, i + 1, i + 2);
  }
};

/// Of a convex body: the octahedron of its six farthest points, or the box it is.
void add_convex(const Shape& shape, const Convex& convex, const Frame& at, double scale,
                Triangles& out) {
  std::vector<Vector3d> corners;
  Vector3d middle = Vector3d::Zero();
  std::vector<std::array<int, 3>> faces;
  if (const auto* box = std::get_if<Box>(&shape)) {
    const Polytope p = box_polytope(box->extents);
    corners = p.vertices;
    for (int f = 0; f < p.face_count(); ++f) {
      const auto loop = p.face(f);
      faces.push_back({loop[0], loop[1], loop[2]});
      faces.push_back({loop[0], loop[2], loop[3]});
    }
  } else {
    for (int k = 0; k < 3; ++k)
      for (const double sign : {-1.0, 1.0}) {
        const Vector3d d = sign * Vector3d::Unit(k);
        corners.push_back(convex.support(d) + convex.radius * d);
        middle += corners.back() / 6;
      }
    for (const int x : {0, 1})
      for (const int y : {2, 3})
        for (const int z : {4, 5}) faces.push_back({x, y, z});
  }
  const auto placed = [&](int i) { return at * Vector3d(middle + scale * (corners[i] - middle)); };
  for (const auto& f : faces) out.add(placed(f[0]), placed(f[1]), placed(f[2]));
}

void add_shape(const Shape& shape, const Frame& in_body, const Frame& body, const Aabb& near,
               double scale, Triangles& out) {
  if (const auto* whole = std::get_if<Compound>(&shape)) {
    for (const CompoundPart& part : *whole->parts)
      add_shape(part.shape, in_body * Frame(part.pose), body, near, scale, out);
  } else if (const auto* balls = std::get_if<ParticleSet>(&shape)) {
    const Shape ball = Sphere{balls->radius};
    for (Eigen::Index i = 0; i < balls->positions.rows(); ++i)
      add_convex(ball, Convex::point(Vector3d::Zero(), balls->radius),
                 {in_body.rotation, in_body * Vector3d(balls->positions.row(i).transpose())}, scale,
                 out);
  } else if (const auto* plane = std::get_if<Plane>(&shape)) {
    // A square of the plane, as large as what comes near.
    const Vector3d n = plane->normal.normalized(), u = n.unitOrthogonal(), v = n.cross(u);
    const Frame frame = body * in_body;
    Vector3d foot = frame.to_local(near.centre());
    foot += (plane->offset - n.dot(foot)) * n;
    const double r = near.extents().norm();
    const auto corner = [&](double s, double t) {
      return in_body * (foot + s * r * u + t * r * v);
    };
    out.add(corner(-1, -1), corner(1, -1), corner(1, 1));
    out.add(corner(-1, -1), corner(1, 1), corner(-1, 1));
  } else if (const auto convex = convex_of(shape)) {
    add_convex(shape, *convex, in_body, scale, out);
  } else {
    const MeshSurface* s = nullptr;
    if (const auto* mesh = std::get_if<Mesh>(&shape)) s = mesh->surface.get();
    if (const auto* terrain = std::get_if<HeightField>(&shape)) s = terrain->surface.get();
    if (!s) return;
    const Frame frame = body * in_body;
    const Vector3d half = frame.rotation.transpose().cwiseAbs() * (0.5 * near.extents());
    const Vector3d centre = frame.to_local(near.centre());
    const Aabb region{centre - half, centre + half};
    s->tree.query([&](const Aabb& box) { return box.overlaps(region); },
                  [&](int f) {
                    out.add(in_body * s->corner(f, 0), in_body * s->corner(f, 1),
                            in_body * s->corner(f, 2));
                  });
  }
}

}  // namespace

SweptBody core_of(const World& world, int row, const Aabb& near) {
  const Scene::Body& body = world.scene.bodies[row];
  const bool moves = world.states.moves[row];
  Triangles all;
  // A moving surface is looked at whole: it may turn while it comes near.
  Aabb region = near;
  if (moves) region = Aabb{Vector3d::Constant(-1e300), Vector3d::Constant(1e300)};
  add_shape(body.shape, {}, Frame(world.states.pose(row)), region, moves ? 0.5 : 1.0, all);
  SweptBody core;
  core.mesh.vertices.resize(static_cast<Eigen::Index>(all.vertices.size()), 3);
  core.mesh.faces.resize(static_cast<Eigen::Index>(all.faces.size()), 3);
  for (std::size_t i = 0; i < all.vertices.size(); ++i)
    core.mesh.vertices.row(static_cast<Eigen::Index>(i)) =
        (all.vertices[i] - world.states.com_b[row]).transpose();
  for (std::size_t i = 0; i < all.faces.size(); ++i)
    core.mesh.faces.row(static_cast<Eigen::Index>(i)) = all.faces[i].transpose();
  core.edges = edges_of(core.mesh.faces);
  return core;
}

}  // namespace carom
