// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

auto pair_of(const Contact& c) {
  return std::pair(c.a, c.b);
}

constexpr std::size_t taken = static_cast<std::size_t>(-1);

/// A point whose features no longer meet leaves its load to the nearest point of the pair, one
/// without load of its own first: a heap that drops what single points carried is never at rest.
void inherit(std::span<Contact> now, std::span<const Contact> old,
             std::span<const std::size_t> heir_of) {
  for (std::size_t k = 0; k < old.size(); ++k) {
    if (heir_of[k] == taken) continue;
    Contact* heir = nullptr;
    double best = std::numeric_limits<double>::infinity();
    for (Contact& c : now) {
      if (!(old[k].impulse_at_end.dot(c.normal) > 0)) continue;
      const double d = (c.position - old[k].position).squaredNorm();
      const bool free = c.impulse.isZero(0), free_before = heir && heir->impulse.isZero(0);
      if (heir && free_before && !free) continue;
      if (heir && free == free_before && d >= best) continue;
      heir = &c, best = d;
    }
    if (heir) heir->impulse += old[k].impulse_at_end;
  }
}

/// Contacts that met a step ago start from the impulse they ended with: the same two features of
/// the same two bodies. Both lists ascend by pair.
void warm_start(World& world) {
  thread_local std::vector<std::size_t> heirs;
  const std::vector<Contact>& old = world.contacts_before;
  std::vector<Contact>& now = world.contacts;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0, end = 0; i < now.size(); i = end) {
    const auto pair = pair_of(now[i]);
    for (end = i; end < now.size() && pair_of(now[end]) == pair;) ++end;
    while (first < old.size() && pair_of(old[first]) < pair) ++first;
    for (last = first; last < old.size() && pair_of(old[last]) == pair;) ++last;
    heirs.assign(last - first, 0);
    bool any_left = false;
    for (std::size_t k = first; k < last; ++k) {
      const auto same = std::find_if(now.begin() + i, now.begin() + end,
                                     [&](const Contact& c) { return c.feature == old[k].feature; });
      if (same == now.begin() + end) {
        any_left |= !old[k].impulse_at_end.isZero(0);
        continue;
      }
      same->impulse = old[k].impulse_at_end;
      same->turning_impulse = old[k].turning_impulse;
      heirs[k - first] = taken;
    }
    if (any_left)
      inherit(std::span(now).subspan(i, end - i), std::span(old).subspan(first, last - first),
              heirs);
    first = last;
  }
}

/// Whether all points of the pair at hand are apart, and it would bounce.
bool bounces_freely(const World& world, double restitution) {
  return restitution > 0 && std::ranges::all_of(world.manifolds, [](const Manifold& m) {
           return std::all_of(m.points.begin(), m.points.begin() + m.count,
                              [](const auto& p) { return p.separation > tolerance::sweep_touch; });
         });
}

/// Whether a point of the pair at hand comes nearer by more than the thickness of the thinner body,
/// before the forces of this step: what slides or rolls, however fast, and what only its weight
/// would carry through its own thickness, is held by the solver.
bool closes(const World& world, const BodyPair& pair) {
  const BodyStates& s = world.states;
  const SweepWork& w = world.sweep;
  const double thin = std::min(s.moves[pair.a] ? w.thickness[pair.a] : w.thickness[pair.b],
                               s.moves[pair.b] ? w.thickness[pair.b] : w.thickness[pair.a]);
  const auto velocity = [&](int i, const Eigen::Vector3d& x) {
    return Eigen::Vector3d(s.velocity_at(i, x) - s.velocity[i] + world.velocity_before[i]);
  };
  return std::ranges::any_of(world.manifolds, [&](const Manifold& m) {
    return std::any_of(m.points.begin(), m.points.begin() + m.count, [&](const ContactPoint& p) {
      const Eigen::Vector3d u = velocity(pair.b, p.position) - velocity(pair.a, p.position);
      return -world.dt * m.normal.dot(u) > tolerance::sweep_share * thin;
    });
  });
}

/// Whether the sweep finds these contacts at their time: the pair is apart, and one of them is fast
/// or bounces for longer than a step. What meets in the step after this one counts as well: the
/// small steps of the solver look one ahead, and stop there what should bounce.
///
/// `apart` becomes the gap up to which points of a pair that bounces stay with the solver, m.
bool left_to_sweep(World& world, const BodyPair& pair, double restitution, double& apart) {
  SweepWork& w = world.sweep;
  if (w.fast[pair.a] || w.fast[pair.b]) {
    const BodyStates& states = world.states;
    const auto motion = [&](int i) {
      return Motion{states.position[i], world.dt * states.velocity[i],
                    world.dt * states.angular_velocity(i)};
    };
    if (is_fast(world, pair.a, pair.b, motion(pair.a), motion(pair.b)) &&
        (restitution > 0 || closes(world, pair)))
      return true;
  }
  if (!(restitution > 0) || !world.plan.runs(StageKind::sweep)) return false;
  const BodyStates& s = world.states;
  bool bounces = false;
  for (const Manifold& m : world.manifolds)
    for (int k = 0; k < m.count; ++k) {
      const ContactPoint& p = m.points[k];
      if (p.separation <= tolerance::sweep_leaves) return false;
      const Eigen::Vector3d u =
          s.velocity_at(pair.b, p.position) - s.velocity_at(pair.a, p.position);
      const Eigen::Vector3d gained = s.velocity[pair.b] - world.velocity_before[pair.b] -
                                     (s.velocity[pair.a] - world.velocity_before[pair.a]);
      const double now = m.normal.dot(u), before = now - m.normal.dot(gained);
      const bool meets = p.separation + 2 * world.dt * std::min(now, before) < 0;
      bounces = bounces || (meets && -2 * restitution * before > before - now);
    }
  if (!bounces) return false;
  apart = tolerance::sweep_leaves;
  for (const int row : {pair.a, pair.b}) w.fast[row] = s.moves[row] && w.ccd[row] != Ccd::never;
  return w.fast[pair.a] || w.fast[pair.b];
}

/// How far apart two bodies may be and still meet in this step, m: what moves both alike counts
/// not.
double margin_of(const World& world, int a, int b) {
  const BodyStates& s = world.states;
  const double both =
      world.dt * (s.velocity[b] - s.velocity[a]).norm() + world.swing[a] + world.swing[b];
  return tolerance::contact_margin + std::min(both, world.reach[a] + world.reach[b]);
}

}  // namespace

void run_contacts(World& world) {
  if (wake_touched(world)) run_pairs(world);
  std::swap(world.contacts, world.contacts_before);
  world.contacts.clear();
  world.sweep.left.clear(), world.sweep.kept.clear(), world.sweep.free.clear();
  world.manifold_cache.begin_step();
  const auto placed = [&](int i) {
    return contact::ManifoldCache::Placed{world.scene.bodies[i].shape, world.frames[i],
                                          world.turns[i], world.is_ball[i] != 0};
  };
  for (const BodyPair& pair : world.pairs) {
    world.manifolds.clear();
    world.manifold_cache.collide(
        pair.a, pair.b, placed(pair.a), placed(pair.b), margin_of(world, pair.a, pair.b),
        std::min(world.sweep.radius[pair.a], world.sweep.radius[pair.b]), world.manifolds);
    if (world.manifolds.empty()) continue;
    const Touch &a = world.touch[pair.a], &b = world.touch[pair.b];
    const double friction = std::sqrt(a.friction * b.friction);
    const double restitution = std::max(a.restitution, b.restitution);
    double apart = tolerance::sweep_touch;  // m: of pairs left to the sweep the solver has the rest
    const bool swept = left_to_sweep(world, pair, restitution, apart);
    (swept ? world.sweep.left : world.sweep.kept).push_back(pair);
    if (!swept && bounces_freely(world, restitution)) world.sweep.free.push_back(pair);
    for (const Manifold& m : world.manifolds)
      for (int k = 0; k < m.count; ++k) {
        const ContactPoint& p = m.points[k];
        if (swept && p.separation > apart) continue;
        world.contacts.push_back(
            {.a = pair.a,
             .b = pair.b,
             .normal = m.normal,
             .position = p.position,
             .separation = p.separation,
             .friction = friction,
             .restitution = restitution,
             .rolling_resistance = std::max(a.rolling_resistance, b.rolling_resistance),
             .spinning_resistance = std::max(a.spinning_resistance, b.spinning_resistance),
             .feature = p.feature});
      }
  }
  warm_start(world);
}

}  // namespace carom
