// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/sdf.hpp"
#include "carom/narrow/queries.hpp"
#include "carom/numerics/tolerance.hpp"

#include "narrow/advance.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
using narrow::MovingPart;
using Status = FirstContact::Status;

constexpr int many_faces = 32;  // more of them in one stretch of the way: halve the stretch
constexpr int most_halvings = 12;
constexpr int grid_queries = 24;   // half of the gap each: 20 get from 1 m to 1 um; each is dear
constexpr int grid_halvings = 16;  // of half a cell of way: 0.02 m to 0.3 um

/// A shape without parts, where it sits in its body.
struct Leaf {
  const Shape* shape = nullptr;
  Frame in_body;
  MovingPart part;  // of a convex shape or a half-space
  const MeshSurface* surface = nullptr;
  bool is_grid = false;
  double radius = 0;  // m, about the centre of mass
};

const MeshSurface* surface_of(const Shape& shape) {
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->surface.get();
  if (const auto* terrain = std::get_if<HeightField>(&shape)) return terrain->surface.get();
  return nullptr;
}

void take_apart(const Shape& shape, const Frame& in_body, const BodyPath& path, double spin,
                std::vector<Leaf>& out) {
  if (const auto* whole = std::get_if<Compound>(&shape)) {
    for (const CompoundPart& part : *whole->parts)
      take_apart(part.shape, in_body * Frame(part.pose), path, spin, out);
    return;
  }
  if (const auto* balls = std::get_if<ParticleSet>(&shape)) {
    for (Eigen::Index i = 0; i < balls->positions.rows(); ++i) {
      Leaf leaf;
      leaf.part = MovingPart::of(Convex::point(balls->positions.row(i).transpose(), balls->radius),
                                 in_body, path, spin);
      leaf.radius = leaf.part.arm + balls->radius;
      out.push_back(leaf);
    }
    return;
  }
  Leaf leaf;
  leaf.shape = &shape;
  leaf.in_body = in_body;
  leaf.radius = (in_body.translation - path.com_b).norm() + bounding_radius(shape);
  leaf.is_grid = std::holds_alternative<Sdf>(shape);
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    leaf.part.half_space = true;
    leaf.part.path = &path;
    leaf.part.normal_b = in_body.rotation * plane->normal.normalized();
    leaf.part.offset = plane->offset + leaf.part.normal_b.dot(in_body.translation);
  } else if (const auto convex = convex_of(shape)) {
    leaf.part = MovingPart::of(*convex, in_body, path, spin);
  } else {
    leaf.surface = surface_of(shape);
  }
  out.push_back(leaf);
}

/// One pair of bodies being asked about.
struct Search {
  const BodyPath &path_a, &path_b;
  double spin_a, spin_b;  // rad/s, of the fastest arc
  double from, end;
  double target = 0;      // m, a gap this small is a contact
  bool only_now = false;  // look at `from` alone: how near they are already
  FirstContact best{};

  /// The world box that a leaf sweeps from t0 to t1.
  static Aabb swept(const Leaf& leaf, const BodyPath& path, double t0, double t1) {
    return path.centre_bounds(t0, t1).inflated(leaf.radius + 2 * tolerance::sweep_clear);
  }

  [[nodiscard]] double spin_of(const BodyPath& path) const {
    return &path == &path_a ? spin_a : spin_b;
  }

  /// The world box that a part can reach from where it is at t0. Far from its body's centre, as a
  /// face of a terrain is, this is much less than the ball about that centre.
  [[nodiscard]] Aabb reached(const MovingPart& part, double t0, double t1) const {
    const Frame frame = Frame(part.path->pose_at(t0)) * part.in_body;
    Aabb box;
    for (int i = 0; i < 3; ++i)
      for (const double sign : {-1.0, 1.0}) {
        const Vector3d d = sign * frame.rotation.row(i).transpose();
        (sign < 0 ? box.lower : box.upper)[i] = (frame * part.convex.support(d))[i];
      }
    // As far as a gap is asked for: what a hit leaves must be found again.
    return box.inflated(part.convex.radius + way(*part.path, part.arm, t0, t1) +
                        2 * tolerance::sweep_clear);
  }

  static Aabb intersection(const Aabb& a, const Aabb& b) {
    return {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)};
  }

  /// Bound on the way of any point of a body that lies within `radius` of its centre.
  [[nodiscard]] double way(const BodyPath& path, double radius, double t0, double t1) const {
    const double rate = spin_of(path);
    const double speed = std::max(path.velocity_at(t0).norm(), path.velocity_at(t1).norm());
    return (speed + rate * radius) * (t1 - t0);
  }

  void ask(const MovingPart& a, const MovingPart& b, double t0, double t1) {
    if (!only_now) return narrow::advance(a, b, t0, t1, target, best);
    const FirstContact here = narrow::gap_at(a, b, from, 2 * tolerance::sweep_clear);
    best.gap = std::min(best.gap, here.gap);
  }

  /// A convex part against the faces of a surface that it may meet between t0 and t1.
  void faces(const Leaf& s, const BodyPath& path_s, const MovingPart& part, double radius,
             bool surface_is_a, double t0, double t1, int halvings) {
    thread_local std::vector<int> near;
    Leaf ball;
    ball.radius = radius;
    const Aabb world = intersection(swept(ball, *part.path, t0, t1), reached(part, t0, t1));
    const Frame frame = Frame(path_s.pose_at(t0)) * s.in_body;
    const double slide = way(path_s, s.radius, t0, t1);
    const Aabb region = local(frame, world).inflated(slide);
    near.clear();
    const std::size_t begin = near.size();
    s.surface->tree.query([&](const Aabb& box) { return box.overlaps(region); },
                          [&](int f) { near.push_back(f); });
    const double size = 2 * radius + slide;
    if (near.size() - begin > many_faces && halvings < most_halvings &&
        world.extents().maxCoeff() > 2 * size) {
      const double middle = 0.5 * (t0 + t1);
      faces(s, path_s, part, radius, surface_is_a, t0, middle, halvings + 1);
      // Another part may have met before, or in the half just searched: later ones are of no use.
      t1 = std::min(t1, last());
      if (middle < t1) faces(s, path_s, part, radius, surface_is_a, middle, t1, halvings + 1);
      return;
    }
    for (const int f : near) {
      const std::array<Vector3d, 3> corners{s.surface->corner(f, 0), s.surface->corner(f, 1),
                                            s.surface->corner(f, 2)};
      const MovingPart face =
          MovingPart::of(Convex::hull(corners), s.in_body, path_s, spin_of(path_s));
      surface_is_a ? ask(face, part, t0, t1) : ask(part, face, t0, t1);
    }
  }

  void surfaces(const Leaf& a, const Leaf& b) {
    thread_local std::vector<int> mine;
    mine.clear();
    const Frame frame = Frame(path_a.pose_at(from)) * a.in_body;
    const double slide = way(path_a, a.radius, from, end);
    const Aabb region = local(frame, swept(b, path_b, from, end)).inflated(slide);
    a.surface->tree.query([&](const Aabb& box) { return box.overlaps(region); },
                          [&](int f) { mine.push_back(f); });
    for (const int f : mine) {
      const std::array<Vector3d, 3> corners{a.surface->corner(f, 0), a.surface->corner(f, 1),
                                            a.surface->corner(f, 2)};
      const MovingPart face = MovingPart::of(Convex::hull(corners), a.in_body, path_a, spin_a);
      faces(b, path_b, face, face.arm, false, from, last(), 0);
    }
  }

  /// Nearest points of a distance grid and anything at one time, no farther apart than `reach`.
  ClosestPoints look(const Leaf& a, const Leaf& b, double t, double reach) {
    // Particles have no shape of their own in a leaf; a ball stands for them.
    const Shape ball_a = Sphere{a.part.convex.radius}, ball_b = Sphere{b.part.convex.radius};
    const auto place = [t](const Leaf& leaf, const BodyPath& path) {
      const Frame inner =
          leaf.shape ? leaf.in_body
                     : Frame(Eigen::Matrix3d::Identity(), leaf.in_body * leaf.part.convex.ends[0]);
      const Frame f = Frame(path.pose_at(t)) * inner;
      return Pose{f.translation, Eigen::Quaterniond(f.rotation)};
    };
    const ClosestPoints near = closest_points(a.shape ? *a.shape : ball_a, place(a, path_a),
                                              b.shape ? *b.shape : ball_b, place(b, path_b), reach);
    ++best.queries;
    best.gap = std::min(best.gap, near.distance);
    return near;
  }

  void meet(const ClosestPoints& near, double t, Status status) {
    if (best.status != Status::clear && best.time <= t) return;
    best.status = status;
    best.time = t;
    best.normal = near.normal;
    best.point = 0.5 * (near.point_a + near.point_b);
  }

  /// A distance grid and anything: nothing may move farther than the gap. What stays near without
  /// touching, sliding past, is followed as what touches is.
  void grid(const Leaf& a, const Leaf& b) {
    if (!only_now && target <= 0) return grid_from_touch(a, b, from);
    double t = from;
    for (int i = 0; t < end || i == 0; ++i) {
      const double most = way(path_a, a.radius, t, end) + way(path_b, b.radius, t, end);
      const double reach = most + 2 * tolerance::sweep_clear;
      const ClosestPoints near = look(a, b, t, reach);
      if (only_now || !(near.distance <= reach)) return;
      const double room = near.distance - target;
      const bool touches = room <= 0.5 * tolerance::sweep_clear;
      if (touches) return meet(near, t, Status::contact);
      if (room >= most) return;
      if (i == grid_queries) return grid_from_touch(a, b, t);
      t += tolerance::sdf_stride * (end - t) * room / most;
    }
  }

  /// What touches or overlaps at the start: there is no gap to measure a stride by, and the
  /// gradient inside is no bound. Looks half a cell of way apart, as nothing in a grid is thinner;
  /// where one is deeper than the start may become, halved to the time it did.
  void grid_from_touch(const Leaf& a, const Leaf& b, double start) {
    double cell = std::numeric_limits<double>::infinity();
    for (const Leaf* leaf : {&a, &b})
      if (leaf->is_grid) cell = std::min(cell, std::get<Sdf>(*leaf->shape).grid->spacing);
    const double most = way(path_a, a.radius, start, end) + way(path_b, b.radius, start, end);
    const double looks =
        std::clamp(std::ceil(2 * most / cell), 1.0, double{tolerance::sweep_queries});
    const double reach = 2 * tolerance::sweep_clear;
    double low = start;
    for (int i = 1; i <= looks; ++i) {
      double high = start + (end - start) * i / looks;
      if (look(a, b, high, reach).distance >= target) {
        low = high;
        continue;
      }
      for (int k = 0; k < grid_halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (look(a, b, middle, reach).distance >= target ? low : high) = middle;
      }
      const ClosestPoints near = look(a, b, low, reach);
      return meet(near.distance <= reach ? near : look(a, b, high, reach), low, Status::contact);
    }
  }

  void leaves(const Leaf& a, const Leaf& b) {
    if (!a.part.half_space && !b.part.half_space &&
        !swept(a, path_a, from, end).overlaps(swept(b, path_b, from, end)))
      return;
    if (a.is_grid || b.is_grid) return grid(a, b);
    if (a.surface && b.surface) return surfaces(a, b);
    if (b.part.half_space) return half_space(b, a, true);
    if (a.part.half_space) return half_space(a, b, false);
    if (a.surface) return faces(a, path_a, b.part, b.radius, true, from, last(), 0);
    if (b.surface) return faces(b, path_b, a.part, a.radius, false, from, last(), 0);
    ask(a.part, b.part, from, last());
  }

  void half_space(const Leaf& plane, const Leaf& other, bool turned) {
    thread_local std::vector<Vector3d> corners;
    MovingPart part = other.part;
    if (other.surface) {  // a half-space meets the hull of a surface first
      corners.clear();
      for (Eigen::Index v = 0; v < other.surface->mesh.vertices.rows(); ++v)
        corners.push_back(other.surface->vertex(static_cast<int>(v)));
      part = turned ? MovingPart::of(Convex::hull(corners), other.in_body, path_a, spin_a)
                    : MovingPart::of(Convex::hull(corners), other.in_body, path_b, spin_b);
    }
    const double before = best.time;
    const Status status = best.status;
    ask(plane.part, part, from, last());
    if (turned && (best.time != before || best.status != status)) best.normal = -best.normal;
  }

  [[nodiscard]] double last() const {
    if (only_now) return from;
    return best.status == Status::clear ? end : best.time;
  }

  /// Box around a world box, in a frame.
  static Aabb local(const Frame& frame, const Aabb& world) {
    const Vector3d half = frame.rotation.transpose().cwiseAbs() * (0.5 * world.extents());
    const Vector3d centre = frame.to_local(world.centre());
    return {centre - half, centre + half};
  }

  void run(const std::vector<Leaf>& of_a, const std::vector<Leaf>& of_b) {
    best.gap = std::numeric_limits<double>::infinity();
    for (const Leaf& a : of_a)
      for (const Leaf& b : of_b) leaves(a, b);
  }
};

}  // namespace

FirstContact first_contact(const Shape& a, const BodyPath& path_a, const Shape& b,
                           const BodyPath& path_b, double from, double end, double deepest) {
  thread_local std::vector<Leaf> of_a, of_b;
  of_a.clear(), of_b.clear();
  const double spin_a = narrow::fastest_spin(path_a), spin_b = narrow::fastest_spin(path_b);
  take_apart(a, {}, path_a, spin_a, of_a);
  take_apart(b, {}, path_b, spin_b, of_b);
  Search now{path_a, path_b, spin_a, spin_b, from, from};
  now.only_now = true;
  now.run(of_a, of_b);
  Search search{path_a, path_b, spin_a, spin_b, from, end};
  const double left = 1 + std::min(now.best.gap, 0.0) / deepest;
  const double slop = tolerance::sweep_slop * std::max(left, tolerance::sweep_least_slop);
  search.target =
      now.best.gap > tolerance::sweep_leaves ? tolerance::sweep_clear : now.best.gap - slop;
  search.best.time = end;
  search.run(of_a, of_b);
  search.best.gap = std::min(search.best.gap, now.best.gap);
  return search.best;
}

}  // namespace carom
