// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/moving_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "carom/numerics/invalid_input.hpp"

#include "contact_filter.hpp"
#include "exact_contact.hpp"
#include "float_contact.hpp"
#include "thick_contact.hpp"

namespace carom {
namespace {

using namespace narrow;

constexpr std::size_t doubles_per_query = 24;

template <int Corners>
ContactFilter pick_filter() {
#if defined(__x86_64__) && defined(__GNUC__)
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (wide) return Corners == 3 ? avx2::filter_point_triangle : avx2::filter_edge_edge;
#endif
  return Corners == 3 ? portable::filter_point_triangle : portable::filter_edge_edge;
}

void require_finite_queries(std::span<const double> queries) {
  // x - x is 0 for every finite x and NaN otherwise: one test for a whole batch
  double poison = 0;
  for (const double x : queries) poison += x - x;
  if (poison == 0) return;
  const auto bad =
      std::find_if_not(queries.begin(), queries.end(), [](double x) { return std::isfinite(x); });
  const auto at = static_cast<std::size_t>(bad - queries.begin());
  throw InvalidInput("queries[" + std::to_string(at / doubles_per_query) + "]",
                     with_unit(*bad, "m"), "must be finite", "drop the query or freeze its body");
}

// Sizes near the ends of the double range: scaled by a power of two into the filter's range. What
// underflows on the way is below 2^-1074 of the largest coordinate; the filter's bounds cover that.
template <int Corners>
Verdict filter_rescaled(ContactFilter filter, const double* query, double& time) {
  double top = 0;
  for (std::size_t i = 0; i < doubles_per_query; ++i) top = std::max(top, std::fabs(query[i]));
  if (top == 0 || (top > 0x1p-250 && top < 0x1p250)) return verdict_undecided;
  const int exponent = std::ilogb(top);
  double scaled[doubles_per_query];
  for (std::size_t i = 0; i < doubles_per_query; ++i) scaled[i] = std::ldexp(query[i], -exponent);
  std::uint8_t verdict;
  filter(scaled, 1, &verdict, &time);
  return static_cast<Verdict>(verdict);
}

template <int Corners>
void run(std::span<const double> queries, const CcdBatch& out, const CcdOptions& options) {
  const std::size_t count = queries.size() / doubles_per_query;
  if (queries.size() % doubles_per_query != 0 || out.hit.size() != count ||
      out.time.size() != count || out.status.size() != count)
    throw InvalidInput("queries", with_unit(queries.size(), "doubles"),
                       "must be 24 per query, with one output entry each");
  require_non_negative(options.thickness, "thickness", "m");
  require_finite_queries(queries);
  const auto store = [&](std::size_t i, const CcdHit& h) {
    out.hit[i] = h.hit;
    out.time[i] = h.time;
    out.status[i] = static_cast<std::uint8_t>(h.status);
  };
  const double* query = queries.data();
  if (options.method != CcdMethod::certified) {
    for (std::size_t i = 0; i < count; ++i)
      store(i, float_contact<Corners>(query + doubles_per_query * i, options));
    return;
  }
  if (options.thickness > 0) {
    for (std::size_t i = 0; i < count; ++i)
      store(i, thick_contact<Corners>(query + doubles_per_query * i, options.thickness));
    return;
  }
  static const ContactFilter filter = pick_filter<Corners>();
  filter(query, count, out.hit.data(), out.time.data());
  std::fill(out.status.begin(), out.status.end(), static_cast<std::uint8_t>(CcdStatus::certified));
  for (std::size_t i = 0; i < count; ++i, query += doubles_per_query) {
    if (out.hit[i] != verdict_undecided) continue;
    out.hit[i] = filter_rescaled<Corners>(filter, query, out.time[i]);
    if (out.hit[i] != verdict_undecided) continue;
    const ExactContact e = exact_contact<Corners>(query);
    store(i, {e.hit, e.time, e.coplanar ? CcdStatus::coplanar : CcdStatus::exact});
  }
}

template <int Corners>
CcdHit run_one(const MovingFour& points, const CcdOptions& options) {
  double query[doubles_per_query];
  std::memcpy(query, points.start.data(), 12 * sizeof(double));
  std::memcpy(query + 12, points.end.data(), 12 * sizeof(double));
  CcdHit hit;
  std::uint8_t found, status;
  run<Corners>(query, {{&found, 1}, {&hit.time, 1}, {&status, 1}}, options);
  hit.hit = found != 0;
  hit.status = static_cast<CcdStatus>(status);
  return hit;
}

}  // namespace

CcdHit point_triangle(const MovingFour& points, const CcdOptions& options) {
  return run_one<3>(points, options);
}

CcdHit edge_edge(const MovingFour& points, const CcdOptions& options) {
  return run_one<4>(points, options);
}

void point_triangle(std::span<const double> queries, const CcdBatch& out,
                    const CcdOptions& options) {
  run<3>(queries, out, options);
}

void edge_edge(std::span<const double> queries, const CcdBatch& out, const CcdOptions& options) {
  run<4>(queries, out, options);
}

}  // namespace carom
