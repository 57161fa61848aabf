// SPDX-License-Identifier: Apache-2.0
// One step of the broad phase (update and all pairs). The boxes are those of bench/peers/bvh, about
// one pair per box: drift = every box moves about 3 % of its size per step; settled = a resting
// pile, jitter of 0.1 mm, about six pairs per box; few = one in a hundred drifts.
#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "carom/broad/box_tree.hpp"

namespace {

struct Random {
  std::uint64_t state = 0x9E3779B97F4A7C15ULL;
  double operator()() {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<double>(state >> 11) * 0x1p-53;
  }
};

enum Motion { drift, settled, few };

struct World {
  std::vector<carom::Aabb> boxes;
  std::vector<Eigen::Vector3d> centre, velocity, half;
  std::vector<std::uint8_t> moves;
  double side;
  Random random;
  Motion motion;

  World(int n, Motion how) : side(std::cbrt(n * (how == settled ? 0.7 : 4.0))), motion(how) {
    for (int i = 0; i < n; ++i) {
      Eigen::Vector3d c, v, h;
      for (int k = 0; k < 3; ++k) {
        c[k] = random() * side;
        v[k] = (random() - 0.5) * 0.1;
        h[k] = 0.3 + 0.4 * random();
      }
      if (motion == few && i % 100 != 0) v.setZero();
      centre.push_back(c);
      velocity.push_back(v);
      half.push_back(h);
      moves.push_back(1);
    }
    boxes.resize(centre.size());
    place();
  }
  void place() {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      boxes[i] = {centre[i] - half[i], centre[i] + half[i]};
  }
  void step() {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (motion == settled) {
        const Eigen::Vector3d shake(random() - 0.5, random() - 0.5, random() - 0.5);
        boxes[i] = {centre[i] - half[i] + 1e-4 * shake, centre[i] + half[i] + 1e-4 * shake};
        continue;
      }
      centre[i] += velocity[i];
      for (int k = 0; k < 3; ++k)
        if (centre[i][k] < 0 || centre[i][k] > side) velocity[i][k] = -velocity[i][k];
    }
    if (motion != settled) place();
  }
};

void box_tree(benchmark::State& state) {
  World world(static_cast<int>(state.range(0)), static_cast<Motion>(state.range(1)));
  carom::BoxTree tree;
  for (int i = 0; i < 3; ++i) tree.update(world.boxes, world.moves), world.step();
  std::size_t pairs = 0;
  for (auto _ : state) {
    state.PauseTiming();
    world.step();
    state.ResumeTiming();
    pairs = tree.update(world.boxes, world.moves).size();
  }
  const carom::BoxTree::Counters& c = tree.counters();
  const auto updates = static_cast<double>(c.updates);
  state.counters["pairs"] = static_cast<double>(pairs);
  state.counters["candidates"] = static_cast<double>(c.candidates);
  state.counters["full"] = static_cast<double>(c.full_passes) / updates;
  state.counters["builds"] = static_cast<double>(c.builds) / updates;
  state.counters["left"] = static_cast<double>(c.refattened) / updates;
}
BENCHMARK(box_tree)
    ->ArgsProduct({{1000, 10000, 100000}, {drift, settled, few}})
    ->ArgNames({"boxes", "motion"})
    ->Unit(benchmark::kMillisecond);

void build(benchmark::State& state) {
  World world(static_cast<int>(state.range(0)), drift);
  for (auto _ : state) {
    carom::BoxTree tree;
    benchmark::DoNotOptimize(tree.update(world.boxes, world.moves).size());
  }
}
BENCHMARK(build)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
