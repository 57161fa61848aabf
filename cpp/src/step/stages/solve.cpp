// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "step/world.hpp"

namespace carom {

void run_solve(World& world) {
  const SolveOutcome outcome =
      world.solver.solve(world.states, world.velocity_before, world.angular_momentum_before,
                         world.contacts, world.dt, world.options.contact, world.workers.get());
  ContactReport& report = world.report.contact;
  report.points = static_cast<std::int64_t>(world.contacts.size());
  report.residual = std::max(report.residual, outcome.residual);
  report.iterations += outcome.iterations;
  report.gave_up += outcome.gave_up;
  report.islands = outcome.islands;
  report.direct_islands = outcome.direct_islands;
  report.direct_bodies = outcome.direct_bodies;
  world.dissipated += outcome.dissipated;
  for (const Contact& c : world.contacts)
    report.deepest_overlap = std::max(report.deepest_overlap, -c.separation);
}

}  // namespace carom
