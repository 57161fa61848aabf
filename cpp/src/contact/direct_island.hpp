// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "carom/contact/solver.hpp"

#include "contact/direct.hpp"
#include "contact/islands.hpp"
#include "contact/scratch.hpp"

namespace carom::contact {

[[nodiscard]] DirectBody direct_body(const BodyStates& states, const BodyFrames& frames, int row);

/// Takes an island to the direct solver and its answer back.
class DirectIsland {
 public:
  /// Velocities without any push, then, only where something overlaps, a second solve whose push
  /// moves the bodies but leaves them no speed. When not converged nothing has changed.
  DirectResult solve(BodyStates& states, const BodyFrames& frames, const Islands& islands,
                     const Island& island, std::span<Contact> contacts, ContactMotion& motion,
                     double dt, double residual, int newton_cap, double& dissipated);

 private:
  void load(const BodyStates& states, const BodyFrames& frames, const Islands& islands,
            const Island& island, std::span<const Contact> contacts, double dt);
  double store(BodyStates& states, const BodyFrames& frames, std::span<Contact> contacts);

  [[nodiscard]] double approach(const BodyStates& states, const BodyFrames& frames,
                                const Contact& c) const;

  DirectSolver solver_;
  std::vector<int> local_;        // by row
  std::vector<int> contact_of_;   // by point
  std::vector<Vector6> settled_;  // velocities before the push
};

}  // namespace carom::contact
