// SPDX-License-Identifier: Apache-2.0
#include "contact/choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "carom/numerics/tolerance.hpp"

#include "contact/small_steps.hpp"

namespace carom::contact {
namespace {

// Small steps: the least, the most of large islands, the most of those that can afford it.
constexpr int few = 8, many = 12, most = 32;
constexpr int most_fine_bodies = 500;
// Large islands sink by a mean of soft_sink at most, fine ones by a quarter: twice the small steps.
// Layers add their sinks up, and a wall leans by what one side sinks more than the other.
constexpr double fine_share = 0.25;
// An island keeps its small steps while what it would want now lies within these shares of them: a
// heap whose stiffness changes with every step is never still.
constexpr double keep_from = 0.75, keep_to = 1.15;
constexpr int most_direct_bodies = 300;
constexpr int sampled_patches = 4;  // every fourth: 300 bodies have two hundred of them at least
constexpr int newton_least = 40;    // a hit from rest takes up to 15 outer rounds of two or three

}  // namespace

// At rest a soft point of effective mass m carries the force m omega^2 depth.
SinkEstimate soft_sink(const Islands& islands, const Island& island, const BodyStates& states,
                       const BodyFrames& frames, std::span<const Contact> contacts, double dt,
                       int substeps) {
  SinkEstimate sink;
  int loaded = 0;
  // Of an island too large for a direct solve only the mean is wanted: some of its patches tell it.
  const int stride = island.bodies > most_direct_bodies ? sampled_patches : 1;
  for (int i = 0; i < island.patches; i += stride) {
    const Patch& p = islands.patches[island.first_patch + i];
    const bool against_static = !states.moves[p.a] || !states.moves[p.b];
    const double omega = 2 * std::numbers::pi * softness(substeps, dt, against_static).frequency;
    for (int k = p.first; k < p.first + p.count; ++k) {
      const Contact& c = contacts[k];
      const double force = c.impulse.dot(c.normal) / dt;
      if (!(force > 0)) continue;
      const double w = mobility_along(states.inverse_mass[p.a], frames.inverse_inertia[p.a],
                                      c.position - states.position[p.a], c.normal) +
                       mobility_along(states.inverse_mass[p.b], frames.inverse_inertia[p.b],
                                      c.position - states.position[p.b], c.normal);
      const double depth = force * w / (omega * omega);
      sink.worst = std::max(sink.worst, depth);
      sink.mean += depth;
      ++loaded;
    }
  }
  if (loaded > 0) sink.mean /= loaded;
  return sink;
}

// The sink falls with the square of the number.
int small_steps_for(const SinkEstimate& sink_at_few, int bodies, int before) {
  const bool fine = bodies <= most_fine_bodies;
  const double target = tolerance::soft_sink * (fine ? fine_share : 1);
  // Set up at rest: the loads are not known yet, and sagging under too few would move it.
  if (before == 0 && sink_at_few.mean == 0) return fine ? most : many;
  const double wanted = few * std::sqrt(sink_at_few.mean / target);
  if (before > 0 && wanted >= keep_from * before && wanted <= keep_to * before) return before;
  return std::clamp(static_cast<int>(std::ceil(wanted)), few, fine ? most : many);
}

// Fill grows with the patches a body has: 2 blocks a body in a chain, 9 in a wall (measured).
double newton_seconds(const Island& island) {
  const double patches = static_cast<double>(island.patches) / std::max(island.bodies, 1);
  return 1e-6 * island.bodies * (1 + patches * patches) + 0.15e-6 * island.points;
}

Choice choose(const Islands& islands, const Island& island, const BodyStates& states,
              const BodyFrames& frames, std::span<const Contact> contacts, double dt,
              const SolverOptions& options, const SolverMemory& memory) {
  Choice choice;
  const SinkEstimate sink = soft_sink(islands, island, states, frames, contacts, dt, few);
  int before = 0;
  for (int i = 0; i < island.bodies; ++i)
    before = std::max<int>(before, memory.substeps[islands.bodies[island.first_body + i]]);
  choice.substeps =
      options.substeps > 0 ? options.substeps : small_steps_for(sink, island.bodies, before);
  const double each = newton_seconds(island);
  choice.newton_cap = std::max(newton_least, static_cast<int>(4 * options.direct_budget / each));
  if (options.choice != SolverChoice::automatic) {
    choice.direct = options.choice == SolverChoice::direct;
    if (choice.direct) choice.newton_cap = std::max(choice.newton_cap, 1000);
    return choice;
  }
  int newton = 4, held_off = 0;
  bool was_direct = false;
  for (int i = 0; i < island.bodies; ++i) {
    const int row = islands.bodies[island.first_body + i];
    newton = std::max<int>(newton, memory.newton[row]);
    held_off = std::max<int>(held_off, memory.held_off[row]);
    was_direct |= memory.direct[row] != 0;
  }
  if (held_off > 0 || island.bodies > most_direct_bodies) return choice;
  const double cost = each * newton;
  const bool hard = sink.worst > tolerance::soft_sink * (was_direct ? 0.5 : 1.0);
  if (hard)
    choice.direct = cost <= options.direct_budget;
  else
    choice.easy_cost = cost;
  return choice;
}

double most_easy_cost(std::span<double> costs, double budget) {
  std::ranges::sort(costs);
  double most = 0;
  for (std::size_t i = 0; i < costs.size();) {
    const double each = costs[i];
    for (; i < costs.size() && costs[i] == each; ++i) budget -= each;
    if (budget < 0) break;
    most = each;
  }
  return most;
}

}  // namespace carom::contact
