// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "carom/geometry/sdf.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "geometry/point_distance.hpp"
#include "narrow/candidates.hpp"
#include "narrow/routines.hpp"
#include "narrow/sdf_touch.hpp"
#include "narrow/sdf_vertices.hpp"
#include "narrow/support_face.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
thread_local std::vector<Candidate> found;
thread_local std::vector<NearVertex> near_vertices;

void add(const Touch& t, double radius, std::uint32_t name) {
  found.push_back(
      {t.normal,
       {t.x - (radius + 0.5 * t.gap) * t.normal, t.gap, feature::pair(feature::curve(0), name)}});
}

/// What the two searches found. Where they agree but for the error of the grid they are one point,
/// which changes from one to the other little by little; the overlap is that of the deeper.
/// @param on_other  a point of the other body, its distance to the grid
/// @param on_grid   a point of the zero level, its distance to the other body
void add_both(const Touch& on_other, const Touch& on_grid, double error, double margin) {
  Candidate one{on_other.normal,
                {on_other.x - 0.5 * on_other.gap * on_other.normal, on_other.gap,
                 feature::pair(feature::curve(0), feature::curve(1))}};
  Candidate two{-on_grid.normal,
                {on_grid.x - 0.5 * on_grid.gap * on_grid.normal, on_grid.gap,
                 feature::pair(feature::curve(0), feature::curve(3))}};
  const double between = on_grid.gap - on_other.gap;
  if (std::isfinite(between) && one.normal.dot(two.normal) > 0 &&
      one.normal.cross(two.normal).norm() < tolerance::similar_normal) {
    const double share = std::clamp(0.5 + 0.5 * between / error, 0.0, 1.0);
    one.normal = (share * one.normal + (1 - share) * two.normal).normalized();
    one.point.position = share * one.point.position + (1 - share) * two.point.position;
    one.point.separation = std::min(on_other.gap, on_grid.gap);
    two.point.separation = std::numeric_limits<double>::infinity();
  }
  for (const Candidate& c : {one, two})
    if (c.point.separation <= margin) found.push_back(c);
}

/// A body that bends, or lies flat, is carried at several places: where the level is nearer than
/// all about it, and by the vertices of the level that face the other body and are near it.
/// @param deepest  what is known: not given a second time
/// @param side     1: normals of candidates are those of `seen`, -1: against them
/// @param to_a     from the grid's frame to that of the candidates
template <class Seen>
void add_supports(const SdfGrid& grid, const Vector3d& deepest, const Seen& seen, double margin,
                  double side, const Frame& to_a) {
  thread_local std::vector<Vector3d> places;
  places.assign(1, deepest);
  const double apart = 2 * grid.spacing;
  const auto is_new = [&](const Vector3d& x) {
    return std::ranges::all_of(
        places, [&](const Vector3d& p) { return (p - x).squaredNorm() > apart * apart; });
  };
  const auto offer = [&](const Touch& t, double facing, int v) {
    if (t.gap > margin || -t.normal.dot(touch(grid, t.x).normal) < facing) return false;
    const Vector3d x = t.x - 0.5 * t.gap * t.normal;
    found.push_back({side * (to_a.rotation * t.normal),
                     {to_a * x, t.gap, feature::pair(feature::curve(0), feature::vertex(v))}});
    return true;
  };
  for (const NearVertex& n : near_vertices) {
    if (static_cast<int>(places.size()) > tolerance::sdf_supports) break;
    if (!n.least || !is_new(n.touch.x)) continue;
    const Touch t = settle_on_level(grid, n.touch.x, seen);
    if (is_new(t.x) && offer(t, tolerance::opposing, n.vertex)) places.push_back(t.x);
  }
  const double near = std::min(margin, grid.spacing);
  for (const NearVertex& n : near_vertices)
    if (n.touch.gap <= near && is_new(n.touch.x)) offer(n.touch, tolerance::facing, n.vertex);
}

double blur(const SdfGrid& grid) {
  return std::max(grid.error, tolerance::sdf_settled * grid.spacing);
}

Aabb moved(const Aabb& box, const Frame& frame) {
  const Vector3d half = 0.5 * frame.rotation.cwiseAbs() * box.extents();
  const Vector3d centre = frame * box.centre();
  return {centre - half, centre + half};
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

namespace {

/// A ball is its centre and its radius.
void sdf_ball(const SdfGrid& a, const Vector3d& centre, double radius, double margin) {
  Touch t = measured(a, touch(a, centre));
  t.gap -= radius;
  if (t.gap <= margin) add(t, radius, feature::vertex(1));
}

}  // namespace

void sdf_convex(const SdfGrid& a, const Convex& b, const Frame& b_in_a, double margin,
                std::vector<Manifold>& out) {
  found.clear();
  const Aabb near = bounds_of(b, b_in_a);
  if (!near.inflated(margin).overlaps(a.surface->tree.nodes[0].box)) return;
  if (b.kind == Convex::Kind::points && b.corners().size() == 1) {
    sdf_ball(a, b_in_a * b.corners()[0], b.radius, margin);
    return emit(found, tolerance::similar_normal, out);
  }
  const double inf = std::numeric_limits<double>::infinity();
  const auto apart = [&](const Vector3d& q) { return point_distance(b, b_in_a.to_local(q)); };
  // The least over all of b, not only its surface: a step inside is one down the field as well, and
  // is not thrown across to another side.
  const auto on_b = [&](Vector3d& q) {
    if (const PointDistance d = apart(q); d.distance > 0) q = b_in_a * d.point;
  };
  const auto seen_by_b = [&](const Vector3d& x) {
    const PointDistance d = apart(x);
    return Touch{x, b_in_a.rotation * d.normal, d.distance};
  };
  const auto grown = [&](const Vector3d& n) {  // lowest against a unit n
    return Vector3d(b_in_a * b.support(-(b_in_a.rotation.transpose() * n)) - b.radius * n);
  };
  Touch best;
  const auto offer = [&](const Vector3d& x, std::uint32_t name) {
    const Touch t = touch(a, x);
    if (t.gap < best.gap) best = t;
    if (name != 0 && t.gap <= margin) add(measured(a, t), 0, name);
  };
  // A corner of the core, moved out by the growth towards the grid.
  const auto corner = [&](const Vector3d& x, std::uint32_t name) {
    const Vector3d n =
        b.radius > 0 ? closest_point(*a.surface, x, inf).normal : Vector3d(Vector3d::Zero());
    offer(x - b.radius * n, name);
  };
  int number = 0;
  if (b.kind == Convex::Kind::box)
    for (int i = 0; i < 8; ++i)
      corner(b_in_a * Vector3d(i & 1 ? b.size.x() : -b.size.x(), i & 2 ? b.size.y() : -b.size.y(),
                               i & 4 ? b.size.z() : -b.size.z()),
             feature::vertex(++number));
  for (const Vector3d& c : b.corners()) corner(b_in_a * c, feature::vertex(++number));
  for (int i = 0; i < 27; ++i)
    if (i != 13) offer(grown(Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized()), 0);
  vertices_near(a, near.inflated(margin), margin, seen_by_b, near_vertices);
  const Touch nearest = near_vertices.empty() ? Touch{} : near_vertices[0].touch;
  if (nearest.gap < inf) offer(b_in_a * apart(nearest.x).point, 0);
  best = settle(a, best, on_b);
  best.gap = measured(a, best).gap;  // its gradient is square to the other body
  if (best.gap <= margin) {
    thread_local Face patch;
    support_face(b, -(b_in_a.rotation.transpose() * best.normal), b_in_a, patch);
    if (patch.points.size() > 2 && !b.is_polyhedral())
      for (std::size_t i = 0; i < patch.points.size(); ++i)
        offer(patch.points[i], patch.vertex_features[i]);
  }
  if (nearest.gap < inf) {
    const double off = 0.5 * a.box().extents().norm();
    const Touch level = settle_on_level_seen_from(off, a, nearest.x, seen_by_b);
    add_both(best, level, blur(a), margin);
    add_supports(a, level.x, seen_by_b, margin, -1, Frame{});
  } else {
    add_both(best, {}, blur(a), margin);
  }
  if (found.empty() && nearest.gap < 0)
    part(a, b_in_a, b_in_a.translation, b.radius, [&](const Vector3d& n) {
      return Vector3d(b_in_a * b.support(-(b_in_a.rotation.transpose() * n)));
    });
  emit(found, tolerance::similar_normal, out);
}

void sdf_surface(const SdfGrid& a, const MeshSurface& b, const Frame& b_in_a, double margin,
                 std::vector<Manifold>& out) {
  found.clear();
  const Frame a_in_b = b_in_a.inverse();
  const double inf = std::numeric_limits<double>::infinity();
  const Aabb near_b = moved(a.surface->tree.nodes[0].box.inflated(margin), a_in_b);
  const auto seen_by_b = [&](const Vector3d& x) {
    const SurfacePoint p = closest_point(b, a_in_b * x, inf);
    return Touch{x, b_in_a.rotation * p.normal, p.distance};
  };
  const bool solid = b.faults.closed();
  const auto on_b = [&](Vector3d& q) {
    const SurfacePoint p = closest_point(b, a_in_b * q, inf);
    if (!solid || p.distance > 0) q = b_in_a * p.point;
  };
  Touch best;
  thread_local std::vector<int> vertices;
  vertices.clear();
  Vector3d unused;
  b.tree.query(
      [&](const Aabb& box) {  // no corner in the box is nearer than its middle less its size
        return box.overlaps(near_b) &&
               a.sample(b_in_a * box.centre(), unused) - 0.5 * box.extents().norm() <=
                   margin + a.spacing;
      },
      [&](int f) {
        for (int k = 0; k < 3; ++k) vertices.push_back(b.mesh.faces(f, k));
      });
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (int v : vertices) {
    const Touch t = touch(a, b_in_a * b.vertex(v));
    if (t.gap < best.gap) best = t;
    if (t.gap <= margin && b.vertex_sharp[v]) add(measured(a, t), 0, feature::vertex(v));
  }
  const Aabb all_b = moved(b.tree.nodes[0].box, b_in_a);
  vertices_near(a, all_b.inflated(margin), margin, seen_by_b, near_vertices);
  const Touch nearest = near_vertices.empty() ? Touch{} : near_vertices[0].touch;
  Touch level;
  if (nearest.gap < inf) {
    const Vector3d q = b_in_a * closest_point(b, a_in_b * nearest.x, inf).point;
    if (const Touch t = touch(a, q); t.gap < best.gap) best = t;
    level = settle_on_level_seen_from(a.spacing, a, nearest.x, seen_by_b);
  }
  if (best.gap < inf) best = settle(a, best, on_b);
  if (best.gap < inf) best.gap = measured(a, best).gap;
  add_both(best, level, blur(a), margin);
  if (nearest.gap < inf) add_supports(a, level.x, seen_by_b, margin, -1, Frame{});
  if (found.empty() && nearest.gap < 0 && solid)
    part(a, b_in_a, all_b.centre(), 0,
         [&](const Vector3d& n) { return lowest_vertex(b, b_in_a, n); });
  emit(found, tolerance::similar_normal, out);
}

namespace {

/// Deepest point of the zero level of `body` in the other field, in the frame of `field`, and what
/// else of it is near.
/// @param side  of the normals found, 1 where candidates are in the frame of `field`
Touch deepest(const SdfGrid& field, const SdfGrid& body, const Frame& body_in_field, double margin,
              double side, const Frame& to_a) {
  const Frame field_in_body = body_in_field.inverse();
  const Aabb near = moved(field.surface->tree.nodes[0].box, field_in_body).inflated(margin);
  const auto seen = [&](const Vector3d& x) {
    const Touch t = touch(field, body_in_field * x);
    return Touch{x, field_in_body.rotation * t.normal, t.gap};
  };
  vertices_near(body, near, margin, seen, near_vertices);
  if (near_vertices.empty()) return {};
  Touch low = settle_on_level(body, near_vertices[0].touch.x, seen);
  add_supports(body, low.x, seen, margin, side, to_a);
  low.x = body_in_field * low.x, low.normal = body_in_field.rotation * low.normal;
  low.gap = measured(field, low).gap;
  return low;
}

}  // namespace

void sdf_sdf(const SdfGrid& a, const SdfGrid& b, const Frame& b_in_a, double margin,
             std::vector<Manifold>& out) {
  found.clear();
  const Touch on_b = deepest(a, b, b_in_a, margin, 1, b_in_a);
  Touch on_a = deepest(b, a, b_in_a.inverse(), margin, -1, Frame{});
  on_a.x = b_in_a * on_a.x;
  on_a.normal = b_in_a.rotation * on_a.normal;
  const bool meet = std::min(on_a.gap, on_b.gap) < std::numeric_limits<double>::infinity();
  if (meet) add_both(on_b, on_a, blur(a) + blur(b), margin);
  const Vector3d centre = b_in_a * b.surface->tree.nodes[0].box.centre();
  Vector3d unused;
  if (meet && std::min(on_a.gap, on_b.gap) > -a.spacing && a.sample(centre, unused) < -a.spacing) {
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
  const double reach = std::min(margin, b.spacing);
  // The patch: of the vertices near the plane, those farthest out in eight directions along it.
  const Vector3d along = n.unitOrthogonal(), across = n.cross(along);
  struct Farthest {
    double far = -std::numeric_limits<double>::infinity(), gap = 0;
    int vertex = -1;
  };
  std::array<Farthest, 8> patch;
  double least = std::numeric_limits<double>::infinity();
  Vector3d lowest = Vector3d::Zero();
  const MeshSurface& s = *b.surface;
  s.tree.query(
      [&](const Aabb& box) {
        const double low = n.dot(box.centre()) - 0.5 * n.cwiseAbs().dot(box.extents()) - level;
        return low <= std::max(reach, margin + b.spacing);
      },
      [&](int f) {
        for (int c = 0; c < 3; ++c) {
          const Vector3d x = s.corner(f, c);
          const double gap = n.dot(x) - level, u = along.dot(x), w = across.dot(x);
          if (gap < least) least = gap, lowest = x;
          if (gap > reach) continue;
          const double directions[8] = {u, -u, w, -w, u + w, -u - w, u - w, w - u};
          for (int k = 0; k < 8; ++k)
            if (directions[k] > patch[k].far) patch[k] = {directions[k], gap, s.mesh.faces(f, c)};
        }
      });
  if (least > margin + b.spacing) return;
  for (const Farthest& p : patch)
    if (p.vertex >= 0)
      found.push_back({n,
                       {s.vertex(p.vertex) - 0.5 * p.gap * n, p.gap,
                        feature::pair(feature::face(0), feature::vertex(p.vertex))}});
  const auto foot = [&](Vector3d& x) { x -= (n.dot(x) - level) * n; };
  const auto over = [&](const Vector3d& x) { return Touch{x, n, n.dot(x) - level}; };
  Vector3d under = lowest;
  foot(under);
  const Touch inside = settle(b, touch(b, under), foot);
  const Touch deep = settle_on_level(b, lowest, over);
  // The plane gives the normal; its own search counts where the grid's gradient says the same.
  const bool faces = inside.normal.dot(-n) > tolerance::facing;
  const double gap = faces ? std::min(inside.gap, deep.gap) : deep.gap;
  if (gap <= margin)
    found.push_back(
        {n, {deep.x - 0.5 * gap * n, gap, feature::pair(feature::face(0), feature::curve(1))}});
  const std::size_t begin = out.size();
  emit(found, tolerance::same_normal, out);
  for (std::size_t i = begin; i < out.size(); ++i) {  // worked out in the grid's frame
    out[i].normal = normal;
    for (int k = 0; k < out[i].count; ++k)
      out[i].points[k].position = b_in_a * out[i].points[k].position;
  }
}

}  // namespace carom
