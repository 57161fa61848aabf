// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/step/simulation.hpp"

namespace carom {

/// @throws InvalidInput for an option that no simulation can follow
void require_valid(const SimulationOptions& options);

}  // namespace carom
