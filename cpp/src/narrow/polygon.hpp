// SPDX-License-Identifier: Apache-2.0
// The polygon of corner differences (see exact_contact.cpp) in doubles, at one instant.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom::narrow {

template <int Corners>
using Polygon = std::array<Eigen::Vector3d, static_cast<std::size_t>(Corners)>;

/// Corner differences of a query at its start (end = 0) or end (1); each component is one rounding.
template <int Corners>
[[nodiscard]] Polygon<Corners> corner_differences(const double* query, int end) {
  Eigen::Vector3d x[4];
  for (int j = 0; j < 4; ++j) x[j] = Eigen::Map<const Eigen::Vector3d>(query + 12 * end + 3 * j);
  if constexpr (Corners == 3)
    return {x[1] - x[0], x[2] - x[0], x[3] - x[0]};
  else
    return {x[0] - x[2], x[1] - x[2], x[1] - x[3], x[0] - x[3]};
}

template <int Corners>
[[nodiscard]] Polygon<Corners> interpolated(const Polygon<Corners>& a, const Polygon<Corners>& b,
                                            double t) {
  Polygon<Corners> r;
  for (int i = 0; i < Corners; ++i) r[i] = (1 - t) * a[i] + t * b[i];
  return r;
}

/// The point of the polygon nearest to the origin: the best of all edges and the face, so that a
/// degenerate polygon needs no branch of its own.
template <int Corners>
[[nodiscard]] Eigen::Vector3d nearest_to_origin(const Polygon<Corners>& v) {
  Eigen::Vector3d best = v[0];
  double least = best.squaredNorm();
  const auto offer = [&](const Eigen::Vector3d& p) {
    const double d = p.squaredNorm();
    if (d < least) {
      least = d;
      best = p;
    }
  };
  for (int i = 0; i < Corners; ++i) {
    const Eigen::Vector3d edge = v[(i + 1) % Corners] - v[i];
    const double length = edge.squaredNorm();
    offer(length > 0 ? v[i] - std::fmin(std::fmax(v[i].dot(edge) / length, -1.0), 0.0) * edge
                     : v[i]);
  }
  const Eigen::Vector3d normal = (v[1] - v[0]).cross(v[2] - v[1]);
  const double area = normal.squaredNorm();
  for (int i = 0; i < Corners; ++i)
    if (!(v[i].cross(v[(i + 1) % Corners]).dot(normal) > 0)) return best;
  offer((v[0].dot(normal) / area) * normal);
  return best;
}

}  // namespace carom::narrow
