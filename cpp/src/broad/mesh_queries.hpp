// SPDX-License-Identifier: Apache-2.0
#pragma once
// What tree and grid share: checking input, making rays, handing results out.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "carom/broad/mesh_index.hpp"

#include "broad/triangle_queries.hpp"

namespace carom::broad {

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

/// The ray of a question, and how its parameter reads: answer = t unit (rays: m; segments:
/// fraction). A direction that is not 0, finite numbers. @returns true
inline bool ray_question(const double* origin, const double* direction, double max_distance,
                         Ray& ray, double& unit) {
  scale_step(direction, ray);
  for (int k = 0; k < 3; ++k) ray.start[k] = origin[k];
  prepare(ray);
  unit =
      std::sqrt(ray.step[0] * ray.step[0] + ray.step[1] * ray.step[1] + ray.step[2] * ray.step[2]);
  ray.t_max = max_distance / unit;
  return true;
}

/// Finite numbers. @returns false for a segment of no length
inline bool segment_question(const double* start, const double* end, Ray& ray, double& unit) {
  double step[3];
  for (int k = 0; k < 3; ++k) {
    ray.start[k] = start[k];
    step[k] = end[k] - start[k];
  }
  if (is_zero(step)) return false;
  const int exponent = scale_step(step, ray);
  prepare(ray);
  const bool usual = exponent > -1000 && exponent < 1000;
  ray.t_max = usual ? std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52)
                    : std::scalbn(1.0, exponent);
  unit = usual ? std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent) << 52)
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

/// Rays asked together, so that an index can let them wait for memory side by side.
inline constexpr Eigen::Index ray_block = 512;

/// Asks `ask(rays, count, answers)` block by block. `question(i, ray, unit)` makes ray i, or
/// returns false for none; `keep(i, unit, answer)` takes what was found.
template <class Answer, class Make, class Ask, class Keep>
void each_block(Eigen::Index count, Make question, Ask ask, Keep keep) {
  const auto room = static_cast<std::size_t>(std::min(count, ray_block));
  std::vector<Ray> rays(room);
  std::vector<Answer> answers(room);
  std::vector<std::pair<Eigen::Index, double>> asked(room);  // row and unit
  for (Eigen::Index begin = 0; begin < count; begin += ray_block) {
    std::size_t n = 0;
    for (Eigen::Index i = begin; i < std::min(count, begin + ray_block); ++i) {
      asked[n].first = i;
      if (question(i, rays[n], asked[n].second)) ++n;
    }
    ask(rays.data(), static_cast<int>(n), answers.data());
    for (std::size_t k = 0; k < n; ++k) keep(asked[k].first, asked[k].second, answers[k]);
  }
}

/// An index that answers ray by ray.
template <class Answer, class One>
auto one_by_one(One one) {
  return [one](const Ray* rays, int count, Answer* out) {
    for (int i = 0; i < count; ++i) out[i] = one(rays[i]);
  };
}

/// Asks `first(rays, count, out)` -> Nearest.
template <class First>
std::vector<RayHit> each_ray(Points origins, Points directions, double max_distance, First first) {
  require_same_rows(origins, "origins", directions, "directions");
  require_distance(max_distance);
  require_finite_rows(origins, "origins");
  require_directions(directions);
  std::vector<RayHit> out(static_cast<std::size_t>(origins.rows()));
  each_block<Nearest>(
      origins.rows(),
      [&](Eigen::Index i, Ray& ray, double& unit) {
        return ray_question(row_at(origins, i), row_at(directions, i), max_distance, ray, unit);
      },
      first,
      [&](Eigen::Index i, double unit, const Nearest& hit) {
        if (hit.face >= 0)
          out[static_cast<std::size_t>(i)] = {smaller(hit.t * unit, max_distance), hit.face};
      });
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
  each_block<std::uint8_t>(
      origins.rows(),
      [&](Eigen::Index i, Ray& ray, double& unit) {
        return ray_question(row_at(origins, i), row_at(directions, i), max_distance, ray, unit);
      },
      any,
      [&](Eigen::Index i, double, std::uint8_t hit) { out[static_cast<std::size_t>(i)] = hit; });
  return out;
}

template <class First>
std::vector<SegmentHit> each_segment(Points starts, Points ends, First first) {
  require_same_rows(starts, "starts", ends, "ends");
  require_segments(starts, ends);
  std::vector<SegmentHit> out(static_cast<std::size_t>(starts.rows()));
  each_block<Nearest>(
      starts.rows(),
      [&](Eigen::Index i, Ray& ray, double& unit) {
        return segment_question(row_at(starts, i), row_at(ends, i), ray, unit);
      },
      first,
      [&](Eigen::Index i, double unit, const Nearest& hit) {
        if (hit.face >= 0) out[static_cast<std::size_t>(i)] = {smaller(hit.t * unit, 1), hit.face};
      });
  return out;
}

template <class Any>
std::vector<std::uint8_t> each_blocked(Points starts, Points ends, Any any) {
  require_same_rows(starts, "starts", ends, "ends");
  require_segments(starts, ends);
  std::vector<std::uint8_t> out(static_cast<std::size_t>(starts.rows()), 0);
  each_block<std::uint8_t>(
      starts.rows(),
      [&](Eigen::Index i, Ray& ray, double& unit) {
        return segment_question(row_at(starts, i), row_at(ends, i), ray, unit);
      },
      any,
      [&](Eigen::Index i, double, std::uint8_t hit) { out[static_cast<std::size_t>(i)] = hit; });
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
