// SPDX-License-Identifier: Apache-2.0
// Time per continuous query, swept boxes overlapping, one thread. Peers and hard kinds beside them:
// `carom cost --study ccd`.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "carom/narrow/moving_triangle.hpp"

namespace {

constexpr std::size_t count = 4096;

// Points in a cube, each moving by up to its size; only queries whose swept boxes overlap.
// `grid` > 0 rounds to that many steps per unit: contacts on borders, coplanar motion, exact ends.
std::vector<double> overlapping(int first_points, int grid) {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> all;
  while (all.size() < 24 * count) {
    double q[24];
    for (int i = 0; i < 12; ++i) {
      q[i] = unit(random);
      q[12 + i] = q[i] + unit(random);
    }
    if (grid > 0)
      for (double& x : q) x = static_cast<double>(static_cast<int>(x * grid)) / grid;
    bool overlap = true;
    for (int k = 0; k < 3; ++k) {
      double low[2] = {9, 9}, high[2] = {-9, -9};
      for (int j = 0; j < 8; ++j) {
        const int side = j % 4 < first_points ? 0 : 1;
        low[side] = std::min(low[side], q[3 * j + k]);
        high[side] = std::max(high[side], q[3 * j + k]);
      }
      overlap = overlap && low[0] <= high[1] && low[1] <= high[0];
    }
    if (overlap) all.insert(all.end(), q, q + 24);
  }
  return all;
}

template <auto Query>
void run(benchmark::State& state, int first_points, int grid, carom::CcdOptions options) {
  const std::vector<double> queries = overlapping(first_points, grid);
  std::vector<std::uint8_t> hit(count), status(count);
  std::vector<double> time(count);
  const carom::CcdBatch out{hit, time, status};
  for (auto _ : state) {
    Query(queries, out, options);
    benchmark::DoNotOptimize(hit.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
  state.counters["hits"] = static_cast<double>(std::count(hit.begin(), hit.end(), 1)) / count;
  const auto certified = static_cast<std::uint8_t>(carom::CcdStatus::certified);
  state.counters["in_doubles"] =
      static_cast<double>(std::count(status.begin(), status.end(), certified)) / count;
}

constexpr auto point_triangle = [](const auto&... a) { carom::point_triangle(a...); };
constexpr auto edge_edge = [](const auto&... a) { carom::edge_edge(a...); };

void every_case(const char* name, auto* pt, auto* ee, int grid, carom::CcdOptions options) {
  benchmark::RegisterBenchmark((std::string("point_triangle/") + name).c_str(), pt, 1, grid,
                               options);
  benchmark::RegisterBenchmark((std::string("edge_edge/") + name).c_str(), ee, 2, grid, options);
}

const bool registered = [] {
  const auto pt = &run<point_triangle>, ee = &run<edge_edge>;
  every_case("random", pt, ee, 0, {});
  every_case("grid_of_eighths", pt, ee, 8, {});
  every_case("grid_of_halves", pt, ee, 2, {});
  every_case("random_thickness_0.01", pt, ee, 0, {.thickness = 0.01});
  every_case("random_lecture", pt, ee, 0, {.method = carom::CcdMethod::lecture});
  every_case("random_tolerance", pt, ee, 0, {.method = carom::CcdMethod::tolerance});
  return true;
}();

}  // namespace
