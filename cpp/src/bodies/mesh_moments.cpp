// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/mesh_moments.hpp"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "carom/bodies/principal_axes.hpp"
#include "carom/geometry/aabb.hpp"
#include "carom/numerics/compensated_sum.hpp"
#include "carom/numerics/double_double.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

/// A double of the same binade as the vertices, so that differences to it are exact far out.
Eigen::Vector3d local_origin(const TriangleMesh& mesh) {
  Aabb box;
  for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i)
    for (int k = 0; k < 3; ++k) box.extend(mesh.vertices.row(mesh.faces(i, k)).transpose());
  return 0.5 * box.lower + 0.5 * box.upper;
}

Eigen::Matrix3d symmetric(const std::array<double, 6>& e) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 6; ++i) m(pairs[i][0], pairs[i][1]) = m(pairs[i][1], pairs[i][0]) = e[i];
  return m;
}

MeshMoments in_double(const TriangleMesh& mesh, const Eigen::Vector3d& origin) {
  CompensatedSum six, first[3], second[6];
  double sizes = 0, sizes2 = 0;  // sums of the sizes of the terms, for the error bound
  for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
    Eigen::Matrix3d c;  // columns: corners from the origin
    for (int k = 0; k < 3; ++k) c.col(k) = mesh.vertices.row(mesh.faces(i, k)).transpose() - origin;
    const Eigen::Vector3d e1 =
        (mesh.vertices.row(mesh.faces(i, 1)) - mesh.vertices.row(mesh.faces(i, 0))).transpose();
    const Eigen::Vector3d e2 =
        (mesh.vertices.row(mesh.faces(i, 2)) - mesh.vertices.row(mesh.faces(i, 0))).transpose();
    const double d = c.col(0).dot(e1.cross(e2));
    const Eigen::Vector3d s = c.rowwise().sum();
    six += d;
    for (int k = 0; k < 3; ++k) first[k] += d * s[k];
    for (int e = 0; e < 6; ++e) {
      const int k = pairs[e][0], l = pairs[e][1];
      second[e] += d * (s[k] * s[l] + c.row(k).dot(c.row(l)));
    }
    const double size = c.col(0).norm() * e1.norm() * e2.norm();
    sizes += size;
    sizes2 += size * c.squaredNorm();
  }
  MeshMoments m;
  m.measure = six.value() / 6;
  const Eigen::Vector3d offset =
      Eigen::Vector3d(first[0].value(), first[1].value(), first[2].value()) / (4 * six.value());
  m.centroid = origin + offset;
  std::array<double, 6> entries;
  for (int e = 0; e < 6; ++e)
    entries[e] = second[e].value() / 120 - m.measure * offset[pairs[e][0]] * offset[pairs[e][1]];
  m.second = symmetric(entries);
  // Rounding of one d: 3 for the corners, 3 for the products, 2 for the sums, each u of `size`; its
  // factor s s + c c <= 4 |c|^2 adds 7 more; the shift to the centroid is a third term as large.
  constexpr double u = tolerance::unit_roundoff;
  m.measure_error = 8 * u * sizes / 6;
  const double error = 4 * (8 + 7) * u * sizes2 / 120 +
                       8 * (m.measure_error + u * std::abs(m.measure)) * offset.squaredNorm();
  const double smallest = principal_axes(inertia_of_second_moments(m.second)).moments[0];
  m.extended = !(error <= tolerance::mesh_integral * smallest);
  return m;
}

using Corner = std::array<DoubleDouble, 3>;

MeshMoments in_double_double(const TriangleMesh& mesh, const Eigen::Vector3d& origin) {
  DoubleDouble six;
  std::array<DoubleDouble, 3> first;
  std::array<DoubleDouble, 6> second;
  double sizes = 0;
  for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
    Corner c[3], s;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) {
        c[k][j] = exact_difference(mesh.vertices(mesh.faces(i, k), j), origin[j]);
        s[j] += c[k][j];
      }
    DoubleDouble d;
    double size = 0;
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      const DoubleDouble p = c[0][j] * (c[1][k] * c[2][l]), q = c[0][j] * (c[1][l] * c[2][k]);
      d += p - q;
      size += std::abs(p.hi) + std::abs(q.hi);
    }
    six += d;
    sizes += size;
    for (int k = 0; k < 3; ++k) first[k] += d * s[k];
    for (int e = 0; e < 6; ++e) {
      const int k = pairs[e][0], l = pairs[e][1];
      second[e] += d * (s[k] * s[l] + c[0][k] * c[0][l] + c[1][k] * c[1][l] + c[2][k] * c[2][l]);
    }
  }
  MeshMoments m;
  m.extended = true;
  m.measure = double(six) / 6;
  m.measure_error = tolerance::orientation_exact * sizes / 6;
  std::array<DoubleDouble, 3> offset;
  for (int k = 0; k < 3; ++k) {
    offset[k] = first[k] / (DoubleDouble(4) * six);
    m.centroid[k] = double(DoubleDouble(origin[k]) + offset[k]);
  }
  std::array<double, 6> entries;
  for (int e = 0; e < 6; ++e)
    entries[e] = double(second[e] / DoubleDouble(120) -
                        six / DoubleDouble(6) * offset[pairs[e][0]] * offset[pairs[e][1]]);
  m.second = symmetric(entries);
  return m;
}

}  // namespace

MeshMoments volume_moments(const TriangleMesh& mesh) {
  const Eigen::Vector3d origin = local_origin(mesh);
  MeshMoments m = in_double(mesh, origin);
  if (m.extended) m = in_double_double(mesh, origin);
  return m;
}

MeshMoments surface_moments(const TriangleMesh& mesh) {
  const auto visit = [&](const Eigen::Vector3d& from, const auto& add) {
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
      Eigen::Matrix3d c;
      for (int k = 0; k < 3; ++k) c.col(k) = mesh.vertices.row(mesh.faces(i, k)).transpose() - from;
      add(0.5 * (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).norm(), c);
    }
  };
  MeshMoments m;
  const Eigen::Vector3d origin = local_origin(mesh);
  CompensatedSum area, first[3], second[6];
  visit(origin, [&](double a, const Eigen::Matrix3d& c) {
    area += a;
    for (int k = 0; k < 3; ++k) first[k] += a * c.row(k).sum() / 3;
  });
  m.measure = area.value();
  if (!(m.measure > 0)) return m;
  const Eigen::Vector3d offset =
      Eigen::Vector3d(first[0].value(), first[1].value(), first[2].value()) / m.measure;
  m.centroid = origin + offset;
  // A second pass from the centroid: shifting afterwards would cancel.
  visit(origin, [&](double a, Eigen::Matrix3d c) {
    c.colwise() -= offset;
    const Eigen::Vector3d s = c.rowwise().sum();
    for (int e = 0; e < 6; ++e) {
      const int k = pairs[e][0], l = pairs[e][1];
      second[e] += a / 12 * (s[k] * s[l] + c.row(k).dot(c.row(l)));
    }
  });
  std::array<double, 6> entries;
  for (int e = 0; e < 6; ++e) entries[e] = second[e].value();
  m.second = symmetric(entries);
  return m;
}

}  // namespace carom
