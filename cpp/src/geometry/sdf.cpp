// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/sdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/sdf_surface.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// Weights of samples first .. first + 3 at a coordinate counted in cells, and their slopes.
struct Weights {
  int first, count;
  std::array<double, 4> value, slope;

  Weights(double x, int samples) {
    const int cell = std::clamp(static_cast<int>(x), 0, samples - 2);
    const double t = x - cell;
    if (cell == 0 || cell == samples - 2) {
      first = cell, count = 2;
      value = {1 - t, t, 0, 0};
      slope = {-1, 1, 0, 0};
      return;
    }
    first = cell - 1, count = 4;  // Lagrange's cubic through -1, 0, 1, 2
    value = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
             -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
    slope = {-(3 * t * t - 6 * t + 2) / 6, (3 * t * t - 4 * t - 1) / 2,
             -(3 * t * t - 2 * t - 2) / 2, (3 * t * t - 1) / 6};
  }
};

}  // namespace

double SdfGrid::sample(const Vector3d& p, Vector3d& gradient) const {
  const Aabb all = box();
  const Vector3d inside = p.cwiseMax(all.lower).cwiseMin(all.upper);
  const Vector3d x = (inside - lower) / spacing;
  const Weights wx(x.x(), count.x()), wy(x.y(), count.y()), wz(x.z(), count.z());
  double sum = 0;
  gradient.setZero();
  for (int k = 0; k < wz.count; ++k)
    for (int j = 0; j < wy.count; ++j) {
      const double* row =
          &values[wx.first +
                  static_cast<std::size_t>(count.x()) *
                      (wy.first + j + static_cast<std::size_t>(count.y()) * (wz.first + k))];
      double v = 0, s = 0;
      for (int i = 0; i < wx.count; ++i) v += wx.value[i] * row[i], s += wx.slope[i] * row[i];
      sum += wz.value[k] * wy.value[j] * v;
      gradient.x() += wz.value[k] * wy.value[j] * s;
      gradient.y() += wz.value[k] * wy.slope[j] * v;
      gradient.z() += wz.slope[k] * wy.value[j] * v;
    }
  gradient /= spacing;
  const Vector3d outside = p - inside;
  if (const double far = outside.norm(); far > 0) {
    sum += far;
    gradient = outside / far;
  }
  return sum;
}

SdfGrid SdfGrid::from_function(const Distance& distance, const Aabb& box, double spacing) {
  require_positive(spacing, "Sdf.spacing", "m");
  if (box.empty() || !box.extents().allFinite())
    throw InvalidInput("Sdf.box", "empty", "must be finite, lower <= upper");
  SdfGrid g;
  g.spacing = spacing;
  g.lower = box.lower.array() - 2 * spacing;
  const Vector3d cells = (box.extents() / spacing).array().ceil() + 5;
  if (!(cells.prod() <= tolerance::sdf_samples))
    throw InvalidInput("Sdf.spacing", with_unit(spacing, "m"),
                       "makes " + with_unit(cells.prod(), "samples"), "choose a larger spacing");
  g.count = cells.cast<int>();
  g.values.reserve(static_cast<std::size_t>(cells.prod()));
  for (int k = 0; k < g.count.z(); ++k)
    for (int j = 0; j < g.count.y(); ++j)
      for (int i = 0; i < g.count.x(); ++i) {
        const double d = distance(g.lower + spacing * Vector3d(i, j, k));
        require_finite(d, "Sdf.distance", "m");
        g.values.push_back(d);
      }
  Vector3d unused;
  for (int k = 1; k + 2 < g.count.z(); ++k)
    for (int j = 1; j + 2 < g.count.y(); ++j)
      for (int i = 1; i + 2 < g.count.x(); ++i) {
        if (std::abs(g.value(i, j, k)) > 2 * spacing) continue;
        const Vector3d p = g.lower + spacing * Vector3d(i + 0.5, j + 0.5, k + 0.5);
        g.error = std::max(g.error, std::abs(g.sample(p, unused) - distance(p)));
      }
  g.surface = zero_level(g);
  return g;
}

SdfGrid SdfGrid::from_mesh(const MeshSurface& mesh, double spacing) {
  if (!mesh.faults.closed() || mesh.faults.inverted)
    throw InvalidInput("Sdf.mesh", mesh.faults.to_string(), "must be closed, faces outward");
  const double inf = std::numeric_limits<double>::infinity();
  return from_function([&](const Vector3d& p) { return closest_point(mesh, p, inf).distance; },
                       mesh.tree.nodes[0].box, spacing);
}

}  // namespace carom
