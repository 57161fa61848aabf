// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <random>

#include "carom/geometry/polytope.hpp"
#include "carom/narrow/contacts.hpp"
#include "carom/numerics/rotation.hpp"

namespace carom::testing {

inline Eigen::Vector3d random_vector(std::mt19937_64& random, double size = 1) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return {x, y, z};
}

inline Pose random_pose(std::mt19937_64& random, double size = 1) {
  Pose pose;
  pose.position = random_vector(random, size);
  pose.orientation = rotation_exponential(random_vector(random, 2.0));
  return pose;
}

/// Twelve triangles, each face split n x n times two: internal edges everywhere.
inline TriangleMesh box_mesh(const Eigen::Vector3d& extents, int n = 1) {
  const Polytope p = box_polytope(extents);
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> faces;
  const auto number = [&](const Eigen::Vector3d& x) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if ((vertices[i] - x).norm() < 1e-9) return static_cast<int>(i);
    vertices.push_back(x);
    return static_cast<int>(vertices.size()) - 1;
  };
  for (int f = 0; f < 6; ++f) {
    const auto loop = p.face(f);
    const Eigen::Vector3d o = p.vertices[loop[0]], u = (p.vertices[loop[1]] - o) / n,
                          v = (p.vertices[loop[3]] - o) / n;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = number(o + i * u + j * v), b = number(o + (i + 1) * u + j * v),
                  c = number(o + (i + 1) * u + (j + 1) * v), d = number(o + i * u + (j + 1) * v);
        faces.emplace_back(a, b, c);
        faces.emplace_back(a, c, d);
      }
  }
  TriangleMesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.vertices.row(i) = vertices[i].transpose();
  for (std::size_t i = 0; i < faces.size(); ++i) mesh.faces.row(i) = faces[i].transpose();
  return mesh;
}

/// Extrudes a polygon (x, y counter-clockwise, triangulated as a fan from corner `fan`) from z = 0
/// to z = height. The fan must lie inside the polygon.
inline TriangleMesh prism(const std::vector<Eigen::Vector2d>& polygon, double height, int fan) {
  const int n = static_cast<int>(polygon.size());
  TriangleMesh mesh;
  mesh.vertices.resize(2 * n, 3);
  mesh.faces.resize(4 * n - 4, 3);
  for (int i = 0; i < n; ++i) {
    mesh.vertices.row(i) << polygon[i].x(), polygon[i].y(), 0;
    mesh.vertices.row(n + i) << polygon[i].x(), polygon[i].y(), height;
  }
  int row = 0;
  for (int i = 1; i + 1 < n; ++i) {
    const int j = (fan + i) % n, k = (fan + i + 1) % n;
    mesh.faces.row(row++) << fan, k, j;
    mesh.faces.row(row++) << n + fan, n + j, n + k;
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.faces.row(row++) << i, j, n + j;
    mesh.faces.row(row++) << i, n + j, n + i;
  }
  return mesh;
}

/// Closed, not convex: a 2 x 2 x 1 m block without its quarter x > 0, y > 0.
inline TriangleMesh l_block() {
  return prism({{0, 0}, {0, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 0}}, 1, 0);
}

inline double deepest(const std::vector<Manifold>& all) {
  double least = std::numeric_limits<double>::infinity();
  for (const Manifold& m : all)
    for (int k = 0; k < m.count; ++k) least = std::min(least, m.points[k].separation);
  return least;
}

inline int point_count(const std::vector<Manifold>& all) {
  int count = 0;
  for (const Manifold& m : all) count += m.count;
  return count;
}

inline std::vector<Manifold> contacts(const Shape& a, const Pose& pose_a, const Shape& b,
                                      const Pose& pose_b, double margin) {
  std::vector<Manifold> out;
  collide(a, pose_a, b, pose_b, margin, out);
  return out;
}

}  // namespace carom::testing
