// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "carom/geometry/aabb.hpp"
#include "carom/geometry/mesh.hpp"

namespace carom {

/// Box tree over the faces of one mesh, in the mesh's frame; made once, shared by all its bodies.
///
/// Nodes lie in depth-first order: the left child follows its parent, and skipping a subtree is one
/// jump, so a query needs neither stack nor memory.
struct MeshTree {
  struct Node {
    Aabb box;
    int end;    ///< one past the last node of this subtree
    int first;  ///< of a leaf: its faces are order[first .. first + count)
    int count;  ///< 0 for an inner node
  };
  std::vector<Node> nodes;
  std::vector<int> order;

  MeshTree() = default;
  explicit MeshTree(const TriangleMesh& mesh);

  /// Calls visit(face) for each face of a leaf for which `meets(node box)` holds all the way down.
  template <class Meets, class Visit>
  void query(const Meets& meets, const Visit& visit) const {
    for (int i = 0, n = static_cast<int>(nodes.size()); i < n;) {
      const Node& node = nodes[i];
      if (!meets(node.box)) {
        i = node.end;
        continue;
      }
      for (int k = 0; k < node.count; ++k) visit(order[node.first + k]);
      ++i;
    }
  }
};

/// Squared distance from a point to a box, m^2; 0 inside.
[[nodiscard]] inline double squared_distance(const Aabb& box, const Eigen::Vector3d& p) {
  return (box.lower - p).cwiseMax(p - box.upper).cwiseMax(0).squaredNorm();
}

}  // namespace carom
