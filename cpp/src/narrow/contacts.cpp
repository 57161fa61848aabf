// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/contacts.hpp"

#include <algorithm>
#include <limits>

#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/boxes.hpp"
#include "narrow/candidates.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
using Manifolds = std::vector<Manifold>;

enum class Kind { half_space, convex, surface, sdf };

/// A shape as the routines take it.
struct Leaf {
  Kind kind = Kind::convex;
  Vector3d normal = Vector3d::UnitZ();
  double offset = 0;
  Convex convex;
  const Box* box = nullptr;
  const Polytope* polytope = nullptr;
  const MeshSurface* surface = nullptr;
  const SdfGrid* sdf = nullptr;

  /// About the middle of the body, in its frame.
  Vector3d centre() const {
    if (sdf) return sdf->box().centre();
    if (surface && kind == Kind::surface) return surface->tree.nodes[0].box.centre();
    if (convex.kind == Convex::Kind::points && convex.end_count == 0) {
      Vector3d sum = Vector3d::Zero();
      for (const Vector3d& p : convex.points) sum += p;
      return sum / static_cast<double>(convex.points.size());
    }
    return convex.end_count == 1 ? convex.ends[0] : Vector3d::Zero();
  }
  /// A ball about that middle which holds the body, m.
  double radius_about_centre() const {
    const auto diagonal = [](const Aabb& all) { return all.extents().norm(); };
    if (sdf) return diagonal(sdf->box());
    if (surface) return diagonal(surface->tree.nodes[0].box);
    return convex.bounding_radius();  // these have their middle at the origin
  }
  bool is_ball() const { return convex.kind == Convex::Kind::points && convex.end_count == 1; }
};

/// `slot`: which of the two scratch boxes to use.
Leaf leaf_of(const Shape& shape, int slot) {
  Leaf leaf;
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    leaf.kind = Kind::half_space;
    leaf.normal = plane->normal.normalized();
    leaf.offset = plane->offset;
  } else if (const auto* sdf = std::get_if<Sdf>(&shape)) {
    leaf.kind = Kind::sdf;
    leaf.sdf = sdf->grid.get();
  } else if (const auto convex = convex_of(shape)) {
    leaf.convex = *convex;
    leaf.box = std::get_if<Box>(&shape);
    if (leaf.box) leaf.polytope = &scratch_polytope(*leaf.box, slot);
    if (leaf.convex.polytope) leaf.polytope = leaf.convex.polytope;
  } else {
    leaf.kind = Kind::surface;
  }
  if (const auto* mesh = std::get_if<Mesh>(&shape)) leaf.surface = mesh->surface.get();
  if (const auto* hull = std::get_if<ConvexHull>(&shape)) leaf.surface = hull->surface.get();
  if (const auto* terrain = std::get_if<HeightField>(&shape)) leaf.surface = terrain->surface.get();
  return leaf;
}

/// Takes manifolds found in `frame` to the world; side -1: they were found as (b, a).
void in_world(const Frame& frame, std::size_t begin, double side, Manifolds& out) {
  for (std::size_t i = begin; i < out.size(); ++i) {
    Manifold& m = out[i];
    m.normal = side * (frame.rotation * m.normal);
    for (int k = 0; k < m.count; ++k) m.points[k].position = frame * m.points[k].position;
  }
}

bool stands_on(const Leaf& floor, const Leaf& body, const Frame& body_in_floor, double margin,
               Manifolds& out) {
  std::span<const Vector3d> corners;
  if (body.polytope) corners = body.polytope->vertices;
  return floor.polytope &&
         one_face(*floor.polytope, body.convex, corners, body_in_floor, margin, out);
}

void convex_pair(const Leaf& a, const Leaf& b, const Frame& b_in_a, double margin, Manifolds& out) {
  if (a.box && b.box) return box_box(a.convex.size, b.convex.size, b_in_a, margin, out);
  if (a.is_ball() && b.is_ball() && a.convex.radius > 0 && b.convex.radius > 0)
    return ball_ball(a.convex.radius, b_in_a.translation, b.convex.radius, margin, out);
  if (a.box && b.is_ball() && b.convex.radius > 0)
    return box_ball(a.convex.size, b_in_a.translation, b.convex.radius, margin, out);
  if (stands_on(a, b, b_in_a, margin, out)) return;
  const std::size_t begin = out.size();
  if (stands_on(b, a, b_in_a.inverse(), margin, out)) return in_world(b_in_a, begin, -1, out);
  if (a.polytope && b.polytope &&
      a.polytope->edges.size() * b.polytope->edges.size() <= tolerance::edge_pairs)
    return polytope_polytope(*a.polytope, *b.polytope, b_in_a, margin, out);
  convex_convex(a.convex, b.convex, b_in_a, margin, out);
}

void surface_leaf(const Leaf& a, const Leaf& b, const Frame& b_in_a, double margin,
                  Manifolds& out) {
  if (b.is_ball())
    return surface_ball(*a.surface, b_in_a.translation, b.convex.radius, margin, out);
  if (b.surface) return surface_surface(*a.surface, *b.surface, b_in_a, margin, out);
  if (b.box) return surface_surface(*a.surface, scratch_surface(*b.box), b_in_a, margin, out);
  surface_convex(*a.surface, b.convex, b_in_a, margin, out);
}

/// a's kind is not below b's, but for half-spaces, which come first.
void meet(const Leaf& a, const Leaf& b, const Frame& b_in_a, double margin, Manifolds& out) {
  switch (a.kind) {
    case Kind::half_space:
      if (b.kind == Kind::convex && b.polytope)
        half_space_points(a.normal, a.offset, b.polytope->vertices, b_in_a, margin, out);
      else if (b.kind == Kind::convex)
        half_space_convex(a.normal, a.offset, b.convex, b_in_a, margin, out);
      else if (b.kind == Kind::surface)
        half_space_surface(a.normal, a.offset, *b.surface, b_in_a, margin, out);
      else if (b.kind == Kind::sdf)
        half_space_sdf(a.normal, a.offset, *b.sdf, b_in_a, margin, out);
      return;  // two half-spaces are both static: never asked
    case Kind::convex:
      return convex_pair(a, b, b_in_a, margin, out);
    case Kind::surface:
      return surface_leaf(a, b, b_in_a, margin, out);
    case Kind::sdf:
      if (b.kind == Kind::sdf) return sdf_sdf(*a.sdf, *b.sdf, b_in_a, margin, out);
      if (b.kind == Kind::surface) return sdf_surface(*a.sdf, *b.surface, b_in_a, margin, out);
      return sdf_convex(*a.sdf, b.convex, b_in_a, margin, out);
  }
}

/// Turns a sheet to the side on which the other body's centre lies; false where they cannot meet.
/// @param seen_from  m, that centre in the sheet's frame
bool turn_sheet(Leaf& sheet, const Leaf& other, const Vector3d& seen_from, double margin) {
  if (other.kind == Kind::half_space) return true;
  const double reach = other.radius_about_centre() + margin;
  const Side side = side_of(*sheet.surface, seen_from, reach);
  if (side == Side::behind) sheet.surface = sheet.surface->back.get();
  return side != Side::none;
}

bool is_sheet(const Leaf& leaf) {
  return leaf.kind == Kind::surface && leaf.surface->back;
}

/// An order of two grids that are not alike, so that a pair is worked out the same whoever asks.
bool comes_later(const SdfGrid& a, const SdfGrid& b) {
  if (a.spacing != b.spacing) return a.spacing > b.spacing;
  if (&a == &b) return false;  // nothing in its millions of numbers would tell
  const std::vector<double>&ca = a.coefficients, &cb = b.coefficients;
  if (ca.size() != cb.size()) return ca.size() > cb.size();
  return std::ranges::lexicographical_compare(cb, ca);
}

/// Whether the pair is asked as (b, a).
bool turned(const Leaf& a, const Leaf& b) {
  if (a.kind == Kind::half_space || b.kind == Kind::half_space) return b.kind == Kind::half_space;
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.kind == Kind::sdf) return comes_later(*a.sdf, *b.sdf);
  return a.kind == Kind::convex && b.box && !a.box;
}

void collide_leaves(const Shape& a, const Frame& frame_a, const Shape& b, const Frame& frame_b,
                    double margin, Manifolds& out) {
  Leaf la = leaf_of(a, 0), lb = leaf_of(b, 1);
  const bool turn = turned(la, lb);
  if (turn) std::swap(la, lb);
  const Frame &first = turn ? frame_b : frame_a, &second = turn ? frame_a : frame_b;
  const std::size_t begin = out.size();
  const Frame b_in_a = relative(first, second);
  if (const bool sheet_a = is_sheet(la), sheet_b = is_sheet(lb); sheet_a || sheet_b) {
    const Vector3d centre_a = la.centre(), centre_b = lb.centre();
    if (sheet_a && !turn_sheet(la, lb, b_in_a * centre_b, margin)) return;
    if (sheet_b && !turn_sheet(lb, la, b_in_a.to_local(centre_a), margin)) return;
  }
  meet(la, lb, b_in_a, margin, out);
  in_world(first, begin, turn ? -1 : 1, out);
}

/// Names points apart that come from different parts of one body.
void rename(std::size_t begin, std::uint32_t part, Manifolds& out) {
  for (std::size_t i = begin; i < out.size(); ++i)
    for (int k = 0; k < out[i].count; ++k)
      out[i].points[k].feature = feature::pair(out[i].points[k].feature, part);
}

void collide_frames(const Shape& a, const Frame& frame_a, const Shape& b, const Frame& frame_b,
                    double margin, Manifolds& out);

/// Each part of a whole against the other shape; `part_is_a` tells on which side it stands.
template <class Part>
void each(const Part& part_shape, const Frame& placed, std::uint32_t number, const Shape& other,
          const Frame& frame_other, bool part_is_a, double margin, Manifolds& out) {
  const std::size_t begin = out.size();
  if (part_is_a)
    collide_frames(part_shape, placed, other, frame_other, margin, out);
  else
    collide_frames(other, frame_other, part_shape, placed, margin, out);
  rename(begin, number, out);
}

/// Bodies of parts are taken apart; returns false for a body in one piece.
bool taken_apart(const Shape& whole, const Frame& frame, const Shape& other,
                 const Frame& frame_other, bool whole_is_a, double margin, Manifolds& out) {
  const auto* compound = std::get_if<Compound>(&whole);
  const auto* particles = std::get_if<ParticleSet>(&whole);
  if (!compound && !particles) return false;
  const Pose pose_other{frame_other.translation, Eigen::Quaterniond(frame_other.rotation)};
  const Aabb near = bounds(other, pose_other).inflated(margin);
  const std::size_t begin = out.size();
  std::uint32_t number = 0;
  if (compound)
    for (const CompoundPart& part : *compound->parts) {
      const Frame placed = frame * Frame(part.pose);
      const Pose pose{placed.translation, Eigen::Quaterniond(placed.rotation)};
      ++number;
      if (bounds(part.shape, pose).overlaps(near))
        each(part.shape, placed, number, other, frame_other, whole_is_a, margin, out);
    }
  else
    for (Eigen::Index i = 0; i < particles->positions.rows(); ++i) {
      const Vector3d at = frame * Vector3d(particles->positions.row(i).transpose());
      ++number;
      if (squared_distance(near, at) > particles->radius * particles->radius) continue;
      each(Shape(Sphere{particles->radius}), Frame(Eigen::Matrix3d::Identity(), at), number, other,
           frame_other, whole_is_a, margin, out);
    }
  join(begin, tolerance::same_normal, out);
  return true;
}

/// Balls at their places in the world.
void two_balls(const Sphere& a, const Vector3d& at_a, const Sphere& b, const Vector3d& at_b,
               double margin, Manifolds& out) {
  const std::size_t begin = out.size();
  ball_ball(a.radius, at_b - at_a, b.radius, margin, out);
  if (out.size() > begin) out.back().points[0].position += at_a;
}

/// Pairs that come by the thousand, without the detour by leaves; false for all others.
bool common_pair(const Shape& a, const Frame& frame_a, const Shape& b, const Frame& frame_b,
                 double margin, Manifolds& out) {
  const auto *box_a = std::get_if<Box>(&a), *box_b = std::get_if<Box>(&b);
  const auto *ball_a = std::get_if<Sphere>(&a), *ball_b = std::get_if<Sphere>(&b);
  const std::size_t begin = out.size();
  if (box_a && box_b) {
    const Frame b_in_a = relative(frame_a, frame_b);
    box_box(0.5 * box_a->extents, 0.5 * box_b->extents, b_in_a, margin, out);
    in_world(frame_a, begin, 1, out);
  } else if (ball_a && ball_b) {
    two_balls(*ball_a, frame_a.translation, *ball_b, frame_b.translation, margin, out);
  } else if (box_a && ball_b) {
    box_ball(0.5 * box_a->extents, frame_a.to_local(frame_b.translation), ball_b->radius, margin,
             out);
    in_world(frame_a, begin, 1, out);
  } else if (ball_a && box_b) {
    box_ball(0.5 * box_b->extents, frame_b.to_local(frame_a.translation), ball_a->radius, margin,
             out);
    in_world(frame_b, begin, -1, out);
  } else {
    return false;
  }
  return true;
}

void collide_frames(const Shape& a, const Frame& frame_a, const Shape& b, const Frame& frame_b,
                    double margin, Manifolds& out) {
  if (common_pair(a, frame_a, b, frame_b, margin, out)) return;
  if (taken_apart(a, frame_a, b, frame_b, true, margin, out)) return;
  if (taken_apart(b, frame_b, a, frame_a, false, margin, out)) return;
  collide_leaves(a, frame_a, b, frame_b, margin, out);
}

}  // namespace

void collide(const Shape& a, const Frame& frame_a, const Shape& b, const Frame& frame_b,
             double margin, Manifolds& out) {
  collide_frames(a, frame_a, b, frame_b, margin, out);
}

void collide(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double margin,
             Manifolds& out) {
  if (const auto *ball_a = std::get_if<Sphere>(&a), *ball_b = std::get_if<Sphere>(&b);
      ball_a && ball_b)  // without the two matrices
    return two_balls(*ball_a, pose_a.position, *ball_b, pose_b.position, margin, out);
  collide_frames(a, Frame(pose_a), b, Frame(pose_b), margin, out);
}

Manifold collide(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                 double margin) {
  thread_local Manifolds all;
  all.clear();
  collide(a, pose_a, b, pose_b, margin, all);
  const auto depth = [](const Manifold& m) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < m.count; ++k) least = std::min(least, m.points[k].separation);
    return least;
  };
  const auto best = std::ranges::min_element(all, {}, depth);
  return best == all.end() ? Manifold{} : *best;
}

}  // namespace carom
