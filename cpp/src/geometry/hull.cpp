// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/hull.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include <Eigen/Geometry>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

struct Face {
  std::array<int, 3> v;
  Vector3d normal;
  double offset;
  std::vector<int> outside;  // points that see this face, assigned to one such face each
  bool alive = true;
};

std::uint64_t key(int a, int b) {
  return std::uint64_t(static_cast<std::uint32_t>(a)) << 32 | static_cast<std::uint32_t>(b);
}

struct Builder {
  const TriangleMesh::Vertices& points;
  double slack;
  std::vector<Face> faces{};
  std::unordered_map<std::uint64_t, int> owner{};  // directed edge: the face that runs along it

  Vector3d at(int i) const { return points.row(i).transpose(); }
  double height(const Face& f, int i) const { return f.normal.dot(at(i)) - f.offset; }

  int add(int a, int b, int c) {
    const Vector3d n = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    const int me = static_cast<int>(faces.size());
    // The highest of the three offsets: no corner of the face then counts as outside of it.
    faces.push_back({{a, b, c}, n, std::max({n.dot(at(a)), n.dot(at(b)), n.dot(at(c))}), {}});
    owner[key(a, b)] = owner[key(b, c)] = owner[key(c, a)] = me;
    return me;
  }
  /// Gives each point to the face it stands highest over.
  void assign(const std::vector<int>& candidates, const std::vector<int>& to) {
    for (int i : candidates) {
      int best = -1;
      double top = slack;
      for (int f : to)
        if (const double h = height(faces[f], i); h > top) top = h, best = f;
      if (best >= 0) faces[best].outside.push_back(i);
    }
  }
  void grow(int seed) {
    const int apex = *std::ranges::max_element(faces[seed].outside, {},
                                               [&](int i) { return height(faces[seed], i); });
    std::vector<int> seen{seed}, orphans, fresh;
    std::vector<std::pair<int, int>> border;
    faces[seed].alive = false;
    for (std::size_t k = 0; k < seen.size(); ++k)
      for (int e = 0; e < 3; ++e) {
        const int a = faces[seen[k]].v[e], b = faces[seen[k]].v[(e + 1) % 3];
        const int next = owner.at(key(b, a));
        if (!faces[next].alive) continue;
        if (height(faces[next], apex) > slack) {
          faces[next].alive = false;
          seen.push_back(next);
        }
      }
    for (int f : seen) {
      orphans.insert(orphans.end(), faces[f].outside.begin(), faces[f].outside.end());
      for (int e = 0; e < 3; ++e) {
        const int a = faces[f].v[e], b = faces[f].v[(e + 1) % 3];
        if (faces[owner.at(key(b, a))].alive) border.emplace_back(a, b);
      }
    }
    std::erase(orphans, apex);
    for (const auto& [a, b] : border) fresh.push_back(add(a, b, apex));
    assign(orphans, fresh);
    for (int f : seen) faces[f].outside.clear();
  }
};

/// Four points that span a volume: farthest apart, farthest from their line, from their plane.
std::array<int, 4> first_tetrahedron(const TriangleMesh::Vertices& points, double slack,
                                     std::string_view field) {
  const auto farthest = [&](const auto& score) {
    int best = 0;
    double top = -1;
    for (int i = 0; i < static_cast<int>(points.rows()); ++i)
      if (const double s = score(Vector3d(points.row(i).transpose())); s > top) top = s, best = i;
    return std::pair(best, top);
  };
  const auto refuse = [&](const char* what) {
    throw InvalidInput(field, std::to_string(points.rows()) + " points " + what,
                       "must span a volume", "give four points that do not lie in one plane");
  };
  const Vector3d first = points.row(0).transpose();
  const int a = farthest([&](const Vector3d& x) { return (x - first).norm(); }).first;
  const Vector3d pa = points.row(a).transpose();
  const auto [b, length] = farthest([&](const Vector3d& x) { return (x - pa).norm(); });
  if (!(length > 0)) refuse("in one place");
  const Vector3d along = (Vector3d(points.row(b).transpose()) - pa) / length;
  const auto [c, width] = farthest([&](const Vector3d& x) { return (x - pa).cross(along).norm(); });
  if (!(width > slack)) refuse("on one line");
  const Vector3d n = along.cross(Vector3d(points.row(c).transpose()) - pa).normalized();
  const auto [d, height] = farthest([&](const Vector3d& x) { return std::abs(n.dot(x - pa)); });
  if (!(height > slack)) refuse("in one plane");
  if (n.dot(Vector3d(points.row(d).transpose()) - pa) > 0) return {a, c, b, d};
  return {a, b, c, d};
}

}  // namespace

TriangleMesh convex_hull(const TriangleMesh::Vertices& points, std::string_view field) {
  if (points.rows() == 0) throw InvalidInput(field, "none", "must hold four points or more");
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (!points.row(i).allFinite())
      throw InvalidInput(std::string(field) + "[" + std::to_string(i) + "]",
                         with_unit(points.row(i), "m"), "must be finite");
  const double size = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  Builder builder{points, tolerance::hull_plane * size};
  const auto [a, b, c, d] = first_tetrahedron(points, builder.slack, field);
  builder.add(a, b, c);
  builder.add(a, d, b);
  builder.add(b, d, c);
  builder.add(c, d, a);
  std::vector<int> all(points.rows());
  for (int i = 0; i < static_cast<int>(all.size()); ++i) all[i] = i;
  builder.assign(all, {0, 1, 2, 3});
  for (std::size_t f = 0; f < builder.faces.size(); ++f)
    if (builder.faces[f].alive && !builder.faces[f].outside.empty())
      builder.grow(static_cast<int>(f));

  TriangleMesh mesh;
  std::vector<int> number(points.rows(), -1);
  std::vector<Eigen::RowVector3d> kept;
  std::vector<std::array<int, 3>> faces;
  for (const Face& f : builder.faces) {
    if (!f.alive) continue;
    std::array<int, 3> row;
    for (int k = 0; k < 3; ++k) {
      int& n = number[f.v[k]];
      if (n < 0) n = static_cast<int>(kept.size()), kept.push_back(points.row(f.v[k]));
      row[k] = n;
    }
    faces.push_back(row);
  }
  mesh.vertices.resize(static_cast<Eigen::Index>(kept.size()), 3);
  mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) mesh.vertices.row(i) = kept[i];
  for (std::size_t i = 0; i < faces.size(); ++i)
    mesh.faces.row(i) << faces[i][0], faces[i][1], faces[i][2];
  return mesh;
}

}  // namespace carom
