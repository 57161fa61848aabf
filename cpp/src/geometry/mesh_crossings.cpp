// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/mesh_crossings.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "carom/geometry/aabb.hpp"
#include "carom/geometry/orientation.hpp"

namespace carom {
namespace {

struct Node {
  Aabb box;
  int begin, end;             // of the order
  int left = -1, right = -1;  // -1: leaf
};

/// The faces in a tree of boxes, split at the median of the longest axis. broad/ has the fast one;
/// this layer lies below it and asks one question once per mesh.
struct BoxTree {
  static constexpr int leaf_size = 4;
  std::vector<Aabb> boxes;
  std::vector<Eigen::Vector3d> centres;
  std::vector<int> order;
  std::vector<Node> nodes;

  int build(int begin, int end) {
    const int index = static_cast<int>(nodes.size());
    nodes.push_back({{}, begin, end});
    Aabb box, spread;
    for (int i = begin; i < end; ++i) {
      box.lower = box.lower.cwiseMin(boxes[order[i]].lower);
      box.upper = box.upper.cwiseMax(boxes[order[i]].upper);
      spread.extend(centres[order[i]]);
    }
    nodes[index].box = box;
    if (end - begin <= leaf_size) return index;
    Eigen::Index axis = 0;
    spread.extents().maxCoeff(&axis);
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                     [&](int a, int b) { return centres[a][axis] < centres[b][axis]; });
    const int left = build(begin, middle), right = build(middle, end);
    nodes[index].left = left;
    nodes[index].right = right;
    return index;
  }
};

struct Ridge {
  int a, b;  // corners, a < b
  int face;
};

std::vector<Ridge> sorted_ridges(const TriangleMesh::Faces& faces) {
  std::vector<Ridge> ridges;
  for (int i = 0; i < faces.rows(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int a = faces(i, k), b = faces(i, (k + 1) % 3);
      ridges.push_back({std::min(a, b), std::max(a, b), i});
    }
  std::sort(ridges.begin(), ridges.end(), [](const Ridge& x, const Ridge& y) {
    return std::tie(x.a, x.b, x.face) < std::tie(y.a, y.b, y.face);
  });
  return ridges;
}

struct Finder {
  const TriangleMesh::Vertices& vertices;
  const TriangleMesh::Faces& faces;
  BoxTree tree;
  std::vector<std::pair<int, int>> found{};
  std::vector<Ridge> ridges{};  // made when first needed: few meshes touch exactly

  [[nodiscard]] Eigen::Vector3d corner(int face, int k) const {
    return vertices.row(faces(face, k % 3)).transpose();
  }

  /// Whether p q, which goes exactly through edge k of g, changes sides there. An edge of one face
  /// is a rim, and one of more than two has no two sides: both are touched only.
  [[nodiscard]] bool passes_ridge(const Eigen::Vector3d& p, const Eigen::Vector3d& q, int g,
                                  int k) {
    if (ridges.empty()) ridges = sorted_ridges(faces);
    const int a = faces(g, k), b = faces(g, (k + 1) % 3);
    const auto [from, to] = std::equal_range(
        ridges.begin(), ridges.end(), Ridge{std::min(a, b), std::max(a, b), 0},
        [](const Ridge& x, const Ridge& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    if (to - from != 2) return false;
    const int other = from->face == g ? (from + 1)->face : from->face;
    int apex = 0;
    while (faces(other, apex) == a || faces(other, apex) == b) ++apex;
    return crosses_ridge(p, q, corner(g, k), corner(g, k + 1), corner(g, k + 2),
                         corner(other, apex));
  }

  /// Whether an edge of f that shares no corner with g passes through g.
  [[nodiscard]] bool passes(int f, int g) {
    for (int k = 0; k < 3; ++k) {
      const int a = faces(f, k), b = faces(f, (k + 1) % 3);
      if ((faces.row(g).array() == a).any() || (faces.row(g).array() == b).any()) continue;
      const Eigen::Vector3d p = corner(f, k), q = corner(f, k + 1);
      const Passage where = passage(p, q, corner(g, 0), corner(g, 1), corner(g, 2));
      if (where == Passage::inside || (where == Passage::ab && passes_ridge(p, q, g, 0)) ||
          (where == Passage::bc && passes_ridge(p, q, g, 1)) ||
          (where == Passage::ca && passes_ridge(p, q, g, 2)))
        return true;
    }
    return false;
  }

  void test(int f, int g) {
    if (!tree.boxes[f].overlaps(tree.boxes[g])) return;
    if (passes(f, g) || passes(g, f)) found.emplace_back(std::min(f, g), std::max(f, g));
  }

  void between(int a, int b) {
    const Node &x = tree.nodes[a], &y = tree.nodes[b];
    if (a != b && !x.box.overlaps(y.box)) return;
    if (x.left < 0 && y.left < 0) {
      for (int i = x.begin; i < x.end; ++i)
        for (int j = a == b ? i + 1 : y.begin; j < y.end; ++j) test(tree.order[i], tree.order[j]);
    } else if (a == b) {
      between(x.left, x.left);
      between(x.left, x.right);
      between(x.right, x.right);
    } else if (y.left < 0 || (x.left >= 0 && x.end - x.begin >= y.end - y.begin)) {
      between(x.left, b);
      between(x.right, b);
    } else {
      between(a, y.left);
      between(a, y.right);
    }
  }
};

}  // namespace

std::vector<std::pair<int, int>> mesh_crossings(const TriangleMesh::Vertices& vertices,
                                                const TriangleMesh::Faces& faces) {
  const int n = static_cast<int>(faces.rows());
  if (n < 2) return {};
  Finder finder{vertices, faces, {}};
  finder.tree.order.resize(n);
  std::iota(finder.tree.order.begin(), finder.tree.order.end(), 0);
  for (int i = 0; i < n; ++i) {
    Aabb box;
    for (int k = 0; k < 3; ++k) box.extend(finder.corner(i, k));
    finder.tree.boxes.push_back(box);
    finder.tree.centres.push_back(box.centre());
  }
  finder.tree.build(0, n);
  finder.between(0, 0);
  std::sort(finder.found.begin(), finder.found.end());
  return std::move(finder.found);
}

}  // namespace carom
