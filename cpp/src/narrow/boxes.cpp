// SPDX-License-Identifier: Apache-2.0
#include "narrow/boxes.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

Vector3d corner(const Vector3d& half, int i) {
  return {i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(), i & 4 ? half.z() : -half.z()};
}

MeshSurface two_metre_cube() {
  const Polytope p = box_polytope({2, 2, 2});
  TriangleMesh mesh;
  mesh.vertices.resize(8, 3);
  mesh.faces.resize(12, 3);
  for (int i = 0; i < 8; ++i) mesh.vertices.row(i) = p.vertices[i].transpose();
  for (int f = 0; f < 6; ++f)
    for (int k = 0; k < 2; ++k)
      mesh.faces.row(2 * f + k) << p.face(f)[0], p.face(f)[k + 1], p.face(f)[k + 2];
  return MeshSurface(mesh);
}

}  // namespace

const Polytope& scratch_polytope(const Box& box, int slot) {
  thread_local Polytope scratch[2] = {box_polytope({2, 2, 2}), box_polytope({2, 2, 2})};
  Polytope& p = scratch[slot];
  const Vector3d half = 0.5 * box.extents;
  for (int i = 0; i < 8; ++i) p.vertices[i] = corner(half, i);
  for (int f = 0; f < 6; ++f) p.offsets[f] = half[f / 2];
  return p;
}

const MeshSurface& scratch_surface(const Box& box) {
  // A cube stretched along its axes keeps its normals, bends and, but for scale, its tree.
  thread_local const MeshSurface cube = two_metre_cube();
  thread_local MeshSurface scratch = cube;
  const Vector3d half = 0.5 * box.extents;
  for (int i = 0; i < 8; ++i) scratch.mesh.vertices.row(i) = corner(half, i).transpose();
  for (std::size_t i = 0; i < scratch.polytope->vertices.size(); ++i)
    scratch.polytope->vertices[i] = cube.polytope->vertices[i].cwiseProduct(half);
  for (std::size_t f = 0; f < scratch.polytope->offsets.size(); ++f)
    scratch.polytope->offsets[f] = scratch.polytope->normals[f].cwiseAbs().dot(half);
  for (std::size_t i = 0; i < cube.tree.nodes.size(); ++i) {
    scratch.tree.nodes[i].box.lower = cube.tree.nodes[i].box.lower.cwiseProduct(half);
    scratch.tree.nodes[i].box.upper = cube.tree.nodes[i].box.upper.cwiseProduct(half);
  }
  return scratch;
}

}  // namespace carom
