// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "carom/broad/all_faces.hpp"

namespace carom::testing {

struct Random {
  std::mt19937_64 engine;
  explicit Random(unsigned seed) : engine(seed) {}
  double uniform(double a, double b) {
    return a + (b - a) * std::uniform_real_distribution<double>()(engine);
  }
  Eigen::RowVector3d point(double a, double b) {
    return {uniform(a, b), uniform(a, b), uniform(a, b)};
  }
};

/// Triangles of edge about `size` anywhere in a cube.
inline TriangleMesh soup(int faces, double side, double size, Random& random) {
  TriangleMesh mesh;
  mesh.vertices.resize(3 * faces, 3);
  mesh.faces.resize(faces, 3);
  for (int f = 0; f < faces; ++f) {
    const Eigen::RowVector3d at = random.point(0, side);
    for (int v = 0; v < 3; ++v) {
      mesh.vertices.row(3 * f + v) = at + random.point(-size, size);
      mesh.faces(f, v) = 3 * f + v;
    }
  }
  return mesh;
}

/// A closed, bumpy sphere of 2 n (n - 1) faces and no gap.
inline TriangleMesh bumpy_sphere(int n, double bump) {
  TriangleMesh mesh;
  mesh.vertices.resize(n * (n - 1) + 2, 3);
  mesh.faces.resize(2 * n * (n - 1), 3);
  const auto at = [&](int ring, int k) { return 2 + (ring - 1) * n + (k % n); };
  const auto place = [&](double theta, double phi) {
    const double r = 1 + bump * std::sin(3 * phi) * std::sin(4 * theta);
    return Eigen::RowVector3d(r * std::sin(theta) * std::cos(phi),
                              r * std::sin(theta) * std::sin(phi), r * std::cos(theta));
  };
  mesh.vertices.row(0) = place(0, 0);
  mesh.vertices.row(1) = place(M_PI, 0);
  int f = 0;
  for (int ring = 1; ring < n; ++ring)
    for (int k = 0; k < n; ++k) {
      mesh.vertices.row(at(ring, k)) = place(M_PI * ring / n, 2 * M_PI * k / n);
      if (ring == 1) mesh.faces.row(f++) << 0, at(1, k), at(1, k + 1);
      if (ring == n - 1) mesh.faces.row(f++) << 1, at(ring, k + 1), at(ring, k);
      if (ring + 1 < n) {
        mesh.faces.row(f++) << at(ring, k), at(ring + 1, k), at(ring + 1, k + 1);
        mesh.faces.row(f++) << at(ring, k), at(ring + 1, k + 1), at(ring, k + 1);
      }
    }
  return mesh;
}

struct Queries {
  TriangleMesh::Vertices starts, ends, lower, upper;

  /// In and about the box of the mesh: through space, between points of the surface (which end on
  /// faces, edges and corners), along axes, in planes of vertices.
  Queries(const TriangleMesh& mesh, int count, Random& random) {
    for (TriangleMesh::Vertices* v : {&starts, &ends, &lower, &upper}) v->resize(count, 3);
    Eigen::RowVector3d low = Eigen::RowVector3d::Zero(), high = Eigen::RowVector3d::Ones();
    if (mesh.vertices.rows() > 0) {
      low = mesh.vertices.colwise().minCoeff();
      high = mesh.vertices.colwise().maxCoeff();
    }
    const Eigen::RowVector3d size = (high - low).array() + 1e-9;
    const auto anywhere = [&] {
      return Eigen::RowVector3d(low + random.point(-0.2, 1.2).cwiseProduct(size));
    };
    const auto vertex = [&]() -> Eigen::RowVector3d {
      if (mesh.vertices.rows() == 0) return anywhere();
      return mesh.vertices.row(
          static_cast<int>(random.uniform(0, static_cast<double>(mesh.vertices.rows()))));
    };
    for (int i = 0; i < count; ++i) {
      starts.row(i) = i % 5 == 1 ? vertex() : anywhere();
      ends.row(i) = i % 5 <= 2 ? vertex() : anywhere();
      if (i % 7 == 0) ends.row(i) = (starts.row(i) + ends.row(i)) / 2;
      if (i % 11 == 0) {
        ends.row(i) = starts.row(i);
        ends(i, i % 3) += size[i % 3];
      }
      if (i % 13 == 0) starts(i, 2) = ends(i, 2) = vertex()[2];
      const Eigen::RowVector3d a = anywhere();
      const Eigen::RowVector3d b =
          i % 3 == 0 ? vertex() : a + random.point(0, 0.2).cwiseProduct(size);
      lower.row(i) = a.cwiseMin(b);
      upper.row(i) = a.cwiseMax(b);
    }
  }
};

inline void expect_same(const MeshIndex& index, const MeshIndex& truth, const Queries& q,
                        const char* what) {
  SCOPED_TRACE(what);
  constexpr double far = std::numeric_limits<double>::infinity();
  int wrong = 0;
  const auto a = index.segments(q.starts, q.ends), b = truth.segments(q.starts, q.ends);
  for (std::size_t i = 0; i < a.size(); ++i)
    wrong += a[i].face != b[i].face || a[i].fraction != b[i].fraction;
  EXPECT_EQ(wrong, 0) << "segments";
  EXPECT_EQ(index.blocked(q.starts, q.ends), truth.blocked(q.starts, q.ends));
  TriangleMesh::Vertices away = q.ends - q.starts;
  for (Eigen::Index i = 0; i < away.rows(); ++i)
    if (away.row(i).isZero(0)) away.row(i) << 1, 0, 0;
  for (const double reach : {far, 0.4}) {
    const auto c = index.raycast(q.starts, away, reach), d = truth.raycast(q.starts, away, reach);
    wrong = 0;
    for (std::size_t i = 0; i < c.size(); ++i)
      wrong += c[i].face != d[i].face || c[i].distance != d[i].distance;
    EXPECT_EQ(wrong, 0) << "rays of " << reach;
    EXPECT_EQ(index.any_hit(q.starts, away, reach), truth.any_hit(q.starts, away, reach));
  }
  const Overlaps e = index.overlaps(q.lower, q.upper), f = truth.overlaps(q.lower, q.upper);
  EXPECT_EQ(e.offsets, f.offsets);
  EXPECT_EQ(e.faces, f.faces);
  const auto g = index.closest(q.starts), h = truth.closest(q.starts);
  wrong = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    wrong += g[i].face != h[i].face || g[i].distance != h[i].distance ||
             (g[i].face >= 0 && g[i].point != h[i].point);
  EXPECT_EQ(wrong, 0) << "closest";
  EXPECT_EQ(index.self_pairs(), truth.self_pairs());
}

}  // namespace carom::testing
