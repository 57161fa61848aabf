// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "carom/contact/contact.hpp"
#include "carom/state/body_states.hpp"

namespace carom::contact {

/// Consecutive contacts of two bodies that share a normal.
struct Patch {
  int a = 0, b = 0;  ///< rows
  int first = 0, count = 0;
};

/// Bodies that touch, directly or through others, and what they touch. Ranges of the arrays below.
struct Island {
  int first_body = 0, bodies = 0;
  int first_patch = 0, patches = 0;
  int points = 0;
};

/// Splits contacts into patches and bodies into islands. Static bodies join nothing. The order
/// depends on rows alone: islands by their lowest row, rows and patches ascending within.
class Islands {
 public:
  void build(const BodyStates& states, std::span<const Contact> contacts);

  std::vector<Patch> patches;  ///< sorted by island
  std::vector<int> bodies;     ///< rows, sorted by island
  std::vector<Island> islands;

 private:
  int find(int i);

  std::vector<Patch> unsorted_;
  std::vector<int> parent_, island_of_;
};

}  // namespace carom::contact
