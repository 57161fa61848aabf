// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "carom/geometry/separation.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "geometry/plain_nodes.hpp"
#include "narrow/bounds.hpp"
#include "narrow/candidates.hpp"
#include "narrow/normal_cone.hpp"
#include "narrow/routines.hpp"
#include "narrow/support_face.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

/// A curved body in the frame of a surface.
struct Test {
  const Convex& body;
  const Frame& frame;  // of the body, in the surface
  const MeshSurface& surface;
  double margin, range;
  std::vector<Candidate>& out;

  Vector3d to_body(const Vector3d& direction) const {
    return frame.rotation.transpose() * direction;
  }
  /// A point of the core, if the surface nearest to it faces along n; or if it lies in front of the
  /// face and its foot on it, as in a corner, where several faces are about equally near.
  bool hold(int f, const Vector3d& core_point, const Vector3d& n, std::uint32_t name) const {
    const double reach = margin + body.radius + range;
    SurfacePoint q = closest_point(surface, core_point, reach);
    if (q.face < 0) return false;
    if ((q.normal - n).norm() > tolerance::flat_bend) {
      const double height = n.dot(core_point - surface.corner(f, 0));
      if (!(height > 0)) return false;
      const Vector3d foot = core_point - height * n;
      q = closest_point(surface, foot, reach);
      const double rounding = tolerance::inside_polygon * (height + foot.norm());
      if (q.face < 0 || std::abs(q.distance) > rounding) return false;
      if ((q.normal - n).norm() > tolerance::flat_bend) return false;
      q.distance = height;
    }
    const double gap = q.distance - body.radius;
    if (gap <= margin)
      out.push_back({n,
                     {core_point - (body.radius + 0.5 * gap) * q.normal, gap,
                      feature::pair(q.feature, name)}});
    return true;
  }
  void face(int f) const {
    thread_local Face patch;
    const Vector3d& n = surface.face_normals[f];
    const Vector3d down = -to_body(n), tip = frame * body.support(down);
    const double gap = n.dot(tip - surface.corner(f, 0)) - body.radius;
    if (gap > margin || gap < -range) return;
    hold(f, tip, n, feature::curve(6));
    support_face(body, down, frame, patch);
    for (std::size_t i = 0; i < patch.points.size() && patch.points.size() > 1; ++i)
      hold(f, patch.points[i] + body.radius * n, n, patch.vertex_features[i]);
  }
  /// Where the body lies deepest over an edge: of all directions between the normals of its faces
  /// the one of the largest gap. Beyond it the body reaches farther down on the one side, before it
  /// on the other. No way out to a side that the faces bar, as a thin body over an edge would find.
  void edge(int e) const {
    const auto& edge = surface.edges[e];
    if (edge.f1 < 0) return rim(e);
    const Vector3d p = surface.vertex(edge.v0), pq = surface.vertex(edge.v1) - p;
    const double length = pq.norm();
    const Vector3d &n0 = surface.face_normals[edge.f0], &n1 = surface.face_normals[edge.f1];
    const Vector3d across = -edge.inward0;  // from the first normal towards the second
    struct Way {
      Vector3d n, tip;
      double slope;  // of the gap, as the direction turns
    };
    const auto towards = [&](double angle) {
      const double c = std::cos(angle), s = std::sin(angle);
      const Vector3d n = c * n0 + s * across, turned = c * across - s * n0;
      const Vector3d tip = frame * body.support(-to_body(n));
      return Way{n, tip, turned.dot(tip - p)};
    };
    double from = 0, to = std::atan2(std::max(n1.dot(across), 0.0), n1.dot(n0));
    Way low = towards(from), high = towards(to);
    if (!(low.slope > 0) || !(high.slope < 0)) return;  // a face has it
    while (to - from > tolerance::same_direction) {
      const double middle = 0.5 * (from + to);
      const Way way = towards(middle);
      (way.slope > 0 ? low : high) = way;
      (way.slope > 0 ? from : to) = middle;
    }
    const Vector3d& n = low.n;
    const double share = low.slope / (low.slope - high.slope);
    const Vector3d x = low.tip + share * (high.tip - low.tip);
    const double gap = n.dot(x - p) - body.radius;
    if (gap > margin || gap < -range) return;
    const auto at = [&](const Vector3d& point, std::uint32_t name) {
      out.push_back(
          {n, {point - (body.radius + 0.5 * gap) * n, gap, feature::pair(feature::edge(e), name)}});
    };
    // A side along the edge has two points where both are; anything else crosses it at one.
    thread_local Face side;
    support_face(body, -to_body(n), frame, side);
    const Vector3d u = pq / length;
    if (side.points.size() > 1) {
      const Vector3d way = side.points[1] - side.points[0];
      const bool along = u.cross(way).norm() <= tolerance::normal_cone * way.norm();
      if (along) {
        double ends[2] = {u.dot(side.points[0] - p), u.dot(side.points[1] - p)};
        if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
        const double first = std::max(ends[0], 0.0), last = std::min(ends[1], length);
        if (first > last) return;
        at(x + (first - u.dot(x - p)) * u, feature::curve(5));
        return at(x + (last - u.dot(x - p)) * u, feature::curve(7));
      }
    }
    const double t = u.dot(x - p) / length;
    if (t > tolerance::normal_cone && t < 1 - tolerance::normal_cone) at(x, feature::curve(5));
  }
  /// An edge of one face: nothing bars the way but the body of the face.
  void rim(int e) const {
    const auto& edge = surface.edges[e];
    const Vector3d p = surface.vertex(edge.v0), q = surface.vertex(edge.v1);
    const Convex segment = Convex::segment(p, q);
    const Separation s = separation(segment, body, frame, margin);
    if (s.status == SeparationStatus::beyond || s.distance > margin || s.distance < -range) return;
    if (!in_cone_of_edge(surface, e, s.normal)) return;
    const double t = (s.point_a - p).dot(q - p) / (q - p).squaredNorm();
    // At its ends a corner decides, unless the body lies along the edge: one of the closest pairs
    // is then given, be it at an end.
    const bool inside = t > tolerance::normal_cone && t < 1 - tolerance::normal_cone;
    const bool along = std::abs(s.normal.dot((q - p).normalized())) <= tolerance::normal_cone;
    if (!inside && !along) return;
    add(s, feature::edge(e));
  }
  void vertex(int v) const {
    const Separation s = separation(Convex::point(surface.vertex(v)), body, frame, margin);
    if (s.status == SeparationStatus::beyond || s.distance > margin || s.distance < -range) return;
    if (in_cone_of_vertex(surface, v, s.normal)) add(s, feature::vertex(v));
  }
  void add(const Separation& s, std::uint32_t of_surface) const {
    out.push_back({s.normal,
                   {0.5 * (s.point_a + s.point_b), s.distance,
                    feature::pair(of_surface, feature::curve(5))}});
  }
};

}  // namespace

void surface_convex(const MeshSurface& a, const Convex& b, const Frame& b_in_a, double margin,
                    std::vector<Manifold>& out) {
  thread_local std::vector<Candidate> found;
  thread_local std::vector<int> faces, edges, vertices;
  found.clear();
  for (auto* list : {&faces, &edges, &vertices}) list->clear();
  const Aabb box = bounds_of(b, b_in_a);
  const Aabb region = box.inflated(margin);
  if (const int f = lone_plane(a, region); f >= 0) {
    const Vector3d& n = a.face_normals[f];
    return half_space_convex(n, n.dot(a.corner(f, 0)), b, b_in_a, margin, out);
  }
  a.tree.query([&](const Aabb& node) { return node.overlaps(region); },
               [&](int f) {
                 if (a.face_normals[f].isZero(0)) return;
                 faces.push_back(a.face_cluster[f]);
                 for (int k = 0; k < 3; ++k) {
                   const int e = a.face_edges[f][k];
                   if (e >= 0 && a.edges[e].bend == MeshSurface::Bend::convex) edges.push_back(e);
                   if (const int v = a.mesh.faces(f, k); a.vertex_sharp[v]) vertices.push_back(v);
                 }
               });
  for (auto* list : {&faces, &edges, &vertices}) {
    std::ranges::sort(*list);
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  const auto look = [&](double range) {
    const Test test{b, b_in_a, a, margin, range, found};
    for (int f : faces) test.face(f);
    for (int e : edges) {
      const auto& edge = a.edges[e];
      const Vector3d p = a.vertex(edge.v0), q = a.vertex(edge.v1);
      if (region.overlaps({p.cwiseMin(q), p.cwiseMax(q)})) test.edge(e);
    }
    for (int v : vertices)
      if (squared_distance(box, a.vertex(v)) <= margin * margin) test.vertex(v);
  };
  look(0.5 * box.extents().minCoeff());
  if (found.empty()) look(box.extents().norm());  // a needle on end is deeper than it is thick
  if (found.empty()) {  // deeper than any local way out: the middle of the body decides
    const Vector3d centre = b_in_a.translation;
    const SurfacePoint q = closest_point(a, centre, std::numeric_limits<double>::infinity());
    if (q.face >= 0 && q.distance < 0) {
      const Vector3d tip = b_in_a * b.support(-(b_in_a.rotation.transpose() * q.normal));
      const double gap = q.distance + q.normal.dot(tip - centre) - b.radius;
      found.push_back({q.normal,
                       {centre - 0.5 * q.distance * q.normal, gap,
                        feature::pair(q.feature, feature::curve(4))}});
    }
  }
  emit(found, tolerance::same_normal, out);
}

}  // namespace carom
