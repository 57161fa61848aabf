// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/sdf.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/sdf_surface.hpp"
#include "geometry/spline.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// The cell of a coordinate counted in cells, and the splines over it.
struct Place {
  int cell;
  SplineWeights weights;

  Place(double x, int samples)
      : cell(std::clamp(static_cast<int>(x), 0, samples - 2)), weights(x - cell) {}
};

}  // namespace

double SdfGrid::sample(const Vector3d& p, Vector3d& gradient) const {
  const Aabb all = box();
  const Vector3d inside = p.cwiseMax(all.lower).cwiseMin(all.upper);
  const Vector3d x = (inside - lower) / spacing;
  const Place px(x.x(), count.x()), py(x.y(), count.y()), pz(x.z(), count.z());
  const SplineWeights &wx = px.weights, &wy = py.weights, &wz = pz.weights;
  const std::size_t row = static_cast<std::size_t>(count.x()) + 2;
  const std::size_t layer = row * (static_cast<std::size_t>(count.y()) + 2);
  const double* first = &coefficients[px.cell + row * py.cell + layer * pz.cell];
  double sum = 0;
  gradient.setZero();
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      const double* c = first + j * row + k * layer;
      const double v =
          wx.value[0] * c[0] + wx.value[1] * c[1] + wx.value[2] * c[2] + wx.value[3] * c[3];
      const double s =
          wx.slope[0] * c[0] + wx.slope[1] * c[1] + wx.slope[2] * c[2] + wx.slope[3] * c[3];
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
  std::vector<double> samples;
  samples.reserve(static_cast<std::size_t>(cells.prod()));
  for (int k = 0; k < g.count.z(); ++k)
    for (int j = 0; j < g.count.y(); ++j)
      for (int i = 0; i < g.count.x(); ++i) {
        const double d = distance(g.lower + spacing * Vector3d(i, j, k));
        require_finite(d, "Sdf.distance", "m");
        samples.push_back(d);
      }
  g.coefficients = spline_coefficients(samples, g.count);
  Vector3d unused;
  for (int k = 0; k + 1 < g.count.z(); ++k)
    for (int j = 0; j + 1 < g.count.y(); ++j)
      for (int i = 0; i + 1 < g.count.x(); ++i) {
        const std::size_t row = j + static_cast<std::size_t>(g.count.y()) * k;
        if (std::abs(samples[i + g.count.x() * row]) > 2 * spacing) continue;
        const Vector3d p = g.lower + spacing * Vector3d(i + 0.5, j + 0.5, k + 0.5);
        g.error = std::max(g.error, std::abs(g.sample(p, unused) - distance(p)));
      }
  g.surface = zero_level(g, samples);
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
