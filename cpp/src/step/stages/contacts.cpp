// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

auto pair_of(const Contact& c) {
  return std::pair(c.a, c.b);
}

void start_from(Contact& c, const Contact& old) {
  c.impulse = old.impulse_at_end;
  c.turning_impulse = old.turning_impulse;
}

/// Contacts that met a step ago start from the impulse they ended with: the same two features of
/// the same two bodies. Both lists ascend by pair.
void warm_start(World& world) {
  const std::vector<Contact>& old = world.contacts_before;
  std::size_t first = 0;
  for (Contact& c : world.contacts) {
    while (first < old.size() && pair_of(old[first]) < pair_of(c)) ++first;
    for (std::size_t k = first; k < old.size() && pair_of(old[k]) == pair_of(c); ++k)
      if (old[k].feature == c.feature) {
        start_from(c, old[k]);
        break;
      }
  }
}

}  // namespace

void run_contacts(World& world) {
  if (wake_touched(world)) run_pairs(world);
  std::swap(world.contacts, world.contacts_before);
  world.contacts.clear();
  world.manifold_cache.begin_step();
  for (const BodyPair& pair : world.box_tree.pairs()) {
    const Scene::Body& a = world.scene.bodies[pair.a];
    const Scene::Body& b = world.scene.bodies[pair.b];
    const double margin = tolerance::contact_margin + world.reach[pair.a] + world.reach[pair.b];
    world.manifolds.clear();
    const double reach = std::min(bounding_radius(a.shape), bounding_radius(b.shape));
    world.manifold_cache.collide(pair.a, pair.b, a.shape, world.states.pose(pair.a), b.shape,
                                 world.states.pose(pair.b), margin, reach, world.manifolds);
    for (const Manifold& m : world.manifolds)
      for (int k = 0; k < m.count; ++k) {
        const ContactPoint& p = m.points[k];
        world.contacts.push_back(
            {.a = pair.a,
             .b = pair.b,
             .normal = m.normal,
             .position = p.position,
             .separation = p.separation,
             .friction = std::sqrt(a.friction * b.friction),
             .restitution = std::max(a.restitution, b.restitution),
             .rolling_resistance = std::max(a.rolling_resistance, b.rolling_resistance),
             .spinning_resistance = std::max(a.spinning_resistance, b.spinning_resistance),
             .feature = p.feature});
      }
  }
  warm_start(world);
}

}  // namespace carom
