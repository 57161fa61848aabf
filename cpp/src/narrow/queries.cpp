// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/queries.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "carom/geometry/frame.hpp"
#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/sdf.hpp"
#include "carom/geometry/separation.hpp"
#include "carom/narrow/contacts.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

void to_world(const Frame& frame, const Vector3d& normal, double t, const Vector3d& origin,
              const Vector3d& direction, CastHit& out) {
  if (out.hit && !(t < out.distance)) return;
  out.hit = true;
  out.distance = t;
  out.point = origin + t * direction;
  out.normal = frame.rotation * normal;
}

/// Ray in the shape's frame against one triangle, both sides. Source: T. Moeller, B. Trumbore,
/// 1997.
double ray_triangle(const Vector3d& o, const Vector3d& d, const Vector3d& a, const Vector3d& b,
                    const Vector3d& c) {
  const Vector3d e1 = b - a, e2 = c - a, p = d.cross(e2);
  const double det = e1.dot(p);
  if (det == 0) return std::numeric_limits<double>::infinity();
  const Vector3d s = o - a, q = s.cross(e1);
  const double u = s.dot(p) / det, v = d.dot(q) / det, t = e2.dot(q) / det;
  const double slack = tolerance::inside_polygon;  // a ray through an edge belongs to both faces
  if (u < -slack || v < -slack || u + v > 1 + slack || t < 0)
    return std::numeric_limits<double>::infinity();
  return t;
}

bool ray_box(const Aabb& box, const Vector3d& o, const Vector3d& d, double limit) {
  double low = 0, high = limit;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0) {
      if (o[i] < box.lower[i] || o[i] > box.upper[i]) return false;
      continue;
    }
    double t0 = (box.lower[i] - o[i]) / d[i], t1 = (box.upper[i] - o[i]) / d[i];
    if (t0 > t1) std::swap(t0, t1);
    const double widen = tolerance::inside_polygon * std::max(std::abs(t0), std::abs(t1));
    low = std::max(low, t0 - widen);
    high = std::min(high, t1 + widen);
  }
  return low <= high;
}

struct Ray {
  const Frame& frame;
  const Vector3d &origin, &direction;  // world
  double limit;
  CastHit& out;

  Vector3d o() const { return frame.to_local(origin); }
  Vector3d d() const { return frame.rotation.transpose() * direction; }
  void hit(double t, const Vector3d& normal) const {
    if (t <= limit) to_world(frame, normal, t, origin, direction, out);
  }
};

void cast(const Plane& p, const Ray& ray) {
  const Vector3d n = p.normal.normalized();
  const double gap = n.dot(ray.o()) - p.offset, speed = -n.dot(ray.d());
  if (gap <= 0) return ray.hit(0, n);
  if (speed > 0) ray.hit(gap / speed, n);
}

void cast(const MeshSurface& s, const Ray& ray) {
  const Vector3d o = ray.o(), d = ray.d();
  double best = ray.limit;
  int face = -1;
  s.tree.query([&](const Aabb& box) { return ray_box(box, o, d, best); },
               [&](int f) {
                 const double t =
                     ray_triangle(o, d, s.corner(f, 0), s.corner(f, 1), s.corner(f, 2));
                 if (t <= best) best = t, face = f;
               });
  if (s.faults.closed()) {  // a start inside is a hit at once
    const SurfacePoint q = closest_point(s, o, std::numeric_limits<double>::infinity());
    if (q.distance <= 0) return ray.hit(0, q.normal);
  }
  if (face < 0) return;
  const Vector3d& n = s.face_normals[face];
  ray.hit(best, n.dot(d) > 0 ? Vector3d(-n) : n);
}

/// Steps onto the plane that supports the body at its nearest point: it never cuts the body off.
/// Source: G. van den Bergen, Ray Casting against General Convex Objects, 2004.
void cast(const Convex& body, const Ray& ray) {
  const Vector3d o = ray.o(), d = ray.d();
  const double size = body.bounding_radius(), inf = std::numeric_limits<double>::infinity();
  double t = std::max(0.0, -o.dot(d) - size);  // to the ball that holds the body
  Vector3d n = -d;
  for (int i = 0; i < tolerance::cast_steps && t <= ray.limit; ++i) {
    const Separation s = separation(body, Convex::point(o + t * d), Frame{}, inf);
    n = s.normal;
    if (s.distance <= tolerance::cast_gap * size) return ray.hit(t, n);
    const double speed = -n.dot(d);
    if (!(speed > 0)) return;
    t += s.distance / speed;
  }
  if (t <= ray.limit) ray.hit(t, n);
}

void cast(const SdfGrid& grid, const Ray& ray) {
  const Vector3d o = ray.o(), d = ray.d();
  Vector3d g;
  double t = 0;
  for (int i = 0; i < 16 * tolerance::cast_steps && t <= ray.limit; ++i) {
    const double gap = grid.sample(o + t * d, g);
    if (gap <= tolerance::sdf_settled * grid.spacing) return ray.hit(t, g.normalized());
    t += gap;
  }
}

void cast(const Shape& shape, const Ray& ray) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return cast(*plane, ray);
  if (const auto* sdf = std::get_if<Sdf>(&shape)) return cast(*sdf->grid, ray);
  if (const auto* terrain = std::get_if<HeightField>(&shape)) return cast(*terrain->surface, ray);
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return cast(*mesh->surface, ray);
  if (const auto* hull = std::get_if<ConvexHull>(&shape)) return cast(*hull->surface, ray);
  if (const auto* particles = std::get_if<ParticleSet>(&shape)) {
    for (Eigen::Index i = 0; i < particles->positions.rows(); ++i)
      cast(Convex::point(Vector3d::Zero(), particles->radius),
           Ray{Frame(Eigen::Matrix3d::Identity(),
                     ray.frame * Vector3d(particles->positions.row(i).transpose())),
               ray.origin, ray.direction, ray.limit, ray.out});
  } else if (const auto* compound = std::get_if<Compound>(&shape)) {
    for (const CompoundPart& part : *compound->parts) {
      const Frame placed = ray.frame * Frame(part.pose);
      cast(part.shape, Ray{placed, ray.origin, ray.direction, ray.limit, ray.out});
    }
  } else if (const auto body = convex_of(shape)) {
    cast(*body, ray);
  }
}

}  // namespace

CastHit ray_cast(const Shape& shape, const Pose& pose, const Vector3d& origin,
                 const Vector3d& direction, double max_distance) {
  CastHit out;
  const Frame frame(pose);
  cast(shape, Ray{frame, origin, direction, max_distance, out});
  return out;
}

ClosestPoints closest_points(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                             double reach) {
  thread_local std::vector<Manifold> all;
  all.clear();
  collide(a, pose_a, b, pose_b, reach, all);
  ClosestPoints out;
  for (const Manifold& m : all)
    for (int k = 0; k < m.count; ++k)
      if (const ContactPoint& p = m.points[k]; p.separation < out.distance) {
        out.distance = p.separation;
        out.normal = m.normal;
        out.point_a = p.position - 0.5 * p.separation * m.normal;
        out.point_b = p.position + 0.5 * p.separation * m.normal;
      }
  return out;
}

CastHit shape_cast(const Shape& moving, const Pose& start, const Vector3d& direction,
                   double max_distance, const Shape& shape, const Pose& pose) {
  CastHit out;
  Pose at = start;
  double t = 0;
  // The gap is how far the shape may go whatever way it lies: no contact can be stepped over.
  for (int i = 0; i < tolerance::cast_steps; ++i) {
    at.position = start.position + t * direction;
    const ClosestPoints near = closest_points(shape, pose, moving, at, max_distance - t);
    if (!(near.distance <= max_distance - t)) return out;
    out.point = near.point_a;
    out.normal = near.normal;
    out.distance = t;
    if (near.distance <= tolerance::cast_gap) break;
    t += near.distance;
  }
  out.hit = true;
  return out;
}

}  // namespace carom
