// SPDX-License-Identifier: Apache-2.0
#include "step/options.hpp"

#include <string>

#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

constexpr int most_threads = 1024, most_substeps = 1000;  // more is a slip of the keyboard

}  // namespace

void require_valid(const SimulationOptions& options) {
  require_positive(options.dt, "dt", "s");
  require_positive(options.contact.tolerance, "contact_tolerance", "m/s",
                   "1e-7 is the default; below 1e-9 rounding sets the end");
  require_non_negative(options.contact.direct_budget, "direct_budget", "s");
  require_non_negative(options.sleep_speed, "sleep_speed", "m/s");
  if (!(options.sleep_after >= 0))
    throw InvalidInput("sleep_after", with_unit(options.sleep_after, "s"), "must be >= 0",
                       "infinity is never");
  if (options.contact.substeps < 0 || options.contact.substeps > most_substeps)
    throw InvalidInput("substeps", std::to_string(options.contact.substeps), "must be 0 to 1000",
                       "0 takes as many as the loads ask for");
  if (options.threads < 1 || options.threads > most_threads)
    throw InvalidInput("threads", std::to_string(options.threads), "must be 1 to 1024",
                       "as many as the machine has cores, or 1");
}

}  // namespace carom
