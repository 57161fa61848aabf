// SPDX-License-Identifier: Apache-2.0
#include "geometry/sdf_surface.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Geometry>

#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

struct Marcher {
  const SdfGrid& grid;
  const std::vector<double>& samples;
  std::map<std::pair<std::int64_t, std::int64_t>, int> on_edge{};
  std::vector<Vector3d> vertices{};
  std::vector<std::array<int, 3>> faces{};

  std::int64_t number(const Vector3i& c) const {
    return c.x() + std::int64_t{grid.count.x()} * (c.y() + std::int64_t{grid.count.y()} * c.z());
  }
  // A sample exactly on the level counts as outside, so every vertex lies within an edge.
  double value(const Vector3i& c) const { return samples[number(c)]; }

  int vertex(const Vector3i& a, const Vector3i& b) {
    const std::pair<std::int64_t, std::int64_t> key = std::minmax({number(a), number(b)});
    const auto [it, fresh] = on_edge.try_emplace(key, static_cast<int>(vertices.size()));
    if (fresh) {
      const double va = value(a), vb = value(b), t = std::clamp(va / (va - vb), 0.02, 0.98);
      vertices.push_back(grid.lower +
                         grid.spacing * ((1 - t) * a.cast<double>() + t * b.cast<double>()));
    }
    return it->second;
  }
  void triangle(int a, int b, int c, const Vector3d& outward) {
    const Vector3d n = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
    if (n.dot(outward) < 0) std::swap(b, c);
    faces.push_back({a, b, c});
  }
  void tetrahedron(const std::array<Vector3i, 4>& t) {
    std::array<int, 4> in{}, out{};
    int inside = 0, outside = 0;
    for (int i = 0; i < 4; ++i) (value(t[i]) < 0 ? in[inside++] : out[outside++]) = i;
    if (inside == 0 || outside == 0) return;
    Vector3d mean_in = Vector3d::Zero(), mean_out = Vector3d::Zero();
    for (int i = 0; i < inside; ++i) mean_in += t[in[i]].cast<double>() / inside;
    for (int i = 0; i < outside; ++i) mean_out += t[out[i]].cast<double>() / outside;
    const Vector3d outward = mean_out - mean_in;
    const auto cut = [&](int i, int o) { return vertex(t[i], t[o]); };
    if (inside == 1)
      triangle(cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2]), outward);
    else if (inside == 3)
      triangle(cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0]), outward);
    else {
      const int a = cut(in[0], out[0]), b = cut(in[0], out[1]), c = cut(in[1], out[1]),
                d = cut(in[1], out[0]);
      triangle(a, b, c, outward);
      triangle(a, c, d, outward);
    }
  }
};

}  // namespace

std::shared_ptr<const MeshSurface> zero_level(const SdfGrid& grid,
                                              const std::vector<double>& samples) {
  // The six orders in which three unit steps lead across a cell: Kuhn's subdivision.
  constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  Marcher m{grid, samples};
  for (int k = 0; k + 1 < grid.count.z(); ++k)
    for (int j = 0; j + 1 < grid.count.y(); ++j)
      for (int i = 0; i + 1 < grid.count.x(); ++i)
        for (const auto& order : orders) {
          std::array<Vector3i, 4> t;
          t[0] = {i, j, k};
          for (int s = 0; s < 3; ++s) t[s + 1] = t[s] + Vector3i::Unit(order[s]);
          m.tetrahedron(t);
        }
  if (m.faces.empty())
    throw InvalidInput("Sdf.distance", "of one sign", "must cross zero", "enclose the surface");
  TriangleMesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(m.vertices.size()), 3);
  mesh.faces.resize(static_cast<Eigen::Index>(m.faces.size()), 3);
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    Vector3d p = m.vertices[v], g;
    for (int step = 0; step < 3; ++step) {  // Newton: the distance is its own step, errors square
      const double d = grid.sample(p, g);
      if (!(g.squaredNorm() > 0.25)) break;  // a crease: where the gradient fails stay on the edge
      const Vector3d move = d / g.squaredNorm() * g;
      if (!(move.norm() < grid.spacing)) break;
      p -= move;
    }
    mesh.vertices.row(v) = p.transpose();
  }
  for (std::size_t f = 0; f < m.faces.size(); ++f)
    mesh.faces.row(f) << m.faces[f][0], m.faces[f][1], m.faces[f][2];
  return std::make_shared<const MeshSurface>(mesh);
}

}  // namespace carom
