// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "carom/bodies/ids.hpp"

namespace carom {

/// Where the energy is and where it went, J. kinetic + potential + dissipated - work - repulsion is
/// constant, up to the error of the integration: the ledger that shows it.
struct Energy {
  double kinetic = 0;
  double potential = 0;
  double dissipated = 0;  ///< by contacts and friction since the start
  double work = 0;        ///< put in by applied wrenches and impulses since the start
  double repulsion = 0;   ///< put in by the lecture's repulsion since the start; see Repulsion

  [[nodiscard]] double balance() const {
    return kinetic + potential + dissipated - work - repulsion;
  }
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

/// What the lecture's repulsion did, added up; all zero without a Repulsion in the scene. The first
/// four: where the normals of centres inside distance grids came from.
struct RepulsionReport {
  std::int64_t gradient = 0;   ///< of the distance
  std::int64_t swept_hit = 0;  ///< at the point where the path met the surface
  std::int64_t velocity = 0;   ///< opposite of the motion
  std::int64_t kept = 0;       ///< of the step before: inside all along
  std::int64_t pushed = 0;     ///< contact points
  std::int64_t capped = 0;     ///< steps whose pushes stopped at tolerance::repulsion_sweeps
  std::int64_t stagnated = 0;  ///< steps whose pushes stopped as rounding left them no change
  double fastest = 0;          ///< m/s, largest speed given to a point
};

/// What turning the bodies took, added up.
struct RotationReport {
  std::int64_t capped = 0;         ///< bodies that wanted more than tolerance::rotation_substeps
  std::int64_t clamped = 0;        ///< square-root steps beyond |h w| = 2
  std::int64_t not_converged = 0;  ///< implicit or adaptive steps that stopped at their cap
  int most_substeps = 0;           ///< of any body in any step
};

/// The certificate of a step, or of a call of advance: what was followed along its path, and what
/// could not be followed to the end. Nothing has passed through anything else: a body that runs out
/// of hits waits where it is.
struct SweepReport {
  int swept = 0;               ///< bodies followed in the last step
  std::int64_t sweeps = 0;     ///< pairs of paths asked about
  std::int64_t queries = 0;    ///< distances that took
  std::int64_t impacts = 0;    ///< hits resolved at their time
  std::int64_t waited = 0;     ///< bodies stopped for the rest of a step: too many hits, or gave_up
  std::int64_t gave_up = 0;    ///< pairs not certified to the end of the step: query cap met
  double time_lost = 0;        ///< s, that those bodies did not move
  std::int64_t verified = 0;   ///< pairs of ways looked at again, with SimulationOptions::verify
  std::int64_t crossings = 0;  ///< of these, found to cross: a bug, to be told
  /// m, least separation of swept pairs; negative: overlap, infinite where none was swept
  double smallest_gap = std::numeric_limits<double>::infinity();
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
  SweepReport sweep;
  RepulsionReport repulsion;
  std::vector<BodyId> frozen;  ///< held at their last good pose since their state went non-finite

  [[nodiscard]] bool ok() const {
    return frozen.empty() && contact.gave_up == 0 && rotation.not_converged == 0 &&
           sweep.waited == 0 && sweep.crossings == 0;
  }
};

}  // namespace carom
