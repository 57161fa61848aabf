// SPDX-License-Identifier: Apache-2.0
#include "contact/islands.hpp"

#include <algorithm>
#include <numeric>

namespace carom::contact {

int Islands::find(int i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

void Islands::build(const BodyStates& states, std::span<const Contact> contacts) {
  const int n = states.size();
  parent_.resize(n);
  std::iota(parent_.begin(), parent_.end(), 0);
  unsorted_.clear();
  const int count = static_cast<int>(contacts.size());
  for (int i = 0; i < count; ++i) {
    const Contact& c = contacts[i];
    if (!unsorted_.empty()) {
      Patch& last = unsorted_.back();
      if (last.a == c.a && last.b == c.b && contacts[last.first].normal == c.normal) {
        ++last.count;
        continue;
      }
    }
    if (!states.moves[c.a] && !states.moves[c.b]) continue;
    unsorted_.push_back({c.a, c.b, i, 1});
    if (states.moves[c.a] && states.moves[c.b]) {
      const int a = find(c.a), b = find(c.b);
      parent_[std::max(a, b)] = std::min(a, b);  // the root is the lowest row
    }
  }

  islands.clear();
  island_of_.assign(n, -1);
  const auto number = [&](const Patch& p) -> int& {
    return island_of_[find(states.moves[p.a] ? p.a : p.b)];
  };
  for (const Patch& p : unsorted_) number(p) = 0;
  int next = 0;
  for (int i = 0; i < n; ++i)
    if (parent_[i] == i && island_of_[i] == 0) island_of_[i] = next++;
  islands.resize(next);
  for (Island& island : islands) island = {};
  for (const Patch& p : unsorted_) {
    Island& island = islands[number(p)];
    ++island.patches;
    island.points += p.count;
  }
  for (int i = 0; i < n; ++i) {
    const int k = states.moves[i] ? island_of_[find(i)] : -1;
    if (k >= 0) ++islands[k].bodies;
  }
  int body = 0, patch = 0;
  for (Island& island : islands) {
    island.first_body = body, island.first_patch = patch;
    body += island.bodies, patch += island.patches;
    island.bodies = island.patches = 0;
  }
  bodies.resize(body);
  patches.resize(patch);
  for (int i = 0; i < n; ++i) {
    const int k = states.moves[i] ? island_of_[find(i)] : -1;
    if (k >= 0) bodies[islands[k].first_body + islands[k].bodies++] = i;
  }
  for (const Patch& p : unsorted_) {
    Island& island = islands[number(p)];
    patches[island.first_patch + island.patches++] = p;
  }
}

}  // namespace carom::contact
