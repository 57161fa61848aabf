// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "carom/geometry/triangle.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "geometry/plain_nodes.hpp"
#include "narrow/bounds.hpp"
#include "narrow/candidates.hpp"
#include "narrow/normal_cone.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

using Bend = MeshSurface::Bend;
using Eigen::Vector3d;

/// Vertices and convex edges of one surface that may lie near the other, each once.
struct Near {
  std::vector<int> vertices, edges;

  void gather(const MeshSurface& s, const Aabb& region) {
    vertices.clear();
    edges.clear();
    s.tree.query([&](const Aabb& box) { return box.overlaps(region); },
                 [&](int f) {
                   for (int k = 0; k < 3; ++k) {
                     if (const int v = s.mesh.faces(f, k); s.vertex_sharp[v]) vertices.push_back(v);
                     const int e = s.face_edges[f][k];
                     if (e >= 0 && s.edges[e].bend == Bend::convex) edges.push_back(e);
                   }
                 });
    for (auto* list : {&vertices, &edges}) {
      std::ranges::sort(*list);
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
  }
};

Aabb intersection(const Aabb& a, const Aabb& b) {
  return {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)};
}

bool on_face(const MeshSurface& s, int f, const Vector3d& point) {
  const Vector3d p = s.corner(f, 0), q = s.corner(f, 1), r = s.corner(f, 2);
  const double size = (q - p).norm() + (r - p).norm();
  return (closest_point(point, p, q, r).point - point).norm() <= tolerance::inside_polygon * size;
}

/// The shallowest way out of t at x, within `range`, that leads away from the body of vertex v.
/// Asked where the nearest way does not: flush with a side wall, the wall is nearest but the top
/// holds.
SurfacePoint way_out(const MeshSurface& s, int v, const Frame& s_in_t, const MeshSurface& t,
                     const Vector3d& x, double margin, double range) {
  SurfacePoint best;
  best.distance = -range;
  t.tree.query([&](const Aabb& box) { return squared_distance(box, x) <= range * range; },
               [&](int f) {
                 const Vector3d& n = t.face_normals[f];
                 const Vector3d origin = t.corner(f, 0);
                 const double height = n.dot(x - origin);
                 if (n.isZero(0) || height > margin || height <= best.distance) return;
                 const Vector3d foot = x - height * n;
                 if (!on_face(t, f, foot)) return;
                 if (!in_cone_of_vertex(s, v, -(s_in_t.rotation.transpose() * n))) return;
                 best = {f, height, foot, n, feature::face(t.face_cluster[f])};
               });
  return best;
}

/// Vertices of `s` (at s_in_t) against the surface `t`, t_is_a telling which way normals run.
struct VertexTest {
  const MeshSurface &s, &t;
  const Frame& s_in_t;
  bool t_is_a;
  double margin, reach, range;

  void add(int v, const Vector3d& x, const SurfacePoint& q, std::vector<Candidate>& out) const {
    const std::uint32_t fs = feature::vertex(v);
    out.push_back({t_is_a ? q.normal : Vector3d(-q.normal),
                   {x - 0.5 * q.distance * q.normal, q.distance,
                    t_is_a ? feature::pair(q.feature, fs) : feature::pair(fs, q.feature)}});
  }
  bool has(const Vector3d& n, std::size_t begin, const std::vector<Candidate>& out) const {
    const Vector3d along = t_is_a ? n : Vector3d(-n);
    return std::any_of(
        out.begin() + static_cast<std::ptrdiff_t>(begin), out.end(),
        [&](const Candidate& c) { return (c.normal - along).norm() <= tolerance::flat_bend; });
  }
  /// Whether the body of the vertex lies on the far side of it, seen from a face.
  bool points_at(int v, const Vector3d& n) const {
    return in_cone_of_vertex(s, v, -(s_in_t.rotation.transpose() * n), tolerance::similar_normal);
  }
  /// Calls hold(face, height, normal) for what the vertex at x may meet within `far`.
  template <class Hold>
  void faces_near(const Vector3d& x, double far, const Hold& hold) const {
    t.tree.query([&](const Aabb& box) { return squared_distance(box, x) <= far * far; },
                 [&](int f) {
                   const Vector3d& n = t.face_normals[t.face_cluster[f]];
                   const double height = n.dot(x - t.corner(f, 0));
                   if (!n.isZero(0)) hold(f, height, n);
                 });
  }
  /// Whether x lies over the face, or beside it past a crease: there its plane goes on behind the
  /// next face, and what crosses that face's end would cross the plane too.
  bool over(int f, const Vector3d& x) const {
    const auto concave = [&](int k) {
      const int e = t.face_edges[f][k % 3];
      return e >= 0 && t.edges[e].bend == Bend::concave;
    };
    const TrianglePoint near = closest_point(x, t.corner(f, 0), t.corner(f, 1), t.corner(f, 2));
    if (near.feature == TriangleFeature::face) return true;
    const int edge = static_cast<int>(near.feature) - static_cast<int>(TriangleFeature::edge0);
    if (edge >= 0) return concave(edge);
    const int corner = static_cast<int>(near.feature);  // the edge before it ends there
    return concave(corner) && concave(corner + 2);
  }
  /// Behind a crease the nearest point is the crease itself, and one contact towards it would let
  /// the vertex slide on through either face: each that it is behind holds it.
  bool crease(int v, const Vector3d& x, const SurfacePoint& q, std::vector<Candidate>& out) const {
    if (!(q.distance < 0) || q.feature == feature::face(t.face_cluster[q.face])) return false;
    const std::size_t begin = out.size();
    faces_near(
        x, -q.distance * (1 + tolerance::inside_polygon),
        [&](int f, double height, const Vector3d& n) {
          if (!(height < 0) || !on_face(t, f, q.point) || !points_at(v, n) || has(n, begin, out))
            return;
          add(v, x, {f, height, x - height * n, n, feature::face(t.face_cluster[f])}, out);
        });
    return out.size() > begin;
  }
  /// Where a surface bends towards the vertex, as a corner does, faces farther off than the nearest
  /// are met in the same step. Those it does not point at go to `spare`.
  void beside(int v, const Vector3d& x, std::size_t begin, std::vector<Candidate>& out,
              std::vector<Candidate>& spare) const {
    if (t.polytope) return;
    faces_near(x, margin, [&](int f, double height, const Vector3d& n) {
      if (!(height > 0 && height <= margin) || !over(f, x) || has(n, begin, out)) return;
      add(v, x, {f, height, x - height * n, n, feature::face(t.face_cluster[f])},
          points_at(v, n) ? out : spare);
    });
  }
  /// A face that no vertex points at, as one that points at it lies beside it, is met by the
  /// nearest of those that lie above it.
  void take_spare(std::vector<Candidate>& spare, std::size_t begin,
                  std::vector<Candidate>& out) const {
    std::ranges::sort(spare, {}, [](const Candidate& c) { return c.point.separation; });
    for (const Candidate& c : spare)
      if (!has(t_is_a ? c.normal : Vector3d(-c.normal), begin, out)) out.push_back(c);
  }
  void run(const std::vector<int>& vertices, std::vector<Candidate>& out) const {
    thread_local std::vector<Candidate> spare;
    spare.clear();
    const std::size_t first = out.size();
    for (int v : vertices) {
      const Vector3d x = s_in_t * s.vertex(v);
      if (squared_distance(t.tree.nodes[0].box, x) > margin * margin) continue;
      SurfacePoint q = closest_point(t, x, reach);
      if (q.face < 0 || q.distance > margin) continue;
      const std::size_t begin = out.size();
      if (crease(v, x, q, out)) {
        beside(v, x, begin, out, spare);
        continue;
      }
      // Faces that bend a little are one plane, whose points share a manifold.
      if (q.feature == feature::face(t.face_cluster[q.face]))
        q.normal = t.face_normals[t.face_cluster[q.face]];
      // Its own body must lie on the far side, or it is the back of a thin body showing through.
      // All corners of a face that is nearly level count: they carry the patch.
      if (!points_at(v, q.normal)) q = way_out(s, v, s_in_t, t, x, margin, range);
      if (q.face >= 0) add(v, x, q, out);
      beside(v, x, begin, out, spare);
    }
    take_spare(spare, first, out);
  }
  /// The vertex deepest inside, whatever way its body lies.
  void deepest(const std::vector<int>& vertices, std::vector<Candidate>& out) const {
    int best = -1;
    Vector3d best_x = Vector3d::Zero();
    SurfacePoint best_q;
    for (int v : vertices) {
      const Vector3d x = s_in_t * s.vertex(v);
      const SurfacePoint q = closest_point(t, x, reach);
      if (q.face >= 0 && q.distance < best_q.distance) best = v, best_q = q, best_x = x;
    }
    if (best >= 0) add(best, best_x, best_q, out);
  }
};

/// Share of the thinner body up to which an overlap counts as shallow, its ways out as local.
constexpr double shallow_share = 0.25;

double thickness(const MeshSurface& s) {
  const Vector3d extents = s.tree.nodes[0].box.extents();
  return s.faults.closed() ? extents.minCoeff() : extents.maxCoeff();
}

void edges_against(const MeshSurface& a, const std::vector<int>& edges_a, const MeshSurface& b,
                   const std::vector<int>& edges_b, const Frame& b_in_a, double margin,
                   double deepest, double range, std::vector<Candidate>& out) {
  struct Segment {
    Vector3d p, q;
  };
  thread_local std::vector<Segment> moved_b;
  moved_b.clear();
  for (int j : edges_b)
    moved_b.push_back({b_in_a * b.vertex(b.edges[j].v0), b_in_a * b.vertex(b.edges[j].v1)});
  const std::size_t begin = out.size();
  const double limit = deepest > 0 ? deepest * (1 + tolerance::normal_cone) : range;
  for (int i : edges_a) {
    const auto& e = a.edges[i];
    const Vector3d p = a.vertex(e.v0), q = a.vertex(e.v1), along = q - p;
    const Aabb box = Aabb{p.cwiseMin(q), p.cwiseMax(q)}.inflated(std::max(margin, limit));
    for (std::size_t k = 0; k < moved_b.size(); ++k) {
      const auto& [r, s] = moved_b[k];
      if (!box.overlaps({r.cwiseMin(s), r.cwiseMax(s)})) continue;
      const Vector3d other = s - r;
      Vector3d n = along.cross(other);
      const double length = n.norm();
      if (length <= tolerance::parallel_edges * along.norm() * other.norm()) continue;
      n /= n.dot(e.normal) < 0 ? -length : length;
      if (!in_cone_of_edge(a, i, n) ||
          !in_cone_of_edge(b, edges_b[k], -(b_in_a.rotation.transpose() * n)))
        continue;
      const SegmentPoints c = closest_points(p, q, r, s);
      if (!(c.s > 0 && c.s < 1 && c.t > 0 && c.t < 1)) continue;
      const double gap = n.dot(c.q - c.p);
      if (gap > margin || -gap > limit) continue;
      out.push_back(
          {n,
           {0.5 * (c.p + c.q), gap, feature::pair(feature::edge(i), feature::edge(edges_b[k]))}});
    }
  }
  if (deepest > 0) return;
  // No vertex is inside: only crossings of edges overlap. Of those, a real one is shallow next to
  // the far sides of the same bodies that pass the cone test too.
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = begin; i < out.size(); ++i)
    if (out[i].point.separation < 0) least = std::min(least, -out[i].point.separation);
  std::erase_if(out, [&](const Candidate& c) { return -c.point.separation > 2 * least; });
}

}  // namespace

namespace {

/// Within reach of the other, one of the two is a single plane without an edge: as a half-space.
bool one_is_a_plane(const MeshSurface& a, const MeshSurface& b, const Frame& b_in_a,
                    const Frame& a_in_b, const Aabb& in_a, const Aabb& in_b, double margin,
                    std::vector<Manifold>& out) {
  if (const int f = lone_plane(a, in_a); f >= 0) {
    const Vector3d& n = a.face_normals[f];
    half_space_surface(n, n.dot(a.corner(f, 0)), b, b_in_a, margin, out);
    return true;
  }
  const int f = lone_plane(b, in_b);
  if (f < 0) return false;
  const Vector3d& n = b.face_normals[f];
  const std::size_t begin = out.size();
  half_space_surface(n, n.dot(b.corner(f, 0)), a, a_in_b, margin, out);
  for (std::size_t i = begin; i < out.size(); ++i) {
    out[i].normal = -(b_in_a.rotation * out[i].normal);
    for (int k = 0; k < out[i].count; ++k)
      out[i].points[k].position = b_in_a * out[i].points[k].position;
  }
  return true;
}

}  // namespace

void surface_surface(const MeshSurface& a, const MeshSurface& b, const Frame& b_in_a, double margin,
                     std::vector<Manifold>& out) {
  thread_local Near near_a, near_b;
  thread_local std::vector<Candidate> found;
  const Aabb& box_a = a.tree.nodes[0].box;
  const Aabb& box_b = b.tree.nodes[0].box;
  const Frame a_in_b = b_in_a.inverse();
  const Aabb in_a = intersection(box_a, moved(box_b, b_in_a)).inflated(margin);
  const Aabb in_b = intersection(box_b, moved(box_a, a_in_b)).inflated(margin);
  if (in_a.empty() || in_b.empty()) return;
  if (one_is_a_plane(a, b, b_in_a, a_in_b, in_a, in_b, margin, out)) return;
  near_a.gather(a, in_a);
  near_b.gather(b, in_b);
  const double reach = in_a.extents().norm();  // no overlap is deeper than what both boxes share
  // A sheet has no far side that a deep way out might lead to.
  const double share = a.faults.closed() && b.faults.closed() ? shallow_share : 1.0;
  const double range = std::max(margin, share * std::min(thickness(a), thickness(b)));

  found.clear();
  const VertexTest of_b{b, a, b_in_a, true, margin, reach, range};
  const VertexTest of_a{a, b, a_in_b, false, margin, reach, range};
  const auto to_a = [&](std::size_t first) {  // what came in the frame of b
    for (std::size_t i = first; i < found.size(); ++i) {
      found[i].normal = b_in_a.rotation * found[i].normal;
      found[i].point.position = b_in_a * found[i].point.position;
    }
  };
  of_b.run(near_b.vertices, found);
  std::size_t middle = found.size();
  of_a.run(near_a.vertices, found);
  to_a(middle);
  double deepest = 0;
  for (const Candidate& c : found) deepest = std::max(deepest, -c.point.separation);
  edges_against(a, near_a.edges, b, near_b.edges, b_in_a, margin, deepest, range, found);
  if (found.empty()) {  // deep inside one another: the way out of the deepest vertices
    of_b.deepest(near_b.vertices, found);
    middle = found.size();
    of_a.deepest(near_a.vertices, found);
    to_a(middle);
  }
  emit(found, tolerance::same_normal, out);
}

}  // namespace carom
