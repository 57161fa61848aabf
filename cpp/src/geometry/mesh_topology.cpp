// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/mesh_topology.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace carom {
namespace {

/// First index of the vertices at the same place; -0 and 0 are one place.
std::vector<int> joined_vertices(const TriangleMesh::Vertices& v) {
  std::vector<int> order(v.rows()), first(v.rows());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) { return std::tuple(v(i, 0), v(i, 1), v(i, 2)); };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::tuple_cat(place(a), std::tuple(a)) < std::tuple_cat(place(b), std::tuple(b));
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] =
        i > 0 && place(order[i]) == place(order[i - 1]) ? first[order[i - 1]] : order[i];
  return first;
}

struct Key {
  std::array<int, 3> corners;  // ascending
  bool odd;                    // winding against the ascending order
  Eigen::Index face;
};

/// Marks copies: of faces on the same three corners one is kept when all run the same way, and none
/// when some run back to back (they cancel).
std::vector<char> duplicates(const TriangleMesh::Faces& faces) {
  std::vector<Key> keys(faces.rows());
  for (Eigen::Index i = 0; i < faces.rows(); ++i) {
    std::array<int, 3> c{faces(i, 0), faces(i, 1), faces(i, 2)};
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    const bool odd = c[1] > c[2];
    if (odd) std::swap(c[1], c[2]);
    keys[i] = {c, odd, i};
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.corners, a.face) < std::tie(b.corners, b.face);
  });
  std::vector<char> left_out(faces.rows(), 0);
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t j = i;
    bool same = true;
    for (; j < keys.size() && keys[j].corners == keys[i].corners; ++j)
      same = same && keys[j].odd == keys[i].odd;
    if (j - i > 1)
      for (std::size_t k = i + (same ? 1 : 0); k < j; ++k) left_out[keys[k].face] = 1;
    i = j;
  }
  return left_out;
}

struct HalfEdge {
  int a, b;  // a < b
  int face;
  bool forward;
};

struct Neighbour {
  int face;
  bool agrees;
};

std::vector<HalfEdge> sorted_edges(const TriangleMesh::Faces& faces) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * faces.rows());
  for (int i = 0; i < faces.rows(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int a = faces(i, k), b = faces(i, (k + 1) % 3);
      edges.push_back({std::min(a, b), std::max(a, b), i, a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::tie(x.a, x.b, x.face) < std::tie(y.a, y.b, y.face);
  });
  return edges;
}

/// Walks each part from face to face over edges of two faces and says which faces must turn.
void orient(const std::vector<std::array<Neighbour, 3>>& around, const std::vector<int>& degree,
            MeshTopology& t) {
  const int n = static_cast<int>(around.size());
  t.component.assign(n, -1);
  t.turned.assign(n, 0);
  std::vector<int> queue;
  for (int seed = 0; seed < n; ++seed) {
    if (t.component[seed] >= 0) continue;
    queue.assign(1, seed);
    t.component[seed] = t.components;
    long turned = 0;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const int f = queue[head];
      turned += t.turned[f];
      for (int k = 0; k < degree[f]; ++k) {
        const Neighbour& next = around[f][k];
        const char want = next.agrees ? t.turned[f] : char(1 - t.turned[f]);
        if (t.component[next.face] < 0) {
          t.component[next.face] = t.components;
          t.turned[next.face] = want;
          queue.push_back(next.face);
        } else if (t.turned[next.face] != want) {
          t.orientable = false;
        }
      }
    }
    const long size = std::ssize(queue);
    t.mixed.push_back(turned > 0);
    if (2 * turned > size)  // the many are right, the few are turned
      for (const int f : queue) t.turned[f] = char(1 - t.turned[f]);
    ++t.components;
  }
}

}  // namespace

MeshTopology mesh_topology(const TriangleMesh& mesh) {
  MeshTopology t;
  const std::vector<int> joined = joined_vertices(mesh.vertices);
  TriangleMesh::Faces faces = mesh.faces.unaryExpr([&](int v) { return joined[v]; });
  const std::vector<char> copy = duplicates(faces);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < faces.rows(); ++i) {
    const bool flat =
        faces(i, 0) == faces(i, 1) || faces(i, 1) == faces(i, 2) || faces(i, 2) == faces(i, 0);
    if (flat)
      ++t.degenerate_faces;
    else if (copy[i])
      ++t.duplicate_faces;
    else
      faces.row(kept++) = faces.row(i).eval();
  }
  t.faces = faces.topRows(kept);

  const std::vector<HalfEdge> edges = sorted_edges(t.faces);
  std::vector<std::array<Neighbour, 3>> around(kept);
  std::vector<int> degree(kept, 0);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j].a == edges[i].a && edges[j].b == edges[i].b) ++j;
    if ((j - i) % 2 == 1) {
      ++t.open_edges;
    } else if (j - i > 2) {
      ++t.non_manifold_edges;
    } else {
      const HalfEdge &x = edges[i], &y = edges[i + 1];
      const bool agrees = x.forward != y.forward;
      t.mixed_edges += !agrees;
      around[x.face][degree[x.face]++] = {y.face, agrees};
      around[y.face][degree[y.face]++] = {x.face, agrees};
    }
    i = j;
  }
  orient(around, degree, t);
  return t;
}

}  // namespace carom
