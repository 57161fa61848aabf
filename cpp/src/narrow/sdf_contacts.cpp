// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "carom/geometry/sdf.hpp"
#include "carom/geometry/separation.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/candidates.hpp"
#include "narrow/routines.hpp"
#include "narrow/support_face.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
thread_local std::vector<Candidate> found;

/// Point of the other body with the gap to the grid's surface there. Seen from the grid, which is
/// a.
struct Touch {
  Vector3d x = Vector3d::Zero(), normal = Vector3d::UnitZ();
  double gap = std::numeric_limits<double>::infinity();
};

Touch touch(const SdfGrid& grid, const Vector3d& x, double radius = 0) {
  Touch t;
  Vector3d g;
  t.gap = grid.sample(x, g) - radius;
  t.x = x;
  // No gradient, no direction: on a ridge inside the body. The way from its middle is as good.
  t.normal = g.norm() > tolerance::sdf_gradient ? g : Vector3d(x - grid.box().centre());
  t.normal = t.normal.norm() > 0 ? Vector3d(t.normal.normalized()) : Vector3d(Vector3d::UnitZ());
  return t;
}

void add(const Touch& t, double radius, std::uint32_t name) {
  found.push_back(
      {t.normal,
       {t.x - (radius + 0.5 * t.gap) * t.normal, t.gap, feature::pair(feature::curve(0), name)}});
}

/// From a first touch to the nearest pair: to and fro between the other body and the level of the
/// grid that lies just clear of it. On the level the overlap is a gap, and projections between two
/// sets that are apart come to rest at their nearest points.
template <class Closest>
Touch settle(const SdfGrid& grid, Touch t, const Closest& closest) {
  const double level = std::min(t.gap, 0.0) - grid.spacing;
  for (int i = 0; i < tolerance::projections; ++i) {
    const Touch next = touch(grid, closest(Vector3d(t.x - (t.gap - level) * t.normal)));
    const double moved = (next.x - t.x).norm();
    if (!(next.gap <= t.gap + tolerance::sdf_settled * grid.spacing)) break;
    t = next;
    if (moved <= tolerance::sdf_settled * grid.spacing) break;
  }
  return t;
}

/// Vertices of the zero level within `margin` of a box, by their gap to the other body.
template <class Gap>
Vector3d nearest_vertex(const SdfGrid& grid, const Aabb& near, const Gap& gap, double& least) {
  Vector3d best = Vector3d::Zero();
  least = std::numeric_limits<double>::infinity();
  grid.surface->tree.query([&](const Aabb& box) { return box.overlaps(near); },
                           [&](int f) {
                             const Vector3d v = grid.surface->corner(f, 0);
                             if (const double d = gap(v); d < least) least = d, best = v;
                           });
  return best;
}

/// Where one body holds the other's whole surface within it, no point of a surface overlaps. A way
/// out all the same: along the axes of both and the line of their centres, the one that parts them
/// soonest.
/// @param lowest  point of the core of b lowest along a direction
template <class Lowest>
void part(const SdfGrid& a, const Frame& b_in_a, const Vector3d& centre_b, double radius,
          const Lowest& lowest) {
  const auto& vertices = a.surface->mesh.vertices;
  Touch best;
  best.gap = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vector3d& n) {
    const Vector3d x = lowest(n);
    const double gap = n.dot(x) - radius - (vertices * n).maxCoeff();
    if (gap > best.gap) best = {x, n, gap};
  };
  for (int i = 0; i < 3; ++i)
    for (const double sign : {1.0, -1.0}) {
      consider(sign * Vector3d::Unit(i));
      consider(sign * b_in_a.rotation.col(i));
    }
  const Vector3d across = centre_b - a.surface->tree.nodes[0].box.centre();
  if (across.norm() > tolerance::sdf_settled * a.spacing) consider(across.normalized());
  add(best, radius, feature::curve(2));
}

Vector3d lowest_vertex(const MeshSurface& surface, const Frame& frame, const Vector3d& n) {
  Eigen::Index row;
  (surface.mesh.vertices * (frame.rotation.transpose() * n)).minCoeff(&row);
  return frame * Vector3d(surface.mesh.vertices.row(row).transpose());
}

Aabb bounds_of(const Convex& body, const Frame& frame) {
  Aabb box;
  for (int i = 0; i < 3; ++i)
    for (double sign : {-1.0, 1.0}) {
      const Vector3d d = sign * frame.rotation.row(i).transpose();
      (sign < 0 ? box.lower : box.upper)[i] = (frame * body.support(d))[i];
    }
  return box.inflated(body.radius);
}

}  // namespace

void sdf_convex(const SdfGrid& a, const Convex& b, const Frame& b_in_a, double margin,
                std::vector<Manifold>& out) {
  found.clear();
  const Aabb near = bounds_of(b, b_in_a);
  if (!near.inflated(margin).overlaps(a.surface->tree.nodes[0].box)) return;
  const auto gap_to = [&](const Vector3d& q) {
    return separation(Convex::point(q), b, b_in_a, std::numeric_limits<double>::infinity());
  };
  const auto closest = [&](const Vector3d& q) {
    const Separation s = gap_to(q);
    return Vector3d(s.point_b + b.radius * s.normal);  // of the core
  };
  Touch best = touch(a, b_in_a * b.support(-(b_in_a.rotation.transpose() * b_in_a.translation)));
  const auto offer = [&](const Vector3d& x, std::uint32_t name) {
    const Touch t = touch(a, x);
    if (t.gap < best.gap) best = t;
    if (name != 0 && t.gap - b.radius <= margin) {
      Touch grown = t;
      grown.gap -= b.radius;
      add(grown, b.radius, name);
    }
  };
  int number = 0;
  if (b.kind == Convex::Kind::box)
    for (int i = 0; i < 8; ++i)
      offer(b_in_a * Vector3d(i & 1 ? b.size.x() : -b.size.x(), i & 2 ? b.size.y() : -b.size.y(),
                              i & 4 ? b.size.z() : -b.size.z()),
            feature::vertex(++number));
  for (const Vector3d& c : b.corners()) offer(b_in_a * c, feature::vertex(++number));
  for (int i = 0; i < 27; ++i) {
    const Vector3d d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (i != 13) offer(b_in_a * b.support(d), 0);
  }
  // A ball needs no more than its centre; others may meet the grid between their corners.
  const bool ball = b.kind == Convex::Kind::points && b.corners().size() == 1;
  double least = std::numeric_limits<double>::infinity();
  if (!ball) {
    const Vector3d v = nearest_vertex(
        a, near.inflated(margin), [&](const Vector3d& q) { return gap_to(q).distance; }, least);
    if (least < std::numeric_limits<double>::infinity()) offer(closest(v), 0);
    best = settle(a, best, closest);
    if (best.gap - b.radius <= margin) {
      thread_local Face patch;
      support_face(b, -(b_in_a.rotation.transpose() * best.normal), b_in_a, patch);
      if (patch.points.size() > 2 && !b.is_polyhedral())
        for (std::size_t i = 0; i < patch.points.size(); ++i)
          offer(patch.points[i] + b.radius * best.normal, patch.vertex_features[i]);
      best.gap -= b.radius;
      add(best, b.radius, feature::curve(1));
    }
  }
  if (found.empty() && least < 0)
    part(a, b_in_a, b_in_a.translation, b.radius, [&](const Vector3d& n) {
      return Vector3d(b_in_a * b.support(-(b_in_a.rotation.transpose() * n)));
    });
  emit(found, tolerance::similar_normal, out);
}

void sdf_surface(const SdfGrid& a, const MeshSurface& b, const Frame& b_in_a, double margin,
                 std::vector<Manifold>& out) {
  found.clear();
  const Frame a_in_b = b_in_a.inverse();
  const Aabb reach = a.surface->tree.nodes[0].box.inflated(margin);
  const Vector3d half = 0.5 * a_in_b.rotation.cwiseAbs() * reach.extents();
  const Vector3d centre = a_in_b * reach.centre();
  const Aabb near_b{centre - half, centre + half};
  Touch best;
  thread_local std::vector<int> vertices;
  vertices.clear();
  b.tree.query([&](const Aabb& box) { return box.overlaps(near_b); },
               [&](int f) {
                 for (int k = 0; k < 3; ++k) vertices.push_back(b.mesh.faces(f, k));
               });
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (int v : vertices) {
    const Touch t = touch(a, b_in_a * b.vertex(v));
    if (t.gap < best.gap) best = t;
    if (t.gap <= margin && b.vertex_sharp[v]) add(t, 0, feature::vertex(v));
  }
  const double inf = std::numeric_limits<double>::infinity();
  const Aabb& all_b = b.tree.nodes[0].box;
  const Vector3d half_b = 0.5 * b_in_a.rotation.cwiseAbs() * all_b.extents();
  const Vector3d centre_b = b_in_a * all_b.centre();
  double least;
  const Vector3d q = nearest_vertex(
      a, Aabb{centre_b - half_b, centre_b + half_b}.inflated(margin),
      [&](const Vector3d& x) { return closest_point(b, a_in_b * x, inf).distance; }, least);
  const auto closest = [&](const Vector3d& x) {
    return Vector3d(b_in_a * closest_point(b, a_in_b * x, inf).point);
  };
  if (least < inf)
    if (const Touch t = touch(a, closest(q)); t.gap < best.gap) best = t;
  if (best.gap < inf) {
    best = settle(a, best, closest);
    if (best.gap <= margin) add(best, 0, feature::curve(1));
  }
  if (found.empty() && least < 0 && b.faults.closed())
    part(a, b_in_a, centre_b, 0, [&](const Vector3d& n) { return lowest_vertex(b, b_in_a, n); });
  emit(found, tolerance::similar_normal, out);
}

void sdf_sdf(const SdfGrid& a, const SdfGrid& b, const Frame& b_in_a, double margin,
             std::vector<Manifold>& out) {
  found.clear();
  const Frame a_in_b = b_in_a.inverse();
  const Aabb& box_b = b.surface->tree.nodes[0].box;
  const Vector3d half = 0.5 * b_in_a.rotation.cwiseAbs() * box_b.extents();
  const Vector3d centre = b_in_a * box_b.centre();
  const Aabb near{centre - half, centre + half};
  Vector3d unused;
  double least;
  const Vector3d q = nearest_vertex(
      a, near.inflated(margin), [&](const Vector3d& x) { return b.sample(a_in_b * x, unused); },
      least);
  if (!(least < std::numeric_limits<double>::infinity())) return;
  const auto closest = [&](const Vector3d& x) {
    Vector3d y = a_in_b * x;
    for (int i = 0; i < 3; ++i) {
      const Touch t = touch(b, y);
      y -= t.gap * t.normal;
    }
    return Vector3d(b_in_a * y);
  };
  const Touch best = settle(a, touch(a, closest(q)), closest);
  if (best.gap <= margin) add(best, 0, feature::curve(1));
  if (best.gap > -a.spacing && a.sample(centre, unused) < -a.spacing) {
    found.clear();  // surfaces that lie in one another, or within
    part(a, b_in_a, centre, 0,
         [&](const Vector3d& n) { return lowest_vertex(*b.surface, b_in_a, n); });
  }
  emit(found, tolerance::similar_normal, out);
}

void half_space_sdf(const Vector3d& normal, double offset, const SdfGrid& b, const Frame& b_in_a,
                    double margin, std::vector<Manifold>& out) {
  found.clear();
  const Vector3d n = b_in_a.rotation.transpose() * normal;  // in the grid
  const double level = offset - normal.dot(b_in_a.translation);
  double least = std::numeric_limits<double>::infinity();
  Vector3d lowest = Vector3d::Zero();
  const auto& s = *b.surface;
  for (Eigen::Index v = 0; v < s.mesh.vertices.rows(); ++v) {
    const Vector3d x = s.mesh.vertices.row(v).transpose();
    const double gap = n.dot(x) - level;
    if (gap < least) least = gap, lowest = x;
    if (gap <= margin && gap <= b.spacing)
      found.push_back({n,
                       {x - 0.5 * gap * n, gap,
                        feature::pair(feature::face(0), feature::vertex(static_cast<int>(v)))}});
  }
  if (least > margin + b.spacing) {
    found.clear();
    return;
  }
  const auto closest = [&](const Vector3d& x) { return Vector3d(x - (n.dot(x) - level) * n); };
  const Touch t = settle(b, touch(b, closest(lowest)), closest);
  if (t.gap <= margin && t.normal.dot(-n) > tolerance::facing)
    found.push_back({n,
                     {t.x - 0.5 * t.gap * t.normal, t.gap,
                      feature::pair(feature::face(0), feature::curve(1))}});
  const std::size_t begin = out.size();
  emit(found, tolerance::same_normal, out);
  for (std::size_t i = begin; i < out.size(); ++i) {  // worked out in the grid's frame
    out[i].normal = normal;
    for (int k = 0; k < out[i].count; ++k)
      out[i].points[k].position = b_in_a * out[i].points[k].position;
  }
}

}  // namespace carom
