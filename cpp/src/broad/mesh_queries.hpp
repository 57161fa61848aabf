// SPDX-License-Identifier: Apache-2.0
#pragma once
// What tree and grid share: checking input, making rays, handing results out.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "carom/broad/mesh_index.hpp"

#include "broad/triangle_queries.hpp"

namespace carom::broad {

/// A ray and how its parameter reads in the units of the question.
struct Question {
  Ray ray;
  double unit;  ///< answer = t unit (rays: m; segments: fraction)
};

/// Exact: a power of two brings the largest component of `step` into [1/2, 1). Its exponent.
inline int scale_step(const double* step, Ray& ray) {
  const double largest = larger(std::abs(step[0]), larger(std::abs(step[1]), std::abs(step[2])));
  const auto biased = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52);
  if (biased > 2 && biased < 2000) {
    const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(2045 - biased) << 52);
    for (int k = 0; k < 3; ++k) ray.step[k] = step[k] * scale;
    return biased - 1022;
  }
  int exponent = 0;  // denormals and the largest numbers: the factor itself would leave the range
  std::frexp(largest, &exponent);
  for (int k = 0; k < 3; ++k) ray.step[k] = std::scalbn(step[k], -exponent);
  return exponent;
}

inline const double* row_at(const Points& rows, Eigen::Index i) {
  return rows.data() + i * rows.outerStride();
}

inline bool is_zero(const double* v) {
  return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

/// A direction that is not 0, finite numbers.
inline void ray_question(const double* origin, const double* direction, double max_distance,
                         Question& q) {
  scale_step(direction, q.ray);
  for (int k = 0; k < 3; ++k) q.ray.start[k] = origin[k];
  prepare(q.ray);
  q.unit = std::sqrt(q.ray.step[0] * q.ray.step[0] + q.ray.step[1] * q.ray.step[1] +
                     q.ray.step[2] * q.ray.step[2]);
  q.ray.t_max = max_distance / q.unit;
}

/// Finite numbers. @returns false for a segment of no length
inline bool segment_question(const double* start, const double* end, Question& q) {
  double step[3];
  for (int k = 0; k < 3; ++k) {
    q.ray.start[k] = start[k];
    step[k] = end[k] - start[k];
  }
  if (is_zero(step)) return false;
  const int exponent = scale_step(step, q.ray);
  prepare(q.ray);
  const bool usual = exponent > -1000 && exponent < 1000;
  q.ray.t_max = usual ? std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52)
                      : std::scalbn(1.0, exponent);
  q.unit = usual ? std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent) << 52)
                 : std::scalbn(1.0, -exponent);
  return true;
}

/// @throws InvalidInput naming the first row that is not finite
void require_finite_rows(Points rows, const char* name);
void require_directions(Points directions);
/// Ends so far apart that their difference overflows are refused too.
void require_segments(Points starts, Points ends);
void require_same_rows(Points a, const char* a_name, Points b, const char* b_name);
void require_distance(double max_distance);
void require_finite_row(const Eigen::Vector3d& v, const char* name, Eigen::Index row);

/// Faces as rows of three, checked against the vertices. @throws InvalidInput
void require_mesh(const Eigen::Ref<const TriangleMesh::Vertices>& vertices,
                  const Eigen::Ref<const TriangleMesh::Faces>& faces);
void require_finite_vertices(const Eigen::Ref<const TriangleMesh::Vertices>& vertices);

/// Asks `first(ray)` -> Nearest for each ray.
template <class First>
std::vector<RayHit> each_ray(Points origins, Points directions, double max_distance, First first) {
  require_same_rows(origins, "origins", directions, "directions");
  require_distance(max_distance);
  require_finite_rows(origins, "origins");
  require_directions(directions);
  std::vector<RayHit> out(static_cast<std::size_t>(origins.rows()));
  Question q;
  for (Eigen::Index i = 0; i < origins.rows(); ++i) {
    ray_question(row_at(origins, i), row_at(directions, i), max_distance, q);
    const Nearest hit = first(q.ray);
    if (hit.face >= 0)
      out[static_cast<std::size_t>(i)] = {smaller(hit.t * q.unit, max_distance), hit.face};
  }
  return out;
}

template <class Any>
std::vector<std::uint8_t> each_any(Points origins, Points directions, double max_distance,
                                   Any any) {
  require_same_rows(origins, "origins", directions, "directions");
  require_distance(max_distance);
  require_finite_rows(origins, "origins");
  require_directions(directions);
  std::vector<std::uint8_t> out(static_cast<std::size_t>(origins.rows()));
  Question q;
  for (Eigen::Index i = 0; i < origins.rows(); ++i) {
    ray_question(row_at(origins, i), row_at(directions, i), max_distance, q);
    out[static_cast<std::size_t>(i)] = any(q.ray);
  }
  return out;
}

template <class First>
std::vector<SegmentHit> each_segment(Points starts, Points ends, First first) {
  require_same_rows(starts, "starts", ends, "ends");
  require_segments(starts, ends);
  std::vector<SegmentHit> out(static_cast<std::size_t>(starts.rows()));
  Question q;
  for (Eigen::Index i = 0; i < starts.rows(); ++i) {
    if (!segment_question(row_at(starts, i), row_at(ends, i), q)) continue;
    const Nearest hit = first(q.ray);
    if (hit.face >= 0) out[static_cast<std::size_t>(i)] = {smaller(hit.t * q.unit, 1), hit.face};
  }
  return out;
}

template <class Any>
std::vector<std::uint8_t> each_blocked(Points starts, Points ends, Any any) {
  require_same_rows(starts, "starts", ends, "ends");
  require_segments(starts, ends);
  std::vector<std::uint8_t> out(static_cast<std::size_t>(starts.rows()), 0);
  Question q;
  for (Eigen::Index i = 0; i < starts.rows(); ++i)
    if (segment_question(row_at(starts, i), row_at(ends, i), q))
      out[static_cast<std::size_t>(i)] = any(q.ray);
  return out;
}

/// `all(box, faces)` appends the faces of one box, in any order, each once.
template <class All>
Overlaps each_box(Points lower, Points upper, All all) {
  require_same_rows(lower, "lower", upper, "upper");
  Overlaps out;
  for (Eigen::Index i = 0; i < lower.rows(); ++i) {
    double box[6];
    bool some = true;
    for (int k = 0; k < 3; ++k) {
      box[k] = lower(i, k);
      box[3 + k] = upper(i, k);
      some = some && box[k] <= box[3 + k];
    }
    if (lower.row(i).hasNaN() || upper.row(i).hasNaN())
      require_finite_row(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()),
                         "lower or upper", i);
    const std::size_t begin = out.faces.size();
    if (some) all(box, out.faces);
    std::sort(out.faces.begin() + static_cast<std::ptrdiff_t>(begin), out.faces.end());
    out.offsets.push_back(static_cast<int>(out.faces.size()));
  }
  return out;
}

/// `nearest(point, best, at)` finds the squared distance, face and point.
template <class Find>
std::vector<ClosestPoint> each_point(Points points, Find nearest) {
  std::vector<ClosestPoint> out(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d p = points.row(i);
    require_finite_row(p, "points", i);
    Nearest best{std::numeric_limits<double>::infinity(), -1};
    Eigen::Vector3d at = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    nearest(p.data(), best, at.data());
    if (best.face >= 0) out[static_cast<std::size_t>(i)] = {std::sqrt(best.t), best.face, at};
  }
  return out;
}

}  // namespace carom::broad
