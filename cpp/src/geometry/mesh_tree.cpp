// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/mesh_tree.hpp"

#include <algorithm>
#include <numeric>

namespace carom {
namespace {

constexpr int leaf_faces = 4;  // four boxes of faces cost about what two more nodes do

struct Builder {
  const TriangleMesh& mesh;
  std::vector<Eigen::Vector3d> centres;
  MeshTree& tree;

  Aabb bounds(int first, int last) const {
    Aabb box;
    for (int i = first; i < last; ++i)
      for (int k = 0; k < 3; ++k)
        box.extend(mesh.vertices.row(mesh.faces(tree.order[i], k)).transpose());
    return box;
  }

  // Halves by count along the widest spread of centres: depth stays log2 n whatever the mesh.
  void build(int first, int last) {
    const int me = static_cast<int>(tree.nodes.size());
    tree.nodes.push_back({bounds(first, last), 0, first, 0});
    if (last - first <= leaf_faces) {
      tree.nodes[me].count = last - first;
    } else {
      Aabb spread;
      for (int i = first; i < last; ++i) spread.extend(centres[tree.order[i]]);
      int axis;
      spread.extents().maxCoeff(&axis);
      const int middle = (first + last) / 2;
      std::nth_element(tree.order.begin() + first, tree.order.begin() + middle,
                       tree.order.begin() + last, [&](int a, int b) {
                         return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b);
                       });
      build(first, middle);
      build(middle, last);
    }
    tree.nodes[me].end = static_cast<int>(tree.nodes.size());
  }
};

}  // namespace

MeshTree::MeshTree(const TriangleMesh& mesh) {
  const int faces = static_cast<int>(mesh.faces.rows());
  order.resize(faces);
  std::iota(order.begin(), order.end(), 0);
  Builder builder{mesh, {}, *this};
  builder.centres.reserve(faces);
  for (int f = 0; f < faces; ++f)
    builder.centres.push_back((mesh.vertices.row(mesh.faces(f, 0)) +
                               mesh.vertices.row(mesh.faces(f, 1)) +
                               mesh.vertices.row(mesh.faces(f, 2))) /
                              3);
  if (faces > 0) builder.build(0, faces);
}

}  // namespace carom
