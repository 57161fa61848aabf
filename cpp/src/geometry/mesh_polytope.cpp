// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_polytope.hpp"

#include <algorithm>
#include <map>

namespace carom {
namespace {

using Bend = MeshSurface::Bend;

bool is_one_sphere(const MeshSurface& s) {
  if (s.faults.any() || !(s.volume > 0)) return false;
  std::vector<int> stack{s.mesh.faces(0, 0)};
  std::vector<std::uint8_t> seen(s.mesh.vertices.rows(), 0);
  seen[stack[0]] = 1;
  Eigen::Index reached = 0;
  while (!stack.empty()) {
    const int v = stack.back();
    stack.pop_back();
    ++reached;
    for (int k = s.vertex_first[v]; k < s.vertex_first[v + 1]; ++k) {
      const auto& e = s.edges[s.vertex_edges[k]];
      const int w = e.v0 == v ? e.v1 : e.v0;
      if (!seen[w]) seen[w] = 1, stack.push_back(w);
    }
  }
  const auto vertices = s.mesh.vertices.rows() - s.faults.unused_vertices;
  return reached == vertices &&
         vertices - static_cast<Eigen::Index>(s.edges.size()) + s.mesh.faces.rows() == 2;
}

}  // namespace

std::optional<Polytope> polytope_of(const MeshSurface& s) {
  if (!is_one_sphere(s)) return {};
  const auto concave = [](const MeshSurface::Edge& e) { return e.bend == Bend::concave; };
  if (std::ranges::any_of(s.edges, concave)) return {};

  const auto same_cluster = [&](const MeshSurface::Edge& e) {
    return s.face_cluster[e.f0] == s.face_cluster[e.f1];
  };
  // A vertex stays when three clusters or more meet at it.
  std::vector<int> borders(s.mesh.vertices.rows(), 0);
  for (const auto& e : s.edges)
    if (!same_cluster(e)) ++borders[e.v0], ++borders[e.v1];
  std::vector<int> number(s.mesh.vertices.rows(), -1);
  Polytope p;
  for (int v = 0; v < static_cast<int>(borders.size()); ++v)
    if (borders[v] >= 3) {
      number[v] = static_cast<int>(p.vertices.size());
      p.vertices.push_back(s.vertex(v));
    }

  std::map<int, std::map<int, int>> next;  // cluster, vertex: the vertex after it on the border
  for (const auto& e : s.edges) {
    if (same_cluster(e)) continue;
    next[s.face_cluster[e.f0]][e.v0] = e.v1;
    next[s.face_cluster[e.f1]][e.v1] = e.v0;
  }
  p.first = {0};
  for (const auto& [cluster, after] : next) {
    const int start = after.begin()->first;
    std::size_t walked = 0;
    int v = start;
    do {
      if (number[v] >= 0) p.corners.push_back(number[v]);
      const auto step = after.find(v);
      if (step == after.end() || ++walked > after.size()) return {};
      v = step->second;
    } while (v != start);
    if (walked != after.size()) return {};  // a border of two loops is no convex face
    p.first.push_back(static_cast<int>(p.corners.size()));
  }
  if (!finish(p)) return {};
  return p;
}

}  // namespace carom
