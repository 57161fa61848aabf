// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "carom/numerics/tolerance.hpp"

#include "geometry/minkowski.hpp"

namespace carom::detail {
namespace {

using Eigen::Vector3d;

struct Face {
  std::array<int, 3> v;
  Vector3d normal;  // out of the difference
  double offset;
  bool alive = true;
};

/// Triangulated hull that grows by one point at a time.
struct Hull {
  std::vector<Vertex> points;
  std::vector<Face> faces;
  std::vector<std::pair<int, int>> border;

  bool add_face(int a, int b, int c) {
    const Vector3d n = (points[b].w - points[a].w).cross(points[c].w - points[a].w);
    const double length = n.norm();
    if (!(length > 0)) return false;
    faces.push_back({{a, b, c}, n / length, n.dot(points[a].w) / length});
    return true;
  }
  /// Replaces what the new point sees. The border of the seen faces is found by edges met once.
  bool add_point(const Vertex& p, double slack) {
    points.push_back(p);
    const int me = static_cast<int>(points.size()) - 1;
    border.clear();
    for (Face& f : faces) {
      if (!f.alive || f.normal.dot(p.w) <= f.offset + slack) continue;
      f.alive = false;
      for (int k = 0; k < 3; ++k) {
        const std::pair edge(f.v[k], f.v[(k + 1) % 3]);
        const auto twin = std::ranges::find(border, std::pair(edge.second, edge.first));
        if (twin != border.end())
          border.erase(twin);
        else
          border.push_back(edge);
      }
    }
    std::erase_if(faces, [](const Face& f) { return !f.alive; });
    // Two flat ends of a sliver on one line make no face; the sliver's neighbours cover the place.
    for (const auto& [a, b] : border) (void)add_face(a, b, me);
    return border.size() >= 3;
  }
};

/// A tetrahedron of support points as fat as the first few directions give. False where they have
/// no volume; `across` is then square to what they span.
bool start(const Difference& difference, Hull& hull, Vector3d& across) {
  hull.points.clear();
  hull.faces.clear();
  std::array<Vertex, 6> first;
  for (int i = 0; i < 6; ++i)
    first[i] = difference.support((i % 2 ? -1.0 : 1.0) * Vector3d::Unit(i / 2));
  double longest = -1;
  int p = 0, q = 1;
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j)
      if (const double d = (first[i].w - first[j].w).norm(); d > longest) longest = d, p = i, q = j;
  across = Vector3d::UnitZ();
  if (!(longest > 0)) return false;
  const Vector3d along = (first[q].w - first[p].w) / longest;
  across = along.unitOrthogonal();
  Vertex third = first[p];
  double far = 0;
  const Vector3d u = along.unitOrthogonal(), w = along.cross(u);
  for (const Vector3d& d : {u, Vector3d(-u), w, Vector3d(-w)}) {
    const Vertex v = difference.support(d);
    const Vector3d off = v.w - first[p].w;
    if (const double h = (off - off.dot(along) * along).norm(); h > far) far = h, third = v;
  }
  Vector3d n = along.cross(third.w - first[p].w);
  if (!(n.norm() > tolerance::flat_triangle * longest * longest)) return false;
  n.normalize();
  across = n;
  Vertex fourth = difference.support(n);
  const Vertex other = difference.support(-n);
  if (std::abs(n.dot(other.w - first[p].w)) > std::abs(n.dot(fourth.w - first[p].w)))
    fourth = other;
  const double height = n.dot(fourth.w - first[p].w);
  if (!(std::abs(height) > tolerance::flat_triangle * longest)) return false;
  hull.points = {first[p], first[q], third, fourth};
  if (height > 0) std::swap(hull.points[1], hull.points[2]);
  return hull.add_face(0, 1, 2) && hull.add_face(0, 3, 1) && hull.add_face(1, 3, 2) &&
         hull.add_face(2, 3, 0);
}

void witness(const Hull& hull, const Face& f, Found& out) {
  const Vertex &a = hull.points[f.v[0]], &b = hull.points[f.v[1]], &c = hull.points[f.v[2]];
  const Vector3d foot = f.offset * f.normal, n = (b.w - a.w).cross(c.w - a.w);
  const double area = n.squaredNorm();
  const double wa = n.dot((b.w - foot).cross(c.w - foot)) / area;
  const double wb = n.dot((c.w - foot).cross(a.w - foot)) / area;
  out.a = wa * a.a + wb * b.a + (1 - wa - wb) * c.a;
  out.b = wa * a.b + wb * b.b + (1 - wa - wb) * c.b;
}

}  // namespace

Found expand(const Difference& difference) {
  thread_local Hull hull;
  Found out;
  out.overlap = true;
  if (Vector3d n; !start(difference, hull, n)) {  // no volume: what overlaps there only touches
    out.normal = difference.b_in_a.translation.dot(n) < 0 ? Vector3d(-n) : n;
    const Vertex v = difference.support(out.normal);
    out.a = v.a, out.b = v.b;
    out.distance = out.normal.dot(v.w);
    return out;
  }
  double scale = 0;
  for (const Vertex& v : hull.points) scale = std::max(scale, v.w.norm());
  out.capped = true;
  Face best = hull.faces[0];
  Face kept = best;  // the face whose support plane bounds the depth best: what holds at any time
  double depth = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tolerance::expand_iterations; ++i) {
    best = *std::ranges::min_element(hull.faces, {}, &Face::offset);
    // The face looks out of b - a along its normal; from a to b is the other way.
    const Vertex next = difference.support(-best.normal);
    const double reached = best.normal.dot(next.w);
    if (reached < depth) depth = reached, kept = best;
    if (reached - best.offset <= tolerance::expand_gain * scale) {
      out.capped = false;
      break;
    }
    scale = std::max(scale, next.w.norm());
    const double slack = 0.5 * tolerance::expand_gain * scale;
    // A sound hull has fewer than twice as many faces as points. More of them means that rounding
    // tore it (points on a flat end): going on would double them each time.
    if (hull.faces.size() > 4 * static_cast<std::size_t>(tolerance::expand_iterations)) break;
    if (!hull.add_point(next, slack) || hull.faces.empty()) break;  // flat to rounding: no way on
  }
  out.normal = -kept.normal;
  out.distance = -depth;
  witness(hull, kept, out);
  return out;
}

}  // namespace carom::detail
