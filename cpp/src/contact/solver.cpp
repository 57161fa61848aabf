// SPDX-License-Identifier: Apache-2.0
#include "carom/contact/solver.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "carom/numerics/tolerance.hpp"

#include "contact/choice.hpp"
#include "contact/direct_island.hpp"
#include "contact/impacts.hpp"
#include "contact/islands.hpp"
#include "contact/scratch.hpp"
#include "contact/small_steps.hpp"
#include "numerics/workers.hpp"

namespace carom {
namespace {

// s, estimated, per step for islands that are not hard. Where hundreds of bodies meet, a fifth:
// while a heap forms, pieces of it would take as long as the rest.
constexpr double easy_budget = 5e-4, easy_budget_of_many = 1e-4;
constexpr std::size_t many_bodies = 300;
constexpr std::uint8_t hold_off = 30;  // steps until a direct solve is tried again

void resize(Array3& a, int n) {
  a.x.resize(n), a.y.resize(n), a.z.resize(n);
}

}  // namespace

void SolverMemory::resize(int n) {
  newton.resize(n, 4);
  held_off.resize(n, 0);
  direct.resize(n, 0);
  substeps.resize(n, 0);
  island.resize(n, -1);
}

void SolverMemory::erase(int i) {
  if (i >= static_cast<int>(newton.size())) return;  // came after the last solve
  newton.erase(newton.begin() + i);
  held_off.erase(held_off.begin() + i);
  direct.erase(direct.begin() + i);
  substeps.erase(substeps.begin() + i);
  island.erase(island.begin() + i);
}

namespace {

/// What becomes of an island.
struct Turn {
  contact::Choice choice;
  contact::DirectResult result;
  double dissipated = 0;  // J, by the direct solver
};

}  // namespace

struct ContactSolver::Workspace {
  contact::Islands islands;
  contact::BodyFrames frames;
  std::vector<contact::DirectIsland> direct;  // one a thread
  std::vector<Turn> turns;                    // by island
  std::vector<int> direct_islands;
  std::vector<double> easy_costs;
  contact::Impacts impacts;
  contact::SmallSteps small_steps;
  std::vector<std::pair<int, int>> later;  // substeps and island of what is not solved directly
  ContactMotion motion;
};

ContactSolver::ContactSolver() : workspace_(std::make_unique<Workspace>()) {}
ContactSolver::~ContactSolver() = default;
// A workspace holds nothing that outlives a step.
ContactSolver::ContactSolver(const ContactSolver& other)
    : memory(other.memory), workspace_(std::make_unique<Workspace>()) {}
ContactSolver& ContactSolver::operator=(const ContactSolver& other) {
  memory = other.memory;
  return *this;
}
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;
ContactSolver& ContactSolver::operator=(ContactSolver&&) noexcept = default;

const ContactMotion& ContactSolver::motion() const {
  return workspace_->motion;
}

SolveOutcome ContactSolver::solve(BodyStates& states, const Array3& velocity_before,
                                  const Array3& angular_momentum_before,
                                  std::span<Contact> contacts, double dt,
                                  const SolverOptions& options, Workers* workers) {
  Workspace& w = *workspace_;
  const int n = states.size();
  memory.resize(n);
  w.motion.decided.assign(n, 0);
  resize(w.motion.displacement, n), resize(w.motion.turn, n);
  for (Contact& c : contacts) c.dissipated = 0;
  w.islands.build(states, contacts);
  w.frames.resize(n);
  for (const int row : w.islands.bodies)
    w.frames.set(row, states, velocity_before, angular_momentum_before);
  for (const contact::Patch& p : w.islands.patches)
    for (const int row : {p.a, p.b})
      if (!states.moves[row]) w.frames.set(row, states, velocity_before, angular_momentum_before);

  std::ranges::fill(memory.island, -1);
  SolveOutcome out;
  out.islands = static_cast<int>(w.islands.islands.size());
  out.dissipated += w.impacts.resolve(states, w.frames, w.islands, contacts, dt);

  w.later.clear(), w.direct_islands.clear();
  w.turns.assign(out.islands, {});
  w.easy_costs.clear();
  for (int k = 0; k < out.islands; ++k) {
    w.turns[k].choice = contact::choose(w.islands, w.islands.islands[k], states, w.frames, contacts,
                                        dt, options, memory);
    if (w.turns[k].choice.easy_cost > 0) w.easy_costs.push_back(w.turns[k].choice.easy_cost);
  }
  const bool many = w.islands.bodies.size() > many_bodies;
  const double most_easy =
      contact::most_easy_cost(w.easy_costs, many ? easy_budget_of_many : easy_budget);
  for (int k = 0; k < out.islands; ++k) {
    contact::Choice& choice = w.turns[k].choice;
    choice.direct |= choice.easy_cost > 0 && choice.easy_cost <= most_easy;
    if (choice.direct) w.direct_islands.push_back(k);
  }
  // Islands share no moving body: whoever is free takes the next.
  w.direct.resize(std::max<std::size_t>(w.direct.size(), workers ? workers->count() : 1));
  const auto solve_directly = [&](int k, contact::DirectIsland& direct) {
    Turn& turn = w.turns[k];
    turn.result =
        direct.solve(states, w.frames, w.islands, w.islands.islands[k], contacts, w.motion, dt,
                     options.tolerance, turn.choice.newton_cap, turn.dissipated);
  };
  if (workers == nullptr || w.direct_islands.size() < 2) {
    for (const int k : w.direct_islands) solve_directly(k, w.direct[0]);
  } else {
    std::atomic<std::size_t> next = 0;
    auto take = [&](Part part) {
      for (;;) {
        const std::size_t i = next.fetch_add(1, std::memory_order_relaxed);
        if (i >= w.direct_islands.size()) return;
        solve_directly(w.direct_islands[i], w.direct[part.index]);
      }
    };
    workers->run(take);
  }

  for (int k = 0; k < out.islands; ++k) {
    const contact::Island& island = w.islands.islands[k];
    contact::Choice choice = w.turns[k].choice;
    const int newton = w.turns[k].result.newton;
    const bool solved = choice.direct && w.turns[k].result.converged;
    if (choice.direct) {
      out.dissipated += w.turns[k].dissipated;
      out.iterations += newton;
      if (solved) {
        out.residual = std::max(out.residual, w.turns[k].result.residual);
        out.direct_bodies += island.bodies;
        ++out.direct_islands;
      } else {
        choice.substeps = std::max(choice.substeps, 16);
        ++out.gave_up;
      }
    }
    const bool costly =
        choice.direct && newton * contact::newton_seconds(island) > options.direct_budget;
    for (int i = 0; i < island.bodies; ++i) {
      const int row = w.islands.bodies[island.first_body + i];
      memory.direct[row] = solved;
      memory.substeps[row] = static_cast<std::uint8_t>(solved ? 0 : std::min(choice.substeps, 255));
      memory.island[row] = w.islands.bodies[island.first_body];
      // A running mean that fades while it is not used: what one cold start took must neither
      // decide alone nor for ever.
      std::uint16_t& mean = memory.newton[row];
      if (choice.direct)
        mean = static_cast<std::uint16_t>((3 * mean + std::min(newton, 65535)) / 4);
      else if (mean > 4)
        --mean;
      if (costly || (choice.direct && !solved)) {
        memory.held_off[row] = hold_off;
        memory.newton[row] = 4;
      } else if (memory.held_off[row] > 0) {
        --memory.held_off[row];
      }
    }
    if (!solved) w.later.emplace_back(choice.substeps, k);
  }

  // Islands of equal small steps share their lanes.
  std::ranges::sort(w.later);
  for (std::size_t i = 0; i < w.later.size();) {
    w.small_steps.clear();
    const int substeps = w.later[i].first;
    for (; i < w.later.size() && w.later[i].first == substeps; ++i) {
      w.small_steps.add(w.islands, w.islands.islands[w.later[i].second]);
      ++out.small_step_islands;
    }
    out.residual =
        std::max(out.residual, w.small_steps.solve(states, w.frames, contacts, w.motion, dt,
                                                   substeps, out.dissipated, workers));
    out.iterations += substeps;
  }
  w.impacts.add_to(contacts);
  for (const int row : w.islands.bodies)
    if (!w.impacts.rows_hit().empty() && w.impacts.rows_hit()[row] && !w.motion.decided[row]) {
      w.motion.decided[row] = 1;
      w.motion.displacement.set(row,
                                0.5 * dt * (w.frames.velocity_before[row] + states.velocity[row]));
      w.motion.turn.set(row, Eigen::Vector3d::Zero());
    }
  return out;
}

}  // namespace carom
