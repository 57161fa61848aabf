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

constexpr double trembling = 5;  // times the speed of sleep that a body may have at an instant

double fastest_point(const World& world, int i) {
  return world.states.velocity[i].norm() +
         world.states.angular_velocity(i).norm() * bounding_radius(world.scene.bodies[i].shape);
}

/// m, of its fastest point since `still` began.
double moved(const World& world, int i, const Still& still) {
  const Eigen::Vector3d then(still.position.data());
  const Eigen::Quaterniond before(still.orientation.data());  // x y z w
  const Eigen::Quaterniond turn = before.conjugate() * world.states.orientation[i];
  return (world.states.position[i] - then).norm() +
         2 * turn.vec().norm() * bounding_radius(world.scene.bodies[i].shape);
}

void watch(World& world, int i) {
  Still& still = world.still[i];
  const SimulationOptions& o = world.options;
  if (moved(world, i, still) <= o.sleep_speed * o.sleep_after &&
      fastest_point(world, i) < trembling * o.sleep_speed) {
    still.seconds += world.dt;
    return;
  }
  const Eigen::Vector3d x = world.states.position[i];
  const Eigen::Vector4d q = world.states.orientation[i].coeffs();
  still = {0, {x[0], x[1], x[2]}, {q[0], q[1], q[2], q[3]}};
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
  world.asleep.resize(n, 0), world.bed.resize(n, -1), world.still.resize(n);
  const std::vector<std::int32_t>& island = world.solver.memory.island;
  // The least still body decides for its island: its time is kept at the island's lowest row.
  world.island_still.assign(n, std::numeric_limits<double>::infinity());
  for (const int i : world.plan.movers) {
    watch(world, i);
    if (i < static_cast<int>(island.size()) && island[i] >= 0)
      world.island_still[island[i]] =
          std::min(world.island_still[island[i]], world.still[i].seconds);
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
    world.still[i] = {};
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
    for (const BodyPair& pair : world.pairs) {
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
