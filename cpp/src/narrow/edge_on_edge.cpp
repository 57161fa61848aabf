// SPDX-License-Identifier: Apache-2.0
// Two edges that lie along one another, as of leaning cards. The bodies may part along any
// direction between two face normals; the faces' own, which separating axes offer, are the ends of
// that range, and which of them wins is rounding. Held along one of them the cards would slide off
// each other.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// Along an edge: its ends, in order along a direction, and their names.
struct Line {
  Vector3d from, to;
  int first, last;  // vertices

  Line(const Polytope& p, int e, const Frame* frame, const Vector3d& along) {
    first = p.edges[e].v0, last = p.edges[e].v1;
    if ((p.vertices[last] - p.vertices[first])
            .dot(frame ? frame->rotation.transpose() * along : along) < 0)
      std::swap(first, last);
    from = frame ? *frame * p.vertices[first] : p.vertices[first];
    to = frame ? *frame * p.vertices[last] : p.vertices[last];
  }
};

/// The direction from edge to edge: midway between the two normals where they meet, towards the
/// deeper axis in an overlap and towards the gap apart, both in full `width` away.
Vector3d direction(const FaceAxis& a, const FaceAxis& b, const Vector3d& gap, double width) {
  const double share = std::clamp(0.5 + 0.5 * (a.separation - b.separation) / width, 0.0, 1.0);
  const double far = gap.norm();
  if (std::max(a.separation, b.separation) <= 0 || !(far > 0))
    return (share * a.normal + (1 - share) * b.normal).normalized();
  const double apart = std::min(1.0, far / width);
  return ((1 - apart) * (a.normal + b.normal).normalized() + apart * gap / far).normalized();
}

}  // namespace

bool edge_on_edge(const Polytope& pa, const FaceAxis& a, const Polytope& pb, const FaceAxis& b,
                  const Frame& b_in_a, double size, Manifold& out) {
  const double width = tolerance::edge_on_edge * size;
  if (!(std::abs(a.separation - b.separation) < width)) return false;
  const Vector3d across = a.normal.cross(b.normal);
  if (a.normal.dot(b.normal) > tolerance::facing || !(across.norm() > tolerance::parallel_edges))
    return false;
  const Vector3d u = across.normalized();
  const Vector3d u_b = b_in_a.rotation.transpose() * u;
  const auto lies_along = [](const Polytope& p, int e, const Vector3d& d) {
    const Vector3d edge = p.vertices[p.edges[e].v1] - p.vertices[p.edges[e].v0];
    return d.cross(edge).norm() <= tolerance::parallel_edges * edge.norm();
  };
  for (int i = pa.first[a.face]; i < pa.first[a.face + 1]; ++i) {
    const int ea = pa.corner_edges[i];
    if (!lies_along(pa, ea, u)) continue;
    const Line la(pa, ea, nullptr, u);
    for (int j = pb.first[b.face]; j < pb.first[b.face + 1]; ++j) {
      const int eb = pb.corner_edges[j];
      if (!lies_along(pb, eb, u_b)) continue;
      const Line lb(pb, eb, &b_in_a, u);
      Vector3d gap = lb.from - la.from;
      gap -= u.dot(gap) * u;
      if (!(gap.norm() < width)) continue;
      const bool a_starts = u.dot(la.from - lb.from) > 0, a_ends = u.dot(la.to - lb.to) < 0;
      const Vector3d from = a_starts ? la.from : Vector3d(la.from + u.dot(lb.from - la.from) * u);
      const Vector3d to = a_ends ? la.to : Vector3d(la.from + u.dot(lb.to - la.from) * u);
      if (!(u.dot(to - from) > 0)) continue;
      out.normal = direction(a, b, gap, width);
      out.count = 2;
      const double separation = out.normal.dot(gap);
      const auto name = [&](bool of_a, int va, int vb) {
        return of_a ? feature::pair(feature::vertex(va), feature::edge(eb))
                    : feature::pair(feature::edge(ea), feature::vertex(vb));
      };
      out.points[0] = {from + 0.5 * gap, separation, name(a_starts, la.first, lb.first)};
      out.points[1] = {to + 0.5 * gap, separation, name(a_ends, la.last, lb.last)};
      return true;
    }
  }
  return false;
}

}  // namespace carom
