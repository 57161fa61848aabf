// SPDX-License-Identifier: Apache-2.0
#include "narrow/advance.hpp"

#include <algorithm>
#include <cmath>

#include "carom/geometry/separation.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom::narrow {
namespace {

using Eigen::Vector3d;

Frame frame_at(const MovingPart& part, double t) {
  return Frame(part.path->pose_at(t)) * part.in_body;
}

/// Support of a grown part along a unit direction, world.
double reach_along(const MovingPart& part, const Frame& frame, const Vector3d& n) {
  return n.dot(frame * part.convex.support(frame.rotation.transpose() * n)) + part.convex.radius;
}

/// Gap between the planes that support the parts along a fixed n, from a to b.
double gap_along(const MovingPart& a, const MovingPart& b, const Vector3d& n, double t) {
  const double of_b = -reach_along(b, frame_at(b, t), -n);
  if (a.half_space) return of_b - n.dot(a.path->centre_at(t)) - a.offset;
  return of_b - reach_along(a, frame_at(a, t), n);
}

/// How the gap along n can shrink from t on: speed s + c h, and by which share of it turning bends.
struct Closing {
  double speed = 0;         ///< m/s, of any two points, at t
  double acceleration = 0;  ///< m/s^2, of the centres
  double bend = 0;          ///< m/s^2, w^2 r of both

  Closing(const MovingPart& a, const MovingPart& b, const Vector3d& n, double t) {
    speed = n.dot(a.path->velocity_at(t) - b.path->velocity_at(t));
    acceleration = n.dot(a.path->acceleration - b.path->acceleration);
    for (const MovingPart* part : {&a, &b}) {
      const Vector3d& w = part->path->arc_at(t).rate;
      speed += n.cross(w).norm() * part->arm;
      bend += w.squaredNorm() * part->arm;
    }
  }
  /// First h > 0 at which the closing speeds have used up `room`; infinite when never.
  [[nodiscard]] double time_for(double room) const {
    const double inf = std::numeric_limits<double>::infinity();
    if (acceleration == 0) return speed > 0 ? room / speed : inf;
    const double discriminant = speed * speed + 2 * acceleration * room;
    if (discriminant < 0) return inf;
    // The citardauq form keeps its digits where the acceleration is small.
    const double h = 2 * room / (speed + std::sqrt(discriminant));
    return h > 0 ? h : inf;
  }
};

/// Most the parts can come nearer over the rest, in any direction.
double most_closing(const MovingPart& a, const MovingPart& b, double t, double end) {
  const Vector3d v = b.path->velocity_at(t) - a.path->velocity_at(t);
  const Vector3d w = b.path->velocity_at(end) - a.path->velocity_at(end);
  const double speed = std::max(v.norm(), w.norm());
  return (speed + a.spin * a.arm + b.spin * b.arm) * (end - t);
}

/// The longest stride from t, no longer than `most`, over which the dip below the chord is covered.
double stride(const MovingPart& a, const MovingPart& b, const FirstContact& here, double target,
              double t, double least, double most, const Closing& closing) {
  const double curve = closing.bend + std::max(0.0, -closing.acceleration);
  for (double h = most; h > 2 * least; h *= 0.5) {
    const double dip = curve * h * h / 8;
    if (here.gap - target < dip) continue;
    if (gap_along(a, b, here.normal, t + h) - target >= dip) return h;
  }
  return least;
}

}  // namespace

double fastest_spin(const BodyPath& path) {
  double square = 0;
  for (const BodyPath::Arc& arc : path.arcs) square = std::max(square, arc.rate.squaredNorm());
  return std::sqrt(square);
}

MovingPart MovingPart::of(const Convex& convex, const Frame& in_body, const BodyPath& path,
                          double spin) {
  MovingPart part;
  part.spin = spin;
  part.convex = convex;
  part.in_body = in_body;
  part.path = &path;
  if (convex.kind == Convex::Kind::points)
    for (const Vector3d& p : convex.corners())
      part.arm = std::max(part.arm, (in_body * p - path.com_b).norm());
  else
    part.arm = (in_body.translation - path.com_b).norm() + convex.bounding_radius() - convex.radius;
  return part;
}

FirstContact gap_at(const MovingPart& a, const MovingPart& b, double t, double beyond) {
  FirstContact out;
  out.time = t;
  out.queries = 1;
  const Frame of_b = frame_at(b, t);
  if (a.half_space) {
    const Pose pose = a.path->pose_at(t);
    out.normal = pose.orientation * a.normal_b;
    const Vector3d tip = of_b * b.convex.support(of_b.rotation.transpose() * -out.normal) -
                         b.convex.radius * out.normal;
    out.gap = out.normal.dot(tip - pose.position) - a.offset;
    out.point = tip - 0.5 * out.gap * out.normal;
    return out;
  }
  const Frame of_a = frame_at(a, t);
  const Separation s = separation(a.convex, b.convex, relative(of_a, of_b), beyond);
  out.gap = s.distance;
  out.normal = of_a.rotation * s.normal;
  out.point = of_a * (0.5 * (s.point_a + s.point_b));
  return out;
}

void advance(const MovingPart& a, const MovingPart& b, double from, double end, double target,
             FirstContact& best) {
  double t = from;
  if (best.status != FirstContact::Status::clear) end = std::min(end, best.time);
  for (int i = 0; t < end || i == 0; ++i) {
    const double most = most_closing(a, b, t, end);
    FirstContact here = gap_at(a, b, t, most + std::max(target, 0.0));
    ++best.queries;
    best.gap = std::min(best.gap, here.gap);
    const double room = here.gap - target;
    if (room > most) return;
    const bool touches = room <= 0.5 * tolerance::sweep_clear;
    if (touches || i == tolerance::sweep_queries) {
      here.status = touches ? FirstContact::Status::contact : FirstContact::Status::gave_up;
      here.queries = best.queries;
      here.gap = best.gap;
      best = here;
      return;
    }
    const double until = std::min(a.path->arc_end(t, end), b.path->arc_end(t, end));
    const Closing closing(a, b, here.normal, t);
    const double sure = closing.time_for(room);
    t = sure >= until - t ? until : t + stride(a, b, here, target, t, sure, until - t, closing);
  }
}

}  // namespace carom::narrow
