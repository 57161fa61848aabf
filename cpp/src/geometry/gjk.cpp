// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "carom/geometry/triangle.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/minkowski.hpp"

namespace carom::detail {
namespace {

using Eigen::Vector3d;

struct Simplex {
  std::array<Vertex, 4> v;
  std::array<double, 4> weight{};
  int count = 0;

  Vector3d mix(Vector3d Vertex::* part) const {
    Vector3d x = Vector3d::Zero();
    for (int i = 0; i < count; ++i) x += weight[i] * (v[i].*part);
    return x;
  }
};

/// Weights of the point of triangle a b c nearest the origin; corners that carry none are dropped.
Simplex nearest_on_triangle(const Vertex& a, const Vertex& b, const Vertex& c) {
  const TrianglePoint p = closest_point(Vector3d::Zero(), a.w, b.w, c.w);
  const std::array<const Vertex*, 3> v{&a, &b, &c};
  Simplex s;
  const auto edge = [&](int i) {
    const Vertex &from = *v[i], &to = *v[(i + 1) % 3];
    const Vector3d e = to.w - from.w;
    const double t = std::clamp((p.point - from.w).dot(e) / e.squaredNorm(), 0.0, 1.0);
    s.v[0] = from, s.v[1] = to;
    s.weight = {1 - t, t};
    s.count = 2;
  };
  const int f = static_cast<int>(p.feature);
  if (f < 3) {
    s.v[0] = *v[f];
    s.weight[0] = 1;
    s.count = 1;
  } else if (f < 6) {
    edge(f - 3);
  } else {
    const Vector3d n = (b.w - a.w).cross(c.w - a.w);
    const double area = n.squaredNorm();
    const double wa = n.dot((b.w - p.point).cross(c.w - p.point)) / area;
    const double wb = n.dot((c.w - p.point).cross(a.w - p.point)) / area;
    s.v[0] = a, s.v[1] = b, s.v[2] = c;
    s.weight = {wa, wb, 1 - wa - wb, 0};
    s.count = 3;
  }
  return s;
}

Simplex nearest_on_segment(const Vertex& a, const Vertex& b) {
  const Vector3d e = b.w - a.w;
  const double length2 = e.squaredNorm(), t = length2 > 0 ? -a.w.dot(e) / length2 : 0;
  Simplex s;
  if (t <= 0 || t >= 1) {
    s.v[0] = t <= 0 ? a : b;
    s.weight[0] = 1;
    s.count = 1;
  } else {
    s.v[0] = a, s.v[1] = b;
    s.weight = {1 - t, t};
    s.count = 2;
  }
  return s;
}

/// False when the origin lies inside the tetrahedron.
bool nearest_on_tetrahedron(const std::array<Vertex, 4>& v, Simplex& best) {
  constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
  double least = std::numeric_limits<double>::infinity();
  bool outside = false;
  for (const auto& f : faces) {
    const Vector3d n = (v[f[1]].w - v[f[0]].w).cross(v[f[2]].w - v[f[0]].w);
    const double of_origin = -n.dot(v[f[0]].w), of_fourth = n.dot(v[f[3]].w - v[f[0]].w);
    if (of_origin * of_fourth > 0) continue;  // same side: not seen through this face
    outside = true;
    const Simplex s = nearest_on_triangle(v[f[0]], v[f[1]], v[f[2]]);
    if (const double d = s.mix(&Vertex::w).squaredNorm(); d < least) least = d, best = s;
  }
  return outside;
}

}  // namespace

Found gjk(const Difference& difference, double beyond) {
  Found out;
  Simplex s;
  const Vector3d start = difference.b_in_a.translation;
  s.v[0] = difference.support(start.squaredNorm() > 0 ? start : Vector3d(Vector3d::UnitX()));
  s.weight[0] = 1;
  s.count = 1;
  Vector3d v = s.v[0].w;
  double scale = v.norm();
  out.capped = true;
  for (int i = 0; i < tolerance::gjk_iterations; ++i) {
    const double length = v.norm();
    if (length <= tolerance::touching_core * scale) {
      out.overlap = true;
      return out;
    }
    const Vertex next = difference.support(v);
    scale = std::max(scale, next.w.norm());
    const double bound = v.dot(next.w) / length;  // no point of the difference is nearer
    if (bound > beyond) {
      out.beyond = true;
      out.capped = false;
      out.distance = bound;
      out.normal = v / length;
      break;
    }
    if (length - bound <= tolerance::gjk_gain * length) {
      out.capped = false;
      break;
    }
    bool known = false;
    for (int k = 0; k < s.count; ++k) known = known || s.v[k].w == next.w;
    if (known) {
      out.capped = false;
      break;
    }
    Simplex grown;
    if (s.count == 1) {
      grown = nearest_on_segment(s.v[0], next);
    } else if (s.count == 2) {
      grown = nearest_on_triangle(s.v[0], s.v[1], next);
    } else if (!nearest_on_tetrahedron({s.v[0], s.v[1], s.v[2], next}, grown)) {
      out.overlap = true;
      return out;
    }
    const Vector3d nearer = grown.mix(&Vertex::w);
    if (!(nearer.squaredNorm() < v.squaredNorm())) {  // rounding has the last word
      out.capped = false;
      break;
    }
    s = grown;
    v = nearer;
  }
  out.a = s.mix(&Vertex::a);
  out.b = s.mix(&Vertex::b);
  if (out.beyond) return out;
  out.distance = v.norm();
  out.normal = v / out.distance;
  if (s.count == 3) {  // the plane of three corners keeps its digits however near the origin is
    const Vector3d n = (s.v[1].w - s.v[0].w).cross(s.v[2].w - s.v[0].w).normalized();
    out.normal = n.dot(v) < 0 ? Vector3d(-n) : n;
    out.distance = out.normal.dot(s.v[0].w);
  }
  // A search that rounding ended at a flat simplex may stand within an overlap: nothing then holds
  // the bodies apart along what it found.
  out.overlap = difference.gap(out.normal) < -tolerance::touching_core * scale;
  return out;
}

}  // namespace carom::detail
