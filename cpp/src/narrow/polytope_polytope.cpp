// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "carom/geometry/triangle.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/clip.hpp"
#include "narrow/patch.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

struct Axis {
  double separation = -std::numeric_limits<double>::infinity();  // m
  Vector3d normal = Vector3d::UnitZ();                           // from a to b, frame of a
  int a = -1, b = -1;                                            // faces or edges
};

/// b carried into the frame of a.
struct Moved {
  std::vector<Vector3d> vertices, normals;

  void set(const Polytope& p, const Frame& frame) {
    vertices.resize(p.vertices.size());
    normals.resize(p.normals.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = frame * p.vertices[i];
    for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = frame.rotation * p.normals[i];
  }
};

Axis best_face(const std::vector<Vector3d>& normals, const std::vector<Vector3d>& on_face,
               const Polytope& owner, const std::vector<Vector3d>& others) {
  Axis best;
  for (int f = 0; f < owner.face_count(); ++f) {
    const Vector3d& n = normals[f];
    const double offset = n.dot(on_face[owner.corners[owner.first[f]]]);
    double low = std::numeric_limits<double>::infinity();
    for (const Vector3d& x : others) low = std::min(low, n.dot(x));
    if (low - offset > best.separation) best = {low - offset, n, f, f};
  }
  return best;
}

/// Edge pairs that make a face of the Minkowski difference: their arcs cross on the Gauss sphere.
/// Source: D. Gregorius, The Separating Axis Test between Convex Polyhedra, GDC 2013.
Axis best_edges(const Polytope& a, const Polytope& b, const Moved& mb) {
  Axis best;
  for (int i = 0; i < static_cast<int>(a.edges.size()); ++i) {
    const Polytope::Edge& e = a.edges[i];
    const Vector3d &p = a.normals[e.f0], &q = a.normals[e.f1];
    const Vector3d along = a.vertices[e.v1] - a.vertices[e.v0], qp = q.cross(p);
    for (int j = 0; j < static_cast<int>(b.edges.size()); ++j) {
      const Polytope::Edge& g = b.edges[j];
      const Vector3d c = -mb.normals[g.f0], d = -mb.normals[g.f1];
      const double cqp = c.dot(qp), dqp = d.dot(qp);
      if (cqp * dqp >= 0) continue;
      const Vector3d dc = d.cross(c);
      const double pdc = p.dot(dc), qdc = q.dot(dc);
      if (pdc * qdc >= 0 || cqp * qdc <= 0) continue;
      const Vector3d other = mb.vertices[g.v1] - mb.vertices[g.v0];
      Vector3d n = along.cross(other);
      const double length = n.norm();
      if (length <= tolerance::parallel_edges * along.norm() * other.norm()) continue;
      n /= n.dot(p + q) < 0 ? -length : length;
      const double separation = n.dot(mb.vertices[g.v0] - a.vertices[e.v0]);
      if (separation > best.separation) best = {separation, n, i, j};
    }
  }
  return best;
}

int most_along(const std::vector<Vector3d>& normals, const Vector3d& n) {
  int best = 0;
  for (int f = 1; f < static_cast<int>(normals.size()); ++f)
    if (normals[f].dot(n) > normals[best].dot(n)) best = f;
  return best;
}

void face_of(const Polytope& p, const std::vector<Vector3d>& vertices, int f, Face& out) {
  out.clear();
  out.feature = feature::face(f);
  for (int k = p.first[f]; k < p.first[f + 1]; ++k)
    out.push(vertices[p.corners[k]], feature::vertex(p.corners[k]),
             feature::edge(p.corner_edges[k]));
}

double size_of(const Polytope& p) {
  return (p.vertices.front() - p.vertices[p.corners[p.first.back() - 2]]).norm();
}

/// Of two edges that make the axis.
ContactPoint crossing(const Polytope& a, const Polytope& b, const Moved& mb, const Axis& axis) {
  const Polytope::Edge &e = a.edges[axis.a], &g = b.edges[axis.b];
  const SegmentPoints s =
      closest_points(a.vertices[e.v0], a.vertices[e.v1], mb.vertices[g.v0], mb.vertices[g.v1]);
  return {0.5 * (s.p + s.q), axis.separation,
          feature::pair(feature::edge(axis.a), feature::edge(axis.b))};
}

/// The corner of the other body that reaches deepest through the face of the axis.
ContactPoint deepest_corner(const Polytope& a, const Moved& mb, const Axis& axis, bool of_b) {
  const std::vector<Vector3d>& corners = of_b ? a.vertices : mb.vertices;
  const Vector3d down = of_b ? axis.normal : Vector3d(-axis.normal);  // through the face
  const int v = most_along(corners, down);
  const std::uint32_t corner = feature::vertex(v), face = feature::face(axis.a);
  return {corners[v] - 0.5 * axis.separation * (of_b ? -axis.normal : axis.normal), axis.separation,
          of_b ? feature::pair(corner, face) : feature::pair(face, corner)};
}

}  // namespace

void polytope_polytope(const Polytope& a, const Polytope& b, const Frame& b_in_a, double margin,
                       std::vector<Manifold>& out) {
  thread_local Moved mb;
  thread_local Face face_a, face_b;
  thread_local std::vector<ContactPoint> points;
  mb.set(b, b_in_a);

  const Axis by_a = best_face(a.normals, a.vertices, a, mb.vertices);
  if (by_a.separation > margin) return;
  Axis by_b = best_face(mb.normals, mb.vertices, b, a.vertices);
  if (by_b.separation > margin) return;
  by_b.normal = -by_b.normal;
  const Axis by_edges = best_edges(a, b, mb);
  if (by_edges.separation > margin) return;

  const double size_a = size_of(a), size_b = size_of(b);
  const double bias = tolerance::axis_preference * (size_a + size_b);
  if (Manifold m; edge_on_edge(a, {by_a.separation, by_a.normal, by_a.a}, b,
                               {by_b.separation, by_b.normal, by_b.a}, b_in_a,
                               2 * std::min(size_a, size_b), m)) {
    if (m.points[0].separation <= margin) out.push_back(m);
    return;
  }
  const bool of_b = by_b.separation > by_a.separation + bias;
  Axis best = of_b ? by_b : by_a;
  const bool edges = by_edges.separation > best.separation + bias;
  if (edges) best = by_edges;

  if (best.separation >
      bias) {  // apart: an axis bounds the gap, but need not be where they are near
    return convex_convex(Convex::hull(a), Convex::hull(b), b_in_a, margin, out);
  }
  points.clear();
  const int fa = most_along(a.normals, best.normal), fb = most_along(mb.normals, -best.normal);
  if (!edges || (a.normals[fa].dot(best.normal) > tolerance::facing &&
                 -mb.normals[fb].dot(best.normal) > tolerance::facing)) {
    face_of(a, a.vertices, fa, face_a);
    face_of(b, mb.vertices, fb, face_b);
    clip(face_a, face_b, best.normal, margin, points);
  }
  // Of the two faces most along the axis neither need hold the corner or the edge that is deepest.
  double least = std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : points) least = std::min(least, p.separation);
  if (!(least <= best.separation + bias))
    points.push_back(edges ? crossing(a, b, mb, best) : deepest_corner(a, mb, best, of_b));
  reduce(points, best.normal, out.emplace_back());
}

}  // namespace carom
