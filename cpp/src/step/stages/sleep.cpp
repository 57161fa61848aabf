// SPDX-License-Identifier: Apache-2.0
// Islands at rest: their bodies count as still until something awake may touch them.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "carom/narrow/contacts.hpp"
#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

double fastest_point(const World& world, int i) {
  return world.states.velocity[i].norm() +
         world.states.angular_velocity(i).norm() * bounding_radius(world.scene.bodies[i].shape);
}

bool sleeps(const World& world, int i) {
  return i < static_cast<int>(world.asleep.size()) && world.asleep[i];
}

void lay_down(World& world, int i, std::int32_t bed) {
  world.asleep[i] = 1;
  world.bed[i] = bed;
  world.dissipated += world.states.kinetic_energy(i);
  world.states.velocity.set(i, Eigen::Vector3d::Zero());
  world.states.angular_momentum.set(i, Eigen::Vector3d::Zero());
  world.states.moves[i] = 0;
  world.plan_is_stale = true;
}

}  // namespace

void fall_asleep(World& world) {
  if (!(world.options.sleep_after < std::numeric_limits<double>::infinity())) return;
  const int n = world.states.size();
  world.asleep.resize(n, 0), world.bed.resize(n, -1), world.still.resize(n, 0);
  const std::vector<std::int32_t>& island = world.solver.memory.island;
  // The least still body decides for its island: its time is kept at the island's lowest row.
  world.island_still.assign(n, std::numeric_limits<double>::infinity());
  for (const int i : world.plan.movers) {
    world.still[i] =
        fastest_point(world, i) < world.options.sleep_speed ? world.still[i] + world.dt : 0.0;
    if (i < static_cast<int>(island.size()) && island[i] >= 0)
      world.island_still[island[i]] = std::min(world.island_still[island[i]], world.still[i]);
  }
  bool any = false;
  for (const int i : world.plan.movers) {
    if (i >= static_cast<int>(island.size()) || island[i] < 0) continue;
    if (world.island_still[island[i]] < world.options.sleep_after) continue;
    lay_down(world, i, island[i]);
    any = true;
  }
  if (any) {
    const auto rests = [&](const Contact& c) { return sleeps(world, c.a) || sleeps(world, c.b); };
    std::ranges::copy_if(world.contacts, std::back_inserter(world.asleep_contacts), rests);
    std::erase_if(world.contacts, rests);
  }
  world.report.contact.asleep = static_cast<int>(std::ranges::count(world.asleep, 1));
}

void wake(World& world, int row) {
  if (row >= 0 && !sleeps(world, row)) return;
  const std::int32_t bed = row >= 0 ? world.bed[row] : -1;
  const auto wakes = [&](int i) { return sleeps(world, i) && (row < 0 || world.bed[i] == bed); };
  // They start again from the impulses they slept with.
  const auto woken = [&](const Contact& c) { return wakes(c.a) || wakes(c.b); };
  std::ranges::copy_if(world.asleep_contacts, std::back_inserter(world.contacts), woken);
  std::erase_if(world.asleep_contacts, woken);
  std::ranges::sort(world.contacts, {}, [](const Contact& c) { return std::pair(c.a, c.b); });
  for (int i = 0; i < static_cast<int>(world.asleep.size()); ++i) {
    if (!wakes(i)) continue;
    world.states.moves[i] = 1;
    world.plan.movers.push_back(i);
    world.still[i] = 0;
    world.bed[i] = -1;
    world.asleep[i] = 0;
  }
  std::ranges::sort(world.plan.movers);
  world.plan_is_stale = true;
}

bool wake_touched(World& world) {
  if (world.asleep.empty() || std::ranges::count(world.asleep, 1) == 0) return false;
  bool any = false;
  for (bool again = true; again;) {
    again = false;
    for (const BodyPair& pair : world.box_tree.pairs()) {
      const int row = sleeps(world, pair.a) ? pair.a : sleeps(world, pair.b) ? pair.b : -1;
      const int other = row == pair.a ? pair.b : pair.a;
      if (row < 0 || !world.states.moves[other]) continue;
      // Near is not touching: what lies beside a sleeper must not wake it step after step.
      world.manifolds.clear();
      collide(world.scene.bodies[pair.a].shape, world.states.pose(pair.a),
              world.scene.bodies[pair.b].shape, world.states.pose(pair.b),
              world.reach[pair.a] + world.reach[pair.b], world.manifolds);
      if (world.manifolds.empty()) continue;
      wake(world, row);
      any = again = true;
      break;  // the pairs of the woken are not known yet
    }
    if (again) run_pairs(world);
  }
  return any;
}

}  // namespace carom
