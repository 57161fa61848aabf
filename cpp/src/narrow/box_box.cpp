// SPDX-License-Identifier: Apache-2.0
// Boxes meet more often than anything else: their fifteen axes in closed form, and no search.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "carom/geometry/triangle.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/boxes.hpp"
#include "narrow/clip.hpp"
#include "narrow/patch.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

enum class Of { face_a, face_b, edges };

struct Axis {
  double separation = -std::numeric_limits<double>::infinity();  // m
  Of of = Of::face_a;
  int i = 0, j = 0;   // axes of a and b that it belongs to
  double along = 1;   // of the axis as computed; its sign turns it from a to b
  double length = 1;  // of the cross product of two edges
};

Axis best_face_of_a(const Vector3d& ha, const Vector3d& hb, const Matrix3d& A, const Vector3d& t) {
  Axis best;
  for (int i = 0; i < 3; ++i) {
    const double s = std::abs(t[i]) - (ha[i] + A(i, 0) * hb[0] + A(i, 1) * hb[1] + A(i, 2) * hb[2]);
    if (s > best.separation) best = {s, Of::face_a, i, 0, t[i], 1};
  }
  return best;
}

Axis best_face_of_b(const Vector3d& ha, const Vector3d& hb, const Matrix3d& R, const Matrix3d& A,
                    const Vector3d& t) {
  Axis best;
  for (int j = 0; j < 3; ++j) {
    const double d = t[0] * R(0, j) + t[1] * R(1, j) + t[2] * R(2, j);
    const double s = std::abs(d) - (hb[j] + A(0, j) * ha[0] + A(1, j) * ha[1] + A(2, j) * ha[2]);
    if (s > best.separation) best = {s, Of::face_b, 0, j, d, 1};
  }
  return best;
}

/// The axis of least overlap or largest gap; beyond `margin` as soon as one says so.
/// @param between  m, by how much the best face of one is better than that of the other
Axis best_axis(const Vector3d& ha, const Vector3d& hb, const Matrix3d& R, const Vector3d& t,
               double margin, double bias, double& between) {
  const Matrix3d A = R.cwiseAbs();
  Axis best = best_face_of_a(ha, hb, A, t);
  if (best.separation > margin) return best;
  Axis other = best_face_of_b(ha, hb, R, A, t);
  between = std::abs(best.separation - other.separation);
  if (other.separation > best.separation + bias) best = other;
  if (best.separation > margin) return best;
  other.separation = best.separation + bias;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double d = t[i2] * R(i1, j) - t[i1] * R(i2, j);
      const double s = std::abs(d) - (ha[i1] * A(i2, j) + ha[i2] * A(i1, j) + hb[j1] * A(i, j2) +
                                      hb[j2] * A(i, j1));
      // Not yet over the length, which is at most 1: an overlap only grows by it.
      if (s <= std::min(other.separation, 0.0)) continue;
      const double square = R(i1, j) * R(i1, j) + R(i2, j) * R(i2, j);
      if (square <= tolerance::parallel_edges * tolerance::parallel_edges) continue;
      const double length = std::sqrt(square);
      if (s > other.separation * length) other = {s / length, Of::edges, i, j, d, length};
    }
  }
  return other.of == Of::edges && other.separation > best.separation + bias ? other : best;
}

Vector3d direction(const Axis& axis, const Matrix3d& R) {
  const double sign = axis.along < 0 ? -1 : 1;
  if (axis.of == Of::face_a) return sign * Vector3d::Unit(axis.i);
  if (axis.of == Of::face_b) return sign * R.col(axis.j);
  return sign / axis.length * Vector3d::Unit(axis.i).cross(R.col(axis.j));
}

const Polytope& pattern() {
  static const Polytope cube = box_polytope({2, 2, 2});
  return cube;
}

/// Number of the edge along `axis` that lies farthest out along n, and its ends.
int edge_towards(const Vector3d& half, const Vector3d& n, int axis, Vector3d (&ends)[2]) {
  int v = 0;
  for (int k = 0; k < 3; ++k)
    if (k != axis && n[k] > 0) v |= 1 << k;
  const int w = v | 1 << axis;
  for (int k = 0; k < 3; ++k) {
    ends[0][k] = v >> k & 1 ? half[k] : -half[k];
    ends[1][k] = w >> k & 1 ? half[k] : -half[k];
  }
  const std::vector<Polytope::Edge>& edges = pattern().edges;
  for (int e = 0; e < static_cast<int>(edges.size()); ++e)
    if (std::min(edges[e].v0, edges[e].v1) == v && std::max(edges[e].v0, edges[e].v1) == w)
      return e;
  return -1;
}

/// Of the face whose normal is n, an axis of the box.
int face_number(const Vector3d& n) {
  int axis;
  n.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (n[axis] > 0 ? 1 : 0);
}

/// The face most along n, n in the box's frame. Returns the cosine between them.
double face_towards(const Vector3d& half, const Vector3d& n, const Frame* frame, Quad& out) {
  int axis;
  const double cosine = n.cwiseAbs().maxCoeff(&axis);
  const int f = 2 * axis + (n[axis] > 0 ? 1 : 0);
  const Polytope& cube = pattern();
  out.clear();
  out.feature = feature::face(f);
  for (int k = cube.first[f]; k < cube.first[f + 1]; ++k) {
    const Vector3d p = cube.vertices[cube.corners[k]].cwiseProduct(half);
    out.push(frame ? *frame * p : p, feature::vertex(cube.corners[k]),
             feature::edge(cube.corner_edges[k]));
  }
  return cosine;
}

/// Where an edge of one lies along an edge of the other and they all but touch. False elsewhere.
bool lean_together(const Vector3d& half_a, const Vector3d& half_b, const Frame& b_in_a,
                   double smaller, double margin, std::vector<Manifold>& out) {
  const Matrix3d &R = b_in_a.rotation, A = R.cwiseAbs();
  if (!(A.maxCoeff() > 1 - tolerance::parallel_edges)) return false;
  const Axis of_a = best_face_of_a(half_a, half_b, A, b_in_a.translation);
  const Axis of_b = best_face_of_b(half_a, half_b, R, A, b_in_a.translation);
  const Vector3d na = direction(of_a, R), nb = direction(of_b, R);
  const Vector3d in_b = -(R.transpose() * nb);
  Manifold m;
  if (!edge_on_edge(scratch_polytope(Box{2 * half_a}, 0), {of_a.separation, na, face_number(na)},
                    scratch_polytope(Box{2 * half_b}, 1), {of_b.separation, nb, face_number(in_b)},
                    b_in_a, smaller, m))
    return false;
  if (m.points[0].separation <= margin) out.push_back(m);
  return true;
}

}  // namespace

void box_box(const Vector3d& half_a, const Vector3d& half_b, const Frame& b_in_a, double margin,
             std::vector<Manifold>& out) {
  Quad face_a, face_b;
  thread_local std::vector<ContactPoint> points;
  const double size = 2 * (half_a.norm() + half_b.norm());
  const double bias = tolerance::axis_preference * size;
  const Matrix3d& R = b_in_a.rotation;
  double between = std::numeric_limits<double>::infinity();
  const Axis best = best_axis(half_a, half_b, R, b_in_a.translation, margin, bias, between);
  if (best.separation > margin) return;
  const double smaller = 4 * std::min(half_a.norm(), half_b.norm());
  if (between < tolerance::edge_on_edge * smaller &&
      lean_together(half_a, half_b, b_in_a, smaller, margin, out))
    return;

  const Vector3d n = direction(best, R), n_b = -(R.transpose() * n);
  const double facing_a = face_towards(half_a, n, nullptr, face_a);
  const double facing_b = face_towards(half_b, n_b, &b_in_a, face_b);
  points.clear();
  if (best.of != Of::edges || std::min(facing_a, facing_b) > tolerance::facing)
    clip(face_a, face_b, n, margin, points);
  if (best.of == Of::edges && points.empty()) {
    Vector3d a[2], b[2];
    const int ea = edge_towards(half_a, n, best.i, a), eb = edge_towards(half_b, n_b, best.j, b);
    const SegmentPoints s = closest_points(a[0], a[1], b_in_a * b[0], b_in_a * b[1]);
    // Apart, the axis bounds the gap; the two edges have it only where they cross.
    const double gap = best.separation > bias ? (s.q - s.p).norm() : best.separation;
    points.push_back({0.5 * (s.p + s.q), gap, feature::pair(feature::edge(ea), feature::edge(eb))});
  }
  if (best.separation > bias) {
    double least = std::numeric_limits<double>::infinity();
    for (const ContactPoint& p : points) least = std::min(least, p.separation);
    // Where no point of the patch is as near as the axis says, others are nearer: search for them.
    if (least > best.separation + bias)
      return convex_convex(Convex::hull(scratch_polytope(Box{2 * half_a}, 0)),
                           Convex::hull(scratch_polytope(Box{2 * half_b}, 1)), b_in_a, margin, out);
  }
  if (!points.empty()) reduce(points, n, out.emplace_back());
}

}  // namespace carom
