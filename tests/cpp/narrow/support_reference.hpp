// SPDX-License-Identifier: Apache-2.0
#pragma once
// Second opinion on convex pairs: support functions written down from the shapes' definitions, and
// a plain search over directions. Shares no code with the library's.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/shape.hpp"

namespace carom::testing {

using Eigen::Vector3d;

struct SupportFunction {
  Vector3d n;  // unit, body frame

  double operator()(const Sphere& s) const { return s.radius; }
  double operator()(const Box& b) const { return 0.5 * n.cwiseAbs().dot(b.extents); }
  double operator()(const Capsule& c) const { return 0.5 * c.length * std::abs(n.z()) + c.radius; }
  double operator()(const Cylinder& c) const {
    return 0.5 * c.length * std::abs(n.z()) + c.radius * std::hypot(n.x(), n.y());
  }
  double operator()(const Cone& c) const {
    return std::max(0.75 * c.length * n.z(),
                    c.radius * std::hypot(n.x(), n.y()) - 0.25 * c.length * n.z());
  }
  double operator()(const Ellipsoid& e) const { return n.cwiseProduct(e.radii).norm(); }
  double operator()(const Mesh& m) const {
    if (!m.surface->polytope) return std::numeric_limits<double>::quiet_NaN();  // not convex
    return (m.triangles->vertices * n).maxCoeff();
  }
  double operator()(const ConvexHull& h) const { return (h.triangles->vertices * n).maxCoeff(); }
  double operator()(const auto&) const { return std::numeric_limits<double>::quiet_NaN(); }
};

inline double support(const Shape& s, const Pose& pose, const Vector3d& n) {
  return std::visit(SupportFunction{pose.orientation.conjugate() * n}, s) + n.dot(pose.position);
}

/// Gap between the supporting planes of a and b along n.
inline double gap(const Shape& a, const Pose& pa, const Shape& b, const Pose& pb,
                  const Vector3d& n) {
  return -support(a, pa, n) - support(b, pb, -n);
}

/// Largest gap over all directions: the distance, or minus the depth. Every direction tried gives a
/// lower bound, so what it returns is never too large.
inline double largest_gap(const Shape& a, const Pose& pa, const Shape& b, const Pose& pb,
                          std::mt19937_64& random, int samples = 1500, int starts = 6) {
  std::normal_distribution<double> normal;
  std::vector<std::pair<double, Vector3d>> best;
  for (int i = 0; i < samples; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random);
    const Vector3d n = Vector3d(x, y, z).normalized();
    best.emplace_back(gap(a, pa, b, pb, n), n);
  }
  for (int i = 0; i < 3; ++i)
    for (const Pose* p : {&pa, &pb})
      for (double s : {-1.0, 1.0}) {
        const Vector3d n = p->orientation * (s * Vector3d::Unit(i));
        best.emplace_back(gap(a, pa, b, pb, n), n);
      }
  std::ranges::sort(best, [](const auto& l, const auto& r) { return l.first > r.first; });
  double top = best[0].first;
  for (int k = 0; k < starts; ++k) {
    auto [g, n] = best[k];
    double step = 0.1;
    for (int level = 0; level < 150 && step > 1e-11; ++level) {
      bool better = false;
      for (int i = 0; i < 12; ++i) {
        const double x = normal(random), y = normal(random), z = normal(random);
        const Vector3d next = (n + step * Vector3d(x, y, z)).normalized();
        if (const double h = gap(a, pa, b, pb, next); h > g) g = h, n = next, better = true;
      }
      step *= better ? 1.2 : 0.6;
    }
    top = std::max(top, g);
  }
  return top;
}

}  // namespace carom::testing
