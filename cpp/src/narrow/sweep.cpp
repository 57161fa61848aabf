// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "carom/geometry/aabb.hpp"
#include "carom/narrow/moving_triangle.hpp"
#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"

#include "thick_contact.hpp"

namespace carom {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// A position is a quaternion exponential, a rotated vector and two sums: below 32 roundings of
// numbers no larger than |centre| + |displacement| + radius; its angle is off by a few units of
// roundoff of itself, which moves the point by that times radius. The rest is for widened boxes.
constexpr double pose_rounding = 64 * tolerance::unit_roundoff;

void require_body(const SweptBody& body, const std::string& name) {
  const auto check = [&](const auto& indices, const char* what) {
    if (indices.size() > 0 &&
        (indices.minCoeff() < 0 || indices.maxCoeff() >= body.mesh.vertices.rows()))
      throw InvalidInput(name + "." + what, with_unit(indices.maxCoeff(), ""),
                         "must index its vertices");
  };
  check(body.mesh.faces, "faces");
  check(body.edges, "edges");
  const ScrewMotion& m = body.motion;
  if (!body.mesh.vertices.allFinite()) throw InvalidInput(name + ".vertices", "", "must be finite");
  if (!m.centre.allFinite() || !m.displacement.allFinite() || !m.rotation.allFinite() ||
      !m.orientation.coeffs().allFinite())
    throw InvalidInput(name + ".motion", "", "must be finite");
}

// One body over one interval: its vertices at both ends, what chords leave out, boxes of features.
struct Chords {
  explicit Chords(const SweptBody& body_) : body(body_) {
    const auto& v = body.mesh.vertices;
    const double angle = body.motion.rotation.norm();
    const Eigen::Vector3d axis =
        angle > 0 ? Eigen::Vector3d(body.motion.orientation.conjugate() *
                                    Eigen::Vector3d(body.motion.rotation / angle))
                  : Eigen::Vector3d::Zero();
    double reach = 0;
    for (Eigen::Index i = 0; i < v.rows(); ++i) {
      const Eigen::Vector3d p = v.row(i);
      radius = std::max(radius, angle > 0 ? p.cross(axis).norm() : 0);
      reach = std::max(reach, p.norm());
    }
    rounding = pose_rounding *
               (body.motion.centre.norm() + body.motion.displacement.norm() + reach * (1 + angle));
    start.resize(static_cast<std::size_t>(v.rows()));
    end.resize(start.size());
  }

  void set(double s, double e) {
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Eigen::Vector3d p = body.mesh.vertices.row(static_cast<Eigen::Index>(i));
      start[i] = body.motion.position(p, s);
      end[i] = body.motion.position(p, e);
    }
    error = chord_error(radius, body.motion.rotation.norm() * (e - s)) + rounding;
  }

  template <int N>
  [[nodiscard]] Aabb box(const std::array<int, N>& corners) const {
    Aabb r;
    for (const int i : corners)
      for (const Points* p : {&start, &end}) r.extend((*p)[static_cast<std::size_t>(i)]);
    return r;
  }

  const SweptBody& body;
  double radius = 0;    // of the farthest vertex from the axis
  double rounding = 0;  // m
  double error = 0;     // m, of the current interval
  Points start, end;
};

// The features of one kind whose boxes, widened, meet a region.
template <int N>
struct Features {
  std::vector<int> index;
  std::vector<std::array<int, N>> corners;
  std::vector<Aabb> box;

  template <class Row>
  void collect(const Chords& chords, Eigen::Index count, const Row& row, double widen,
               const Aabb& region) {
    index.clear();
    corners.clear();
    box.clear();
    for (Eigen::Index i = 0; i < count; ++i) {
      std::array<int, N> c;
      for (int k = 0; k < N; ++k) c[static_cast<std::size_t>(k)] = row(i, k);
      const Aabb b = chords.box<N>(c).inflated(widen);
      if (!b.overlaps(region)) continue;
      index.push_back(static_cast<int>(i));
      corners.push_back(c);
      box.push_back(b);
    }
  }
};

struct BodyFeatures {
  Features<1> vertices;
  Features<2> edges;
  Features<3> faces;

  void collect(const Chords& c, double widen, const Aabb& region) {
    const auto& mesh = c.body.mesh;
    vertices.collect(
        c, mesh.vertices.rows(), [](Eigen::Index i, int) { return static_cast<int>(i); }, widen,
        region);
    edges.collect(
        c, c.body.edges.rows(), [&](Eigen::Index i, int k) { return c.body.edges(i, k); }, widen,
        region);
    faces.collect(
        c, mesh.faces.rows(), [&](Eigen::Index i, int k) { return mesh.faces(i, k); }, widen,
        region);
  }
};

Aabb whole(const Chords& c, double widen) {
  Aabb r;
  for (const Points* p : {&c.start, &c.end})
    for (const Eigen::Vector3d& x : *p) r.extend(x);
  return r.inflated(widen);
}

// The earliest contact of the chords; time in fractions of the interval, 1 and Kind::none if none.
template <int N, int M>
void try_pairs(const Chords& a, const Features<N>& of_a, const Chords& b, const Features<M>& of_b,
               double thickness, SweepResult::Kind kind, SweepResult& best) {
  for (std::size_t i = 0; i < of_a.index.size(); ++i)
    for (std::size_t j = 0; j < of_b.index.size(); ++j) {
      if (!of_a.box[i].overlaps(of_b.box[j])) continue;
      double query[24];
      int at = 0;
      const auto put = [&](const Chords& c, int corner) {
        const auto k = static_cast<std::size_t>(corner);
        Eigen::Map<Eigen::Vector3d>{query + at} = c.start[k];
        Eigen::Map<Eigen::Vector3d>{query + 12 + at} = c.end[k];
        at += 3;
      };
      // the point leads in a point-triangle query
      if constexpr (N == 3) {
        for (const int c : of_b.corners[j]) put(b, c);
        for (const int c : of_a.corners[i]) put(a, c);
      } else {
        for (const int c : of_a.corners[i]) put(a, c);
        for (const int c : of_b.corners[j]) put(b, c);
      }
      ++best.queries;
      const CcdHit hit = narrow::thick_contact < N == 2 ? 4 : 3 > (query, thickness);
      if (!hit.hit || (best.kind != SweepResult::Kind::none && hit.time >= best.time)) continue;
      best.time = hit.time;
      best.kind = kind;
      best.a = of_a.index[i];
      best.b = of_b.index[j];
    }
}

// Where surfaces cross, an edge of one passes through a face of the other: a point that runs along
// the edge meets the face. Corners and edges alone need not be near anything then. Exact, for the
// poses as computed; what they round away lies within the thickness of the first interval.
bool edge_crosses_face(const Chords& a, const Features<2>& edges, const Chords& b,
                       const Features<3>& faces, SweepResult::Kind kind, SweepResult& found) {
  for (std::size_t i = 0; i < edges.index.size(); ++i)
    for (std::size_t j = 0; j < faces.index.size(); ++j) {
      if (!edges.box[i].overlaps(faces.box[j])) continue;
      const auto at = [&](const Chords& c, int k) { return c.start[static_cast<std::size_t>(k)]; };
      MovingFour points;
      points.start.col(0) = at(a, edges.corners[i][0]);
      points.end.col(0) = at(a, edges.corners[i][1]);
      for (int k = 0; k < 3; ++k)
        points.start.col(k + 1) = points.end.col(k + 1) =
            at(b, faces.corners[j][static_cast<std::size_t>(k)]);
      ++found.queries;
      if (!point_triangle(points).hit) continue;
      found.status = SweepStatus::contact;
      found.time = 0;
      found.kind = kind;
      found.a = edges.index[i];
      found.b = faces.index[j];
      return true;
    }
  return false;
}

bool cross_at_start(Chords& a, BodyFeatures& of_a, Chords& b, BodyFeatures& of_b,
                    SweepResult& found) {
  using Kind = SweepResult::Kind;
  a.set(0, 0);
  b.set(0, 0);
  of_a.collect(a, 0, whole(b, 0));
  of_b.collect(b, 0, whole(a, 0));
  if (edge_crosses_face(a, of_a.edges, b, of_b.faces, Kind::edge_face, found)) return true;
  if (!edge_crosses_face(b, of_b.edges, a, of_a.faces, Kind::face_edge, found)) return false;
  std::swap(found.a, found.b);
  return true;
}

}  // namespace

Eigen::Vector3d ScrewMotion::position(const Eigen::Vector3d& p_b, double t) const {
  const Eigen::Vector3d turned = rotation_exponential(t * rotation) * (orientation * p_b);
  return centre + t * displacement + turned;
}

double chord_error(double radius, double angle) {
  return radius * angle * angle / 8;
}

SweptBody::Edges edges_of(const TriangleMesh::Faces& faces) {
  std::set<std::pair<int, int>> unique;
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) unique.insert(std::minmax(faces(f, k), faces(f, (k + 1) % 3)));
  SweptBody::Edges edges(static_cast<Eigen::Index>(unique.size()), 2);
  Eigen::Index row = 0;
  for (const auto& [i, j] : unique) edges.row(row++) << i, j;
  return edges;
}

SweepResult sweep(const SweptBody& a, const SweptBody& b, const SweepOptions& options) {
  require_body(a, "a");
  require_body(b, "b");
  require_non_negative(options.thickness, "thickness", "m");
  require_positive(options.tolerance, "tolerance", "m");
  if (options.max_intervals < 1)
    throw InvalidInput("max_intervals", with_unit(options.max_intervals, ""), "must be >= 1");
  SweepResult result;
  if (a.mesh.vertices.rows() == 0 || b.mesh.vertices.rows() == 0) return result;

  Chords chords_a(a), chords_b(b);
  BodyFeatures near_a, near_b;
  if (cross_at_start(chords_a, near_a, chords_b, near_b, result)) return result;
  // Chords of a large turn say nothing of the path between; start with an eighth of a turn at most.
  const double turn = std::max(a.motion.rotation.norm(), b.motion.rotation.norm());
  const double longest = std::min(1.0, tolerance::sweep_turn / std::max(turn, 1e-300));
  double width = longest, done = 0;
  while (done < 1) {
    if (result.intervals == options.max_intervals) {
      result.status = SweepStatus::interval_limit;
      result.time = done;
      return result;
    }
    ++result.intervals;
    const double end = std::min(1.0, done + width);
    chords_a.set(done, end);
    chords_b.set(done, end);
    const double error = chords_a.error + chords_b.error;
    const double thickness = options.thickness + error;
    const double widen = 0.5 * thickness * (1 + 8 * tolerance::unit_roundoff);
    near_a.collect(chords_a, widen, whole(chords_b, widen));
    near_b.collect(chords_b, widen, whole(chords_a, widen));
    SweepResult found;
    using Kind = SweepResult::Kind;
    try_pairs(chords_a, near_a.vertices, chords_b, near_b.faces, thickness, Kind::vertex_face,
              found);
    try_pairs(chords_a, near_a.faces, chords_b, near_b.vertices, thickness, Kind::face_vertex,
              found);
    try_pairs(chords_a, near_a.edges, chords_b, near_b.edges, thickness, Kind::edge_edge, found);
    result.queries += found.queries;
    if (found.kind == Kind::none) {
      done = end;
      width = std::min(2 * width, longest);
      continue;
    }
    // clear up to the hit, less the rounding of this product
    const double clear =
        std::max(done, done + found.time * (end - done) - 4 * tolerance::unit_roundoff);
    const bool as_fine_as_rounding = error <= 2 * (chords_a.rounding + chords_b.rounding);
    if (error <= options.tolerance / 4 || as_fine_as_rounding) {
      result.status = SweepStatus::contact;
      result.time = clear;
      result.kind = found.kind;
      result.a = found.a;
      result.b = found.b;
      return result;
    }
    done = clear;
    width = 0.5 * (end - done > 0 ? std::min(width, end - done) : width);
  }
  return result;
}

}  // namespace carom
