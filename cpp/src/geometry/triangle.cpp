// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/triangle.hpp"

#include <algorithm>

namespace carom {
namespace {

using Eigen::Vector3d;

// A sliver without area has no inside: the nearest of its three edges answers.
TrianglePoint closest_on_edges(const Vector3d& p, const Vector3d (&v)[3]) {
  TrianglePoint best{v[0], TriangleFeature::corner0};
  double best_squared = (p - v[0]).squaredNorm();
  for (int i = 0; i < 3; ++i) {
    const Vector3d e = v[(i + 1) % 3] - v[i];
    const double length2 = e.squaredNorm();
    const double t = length2 > 0 ? std::clamp((p - v[i]).dot(e) / length2, 0.0, 1.0) : 0.0;
    const Vector3d q = v[i] + t * e;
    if (const double d = (p - q).squaredNorm(); d < best_squared) {
      best_squared = d;
      const int corner = t == 0 ? i : (i + 1) % 3;
      best = {q, t > 0 && t < 1 ? static_cast<TriangleFeature>(3 + i)
                                : static_cast<TriangleFeature>(corner)};
    }
  }
  return best;
}

}  // namespace

TrianglePoint closest_point(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                            const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, TriangleFeature::corner0};
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, TriangleFeature::corner1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 - d3 > 0)
    return {a + d1 / (d1 - d3) * ab, TriangleFeature::edge0};
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, TriangleFeature::corner2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 - d6 > 0)
    return {a + d2 / (d2 - d6) * ac, TriangleFeature::edge2};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0 && d4 - d3 + d5 - d6 > 0)
    return {b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b), TriangleFeature::edge1};
  const double sum = va + vb + vc;
  if (!(sum > 0)) return closest_on_edges(p, {a, b, c});
  return {a + vb / sum * ab + vc / sum * ac, TriangleFeature::face};
}

SegmentPoints closest_points(const Vector3d& p0, const Vector3d& p1, const Vector3d& q0,
                             const Vector3d& q1) {
  const Vector3d u = p1 - p0, v = q1 - q0, w = p0 - q0;
  const double a = u.squaredNorm(), e = v.squaredNorm(), f = v.dot(w);
  double s = 0, t = 0;
  if (a > 0 && e > 0) {
    const double c = u.dot(w), b = u.dot(v), determinant = a * e - b * b;
    if (determinant > 0) s = std::clamp((b * f - c * e) / determinant, 0.0, 1.0);
    t = (b * s + f) / e;
    if (t < 0) {
      t = 0;
      s = std::clamp(-c / a, 0.0, 1.0);
    } else if (t > 1) {
      t = 1;
      s = std::clamp((b - c) / a, 0.0, 1.0);
    }
  } else if (a > 0) {
    s = std::clamp(-u.dot(w) / a, 0.0, 1.0);
  } else if (e > 0) {
    t = std::clamp(f / e, 0.0, 1.0);
  }
  return {s, t, p0 + s * u, q0 + t * v};
}

}  // namespace carom
