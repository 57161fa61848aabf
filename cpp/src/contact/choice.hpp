// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>

#include "carom/contact/solver.hpp"

#include "contact/islands.hpp"
#include "contact/scratch.hpp"

namespace carom::contact {

/// Sink that soft contacts of an island would have at rest under the loads its points carry now, m;
/// the mean is of those that carry any.
struct SinkEstimate {
  double worst = 0, mean = 0;
};
[[nodiscard]] SinkEstimate soft_sink(const Islands& islands, const Island& island,
                                     const BodyStates& states, const BodyFrames& frames,
                                     std::span<const Contact> contacts, double dt, int substeps);

/// Estimated time of one Newton step of an island on one core of a 2020s server, s: counted, never
/// measured, so that the same run always takes the same turn.
[[nodiscard]] double newton_seconds(const Island& island);

struct Choice {
  bool direct = false;
  int newton_cap = 0;
  int substeps = 0;      ///< where not direct, or when direct gives up
  double easy_cost = 0;  ///< s, of a direct solve where small steps would hold as well; 0: no such
};
[[nodiscard]] Choice choose(const Islands& islands, const Island& island, const BodyStates& states,
                            const BodyFrames& frames, std::span<const Contact> contacts, double dt,
                            const SolverOptions& options, const SolverMemory& memory);

/// The most an easy island's direct solve may cost, s, so that all those that cost no more fit into
/// the budget: what costs alike is treated alike, whatever its order. Sorts the costs.
[[nodiscard]] double most_easy_cost(std::span<double> costs, double budget);

}  // namespace carom::contact
