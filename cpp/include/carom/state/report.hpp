// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "carom/bodies/ids.hpp"

namespace carom {

/// Where the energy is and where it went, J. kinetic + potential + dissipated - work is constant,
/// up to the error of the integration: the ledger that shows it.
struct Energy {
  double kinetic = 0;
  double potential = 0;
  double dissipated = 0;  ///< by contacts and friction since the start
  double work = 0;        ///< put in by applied wrenches and impulses since the start

  [[nodiscard]] double balance() const { return kinetic + potential + dissipated - work; }
};

/// What contacts did in a step, or in a call of advance: extremes and sums over its steps.
struct ContactReport {
  std::int64_t points = 0;      ///< in the last step
  double deepest_overlap = 0;   ///< m, worst seen at a step's start, >= 0
  double residual = 0;          ///< m/s, worst residual the solver left
  std::int64_t iterations = 0;  ///< in all
  std::int64_t gave_up = 0;     ///< islands whose solve ended above its tolerance
  int islands = 0;              ///< in the last step
  int direct_islands = 0;       ///< of these, solved directly; the others took small steps
  int direct_bodies = 0;        ///< in them
  int asleep = 0;               ///< bodies at rest without cost
};

/// What turning the bodies took, added up.
struct RotationReport {
  std::int64_t capped = 0;         ///< bodies that wanted more than tolerance::rotation_substeps
  std::int64_t clamped = 0;        ///< square-root steps beyond |h w| = 2
  std::int64_t not_converged = 0;  ///< implicit or adaptive steps that stopped at their cap
  int most_substeps = 0;           ///< of any body in any step
};

struct StageTime {
  std::string stage;
  double seconds = 0;  ///< wall time in this stage
  int bodies = 0;      ///< how many it worked on in the last step
};

/// What one call of advance did, how wrong it may be and what it cost.
struct Report {
  double time = 0;       ///< s, simulated clock at the end
  double simulated = 0;  ///< s, advanced by this call
  std::int64_t steps = 0;
  double wall_seconds = 0;
  std::vector<StageTime> stages;
  ContactReport contact;
  RotationReport rotation;
  std::vector<BodyId> frozen;  ///< held at their last good pose since their state went non-finite

  [[nodiscard]] bool ok() const {
    return frozen.empty() && contact.gave_up == 0 && rotation.not_converged == 0;
  }
};

}  // namespace carom
