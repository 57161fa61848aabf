// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "contact/direct.hpp"
#include "contact/islands.hpp"
#include "contact/scratch.hpp"

namespace carom::contact {

/// Hits between bodies that bounce, one patch after the other, the fastest approach first.
///
/// One after the other because that is what touching steel balls do: of Newton's cradle only the
/// last one leaves, where a simultaneous law sends the first one back. Each hit obeys Newton's
/// restitution and Coulomb's cone and takes energy or none: where friction would make it gain, its
/// restitution is lowered until it does not.
class Impacts {
 public:
  /// Changes velocities in states and frames. Returns the energy taken, J.
  double resolve(BodyStates& states, BodyFrames& frames, const Islands& islands,
                 std::span<Contact> contacts, double dt);
  /// One hit of one patch at `speed` (m/s, its fastest approach), bodies as they stand: changes
  /// velocities in states and frames, adds impulses to the contacts. Returns the energy taken, J.
  double hit(BodyStates& states, BodyFrames& frames, const Patch& patch,
             std::span<Contact> contacts, double speed);
  /// Adds the impulses of the hits to what the contacts carry by now.
  void add_to(std::span<Contact> contacts) const;
  /// 1 for rows that were hit in the last call; empty when none was.
  [[nodiscard]] std::span<const std::uint8_t> rows_hit() const { return hit_; }

 private:
  double resolve_island(BodyStates& states, BodyFrames& frames, const Islands& islands,
                        const Island& island, std::span<Contact> contacts, double dt);
  double strike(BodyStates& states, BodyFrames& frames, const Patch& patch,
                std::span<Contact> contacts, double speed);

  struct Impulse {
    int contact;
    Eigen::Vector3d impulse;
    double dissipated;
  };
  DirectSolver solver_;
  std::vector<Impulse> impulses_;
  std::vector<std::uint8_t> hit_;
};

}  // namespace carom::contact
