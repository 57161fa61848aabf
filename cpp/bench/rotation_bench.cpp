// SPDX-License-Identifier: Apache-2.0
// Time per body of one step: rotation alone, by each method that runs in lanes, and a whole step of
// a scene of free bodies, with all that such a scene calls for. items_per_second counts bodies.
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "carom/numerics/rotation.hpp"
#include "carom/step/rotation.hpp"
#include "carom/step/simulation.hpp"

namespace {

constexpr int bodies = 10000;

void rotation_alone(benchmark::State& state, carom::Integrator method) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> q[4], l[3], a[3];
  for (int i = 0; i < bodies; ++i) {
    const Eigen::Quaterniond at = carom::rotation_exponential(
        Eigen::Vector3d(normal(random), normal(random), normal(random)));
    for (int k = 0; k < 4; ++k) q[k].push_back(at.coeffs()[k]);
    for (int k = 0; k < 3; ++k) l[k].push_back(normal(random)), a[k].push_back(1.0 / (1 + k));
  }
  const carom::RotationArrays arrays{q[0].data(), q[1].data(), q[2].data(), q[3].data(),
                                     l[0].data(), l[1].data(), l[2].data(), a[0].data(),
                                     a[1].data(), a[2].data()};
  carom::RotationReport report;
  for (auto _ : state) carom::advance_rotation(method, arrays, 0, bodies, 1.0 / 60, report);
  state.SetItemsProcessed(state.iterations() * bodies);
  state.SetLabel(std::string(carom::rotation_cpu_level()));
}
BENCHMARK_CAPTURE(rotation_alone, lecture_quaternion, carom::Integrator::lecture_quaternion);
BENCHMARK_CAPTURE(rotation_alone, lecture_exponential, carom::Integrator::lecture_exponential);
BENCHMARK_CAPTURE(rotation_alone, midpoint, carom::Integrator::midpoint);
BENCHMARK_CAPTURE(rotation_alone, cayley, carom::Integrator::cayley);
BENCHMARK_CAPTURE(rotation_alone, symmetric_top, carom::Integrator::symmetric_top);
BENCHMARK_CAPTURE(rotation_alone, symmetric_top_4, carom::Integrator::symmetric_top_4);

/// Free bricks under gravity, far apart. `stages` of the report tell how the time divides.
void whole_step(benchmark::State& state, bool drag) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> size(0.2, 0.8), speed(-0.5, 0.5), turn(-5, 5);
  carom::Scene scene;
  scene.effects.emplace_back(carom::UniformGravity{});
  if (drag)
    scene.effects.emplace_back(carom::LinearDrag{.coefficient = 1, .angular_coefficient = 0.1});
  for (int i = 0; i < bodies; ++i)
    scene.add({.shape = carom::Box{{size(random), size(random), size(random)}},
               .pose = {{5.0 * (i % 22), 5.0 * (i / 22 % 22), 5.0 * (i / 484)},
                        Eigen::Quaterniond::Identity()},
               .velocity = {speed(random), speed(random), speed(random)},
               .angular_velocity = {turn(random), turn(random), turn(random)}});
  carom::Simulation simulation(scene);
  for (auto _ : state) simulation.step();
  state.SetItemsProcessed(state.iterations() * bodies);
  for (const carom::StageTime& stage : simulation.report().stages)
    state.counters[stage.stage + "_ns"] =
        1e9 * stage.seconds / static_cast<double>(simulation.report().steps) / bodies;
}
BENCHMARK_CAPTURE(whole_step, gravity, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(whole_step, gravity_and_drag, true)->Unit(benchmark::kMicrosecond);

}  // namespace
