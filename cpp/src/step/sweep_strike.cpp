// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "carom/numerics/tolerance.hpp"

#include "step/sweep.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

constexpr int patches_in_turn = 16;     // hits of one meeting: a corner of three faces takes a few
constexpr double same_direction = 0.7;  // cosine: the manifold knows the direction of the meeting

Vector3d relative_velocity(const BodyStates& s, const Contact& c) {
  return s.velocity_at(c.b, c.position) - s.velocity_at(c.a, c.position);
}

/// Contact points of the meeting; the point the sweep found where the manifold does not know it, as
/// for the back of a sheet.
void find_points(World& world, const SweepEvent& event) {
  SweepWork& w = world.sweep;
  const Scene::Body &a = world.scene.bodies[event.a], &b = world.scene.bodies[event.b];
  w.contacts.clear(), w.patches.clear(), w.manifolds.clear();
  const auto add = [&](const Vector3d& normal, const Vector3d& position, double separation) {
    w.contacts.push_back({.a = event.a,
                          .b = event.b,
                          .normal = normal,
                          .position = position,
                          .separation = separation,
                          .friction = std::sqrt(a.friction * b.friction),
                          .restitution = std::max(a.restitution, b.restitution)});
  };
  collide(a.shape, world.states.pose(event.a), b.shape, world.states.pose(event.b),
          tolerance::sweep_touch, w.manifolds);
  bool known = false;
  for (const Manifold& m : w.manifolds) {
    if (m.normal.dot(event.contact.normal) < -same_direction) continue;  // out of the wrong side
    known = known || m.normal.dot(event.contact.normal) > same_direction;
    w.patches.push_back({event.a, event.b, static_cast<int>(w.contacts.size()), m.count});
    for (int k = 0; k < m.count; ++k) add(m.normal, m.points[k].position, m.points[k].separation);
  }
  if (known) return;
  w.contacts.clear();
  w.patches.assign(1, {event.a, event.b, 0, 1});
  add(event.contact.normal, event.contact.point, event.contact.gap);
}

/// What flies for less than a step after its bounce rests instead: it would only hit again at once.
void settle_slow(SweepWork& w, double closing_acceleration, double dt, const BodyStates& s) {
  for (Contact& c : w.contacts) {
    const double speed = -c.normal.dot(relative_velocity(s, c));
    if (2 * c.restitution * speed < closing_acceleration * dt) c.restitution = 0;
  }
}

double approach(const BodyStates& s, const SweepWork& w, const contact::Patch& patch) {
  double fastest = 0;
  for (int k = patch.first; k < patch.first + patch.count; ++k)
    fastest = std::max(fastest, -w.contacts[k].normal.dot(relative_velocity(s, w.contacts[k])));
  return fastest;
}

/// The impulse along n that just stops one point, for what the solver of hits did not settle.
double stop_point(World& world, const Contact& c) {
  BodyStates& s = world.states;
  const double speed = -c.normal.dot(relative_velocity(s, c));
  double mobility = 0, before = 0, after = 0;
  for (const int row : {c.a, c.b})
    if (s.moves[row])
      mobility += contact::mobility_along(s.inverse_mass[row], s.world_inverse_inertia(row),
                                          c.position - s.position[row], c.normal);
  if (!(speed > 0) || !(mobility > 0)) return 0;
  const Vector3d impulse = speed / mobility * c.normal;
  for (const int row : {c.a, c.b}) {
    if (!s.moves[row]) continue;
    const Vector3d push = row == c.a ? Vector3d(-impulse) : impulse;
    before += s.kinetic_energy(row);
    s.velocity.set(row, s.velocity[row] + s.inverse_mass[row] * push);
    s.angular_momentum.set(row,
                           s.angular_momentum[row] + (c.position - s.position[row]).cross(push));
    after += s.kinetic_energy(row);
  }
  return before - after;
}

double mechanical_energy(const World& world, const SweepEvent& event, const Vector3d& gravity) {
  const BodyStates& s = world.states;
  double sum = 0;
  for (const int row : {event.a, event.b})
    if (s.moves[row]) sum += s.kinetic_energy(row) - s.mass[row] * gravity.dot(s.position[row]);
  return sum;
}

/// J that contacts of the solver take from a body over the step, and have not yet taken at time t.
double still_to_take(const World& world, int i, const Vector3d& gravity, double t) {
  const BodyStates& s = world.states;
  const SweepWork& w = world.sweep;
  if (!s.moves[i] || w.paths[i].start > 0 || !world.solver.motion().decided[i]) return 0;
  const Vector3d v = world.velocity_before[i];
  const Vector3d l = w.orientation_before[i].conjugate() * world.angular_momentum_before[i];
  const double before =
      0.5 * (s.mass[i] * v.squaredNorm() + l.dot(s.inverse_moments[i].cwiseProduct(l))) -
      s.mass[i] * gravity.dot(w.position_before[i]);
  const double after = s.kinetic_energy(i) - s.mass[i] * gravity.dot(s.position[i]);
  return (1 - t / world.dt) * std::max(0.0, before - after);
}

/// Contacts of the solver act over the whole step, so a body they push has at a time within it no
/// speed that is quite its own. What they would have taken after a hit they do not take: `left`, J.
/// What the hit adds to the energy by its timing beyond that is taken back from the motion about
/// the common centre: momentum stays.
void take_back(World& world, const SweepEvent& event, const Vector3d& gravity, double allowed,
               double left) {
  BodyStates& s = world.states;
  const double energy = mechanical_energy(world, event, gravity);
  const double not_taken = std::clamp(energy - allowed, 0.0, left);
  world.dissipated -= not_taken;
  const double excess = energy - allowed - not_taken;
  const bool both = s.moves[event.a] && s.moves[event.b];
  const double ma = s.mass[event.a], mb = s.mass[event.b];
  const Vector3d common =
      both ? Vector3d((ma * s.velocity[event.a] + mb * s.velocity[event.b]) / (ma + mb))
           : Vector3d::Zero();
  double kinetic = both ? -0.5 * (ma + mb) * common.squaredNorm() : 0;
  for (const int row : {event.a, event.b})
    if (s.moves[row]) kinetic += s.kinetic_energy(row);
  if (!(excess > tolerance::hit_residual * std::abs(energy)) || !(kinetic > 0)) return;
  const double share = std::sqrt(std::max(0.0, 1 - excess / kinetic));
  for (const int row : {event.a, event.b}) {
    if (!s.moves[row]) continue;
    s.velocity.set(row, common + share * (s.velocity[row] - common));
    s.angular_momentum.set(row, share * s.angular_momentum[row]);
  }
}

}  // namespace

void strike(World& world, const SweepEvent& event) {
  SweepWork& w = world.sweep;
  BodyStates& s = world.states;
  const double t = event.contact.time;
  const Vector3d gravity = gravity_of(world);
  const auto pushed = [&](int row) {
    return world.plan.runs(StageKind::solve) && world.solver.motion().decided[row];
  };
  const bool timed_by_step = pushed(event.a) || pushed(event.b);
  const double dissipated_before = world.dissipated;
  for (const int row : {event.a, event.b}) wake(world, row);
  const double energy = mechanical_energy(world, event, gravity);
  double left = 0;
  for (const int row : {event.a, event.b}) {
    if (timed_by_step) left += still_to_take(world, row, gravity, t);
    go_to(world, row, t);
  }
  find_points(world, event);
  const Vector3d& n = event.contact.normal;
  Vector3d pull_a = w.pull[event.a], pull_b = w.pull[event.b];
  const double closing = std::max(0.0, n.dot(pull_a - pull_b));
  settle_slow(w, closing, world.dt, s);
  w.frames.resize(s.size());
  for (int hit = 0; hit < patches_in_turn; ++hit) {
    const auto fastest = std::ranges::max_element(
        w.patches, {}, [&](const contact::Patch& p) { return approach(s, w, p); });
    const double speed = approach(s, w, *fastest);
    if (!(speed > tolerance::sweep_still)) break;
    for (const int row : {event.a, event.b}) w.frames.set(row, s, s.velocity, s.angular_momentum);
    world.dissipated += w.impacts.hit(s, w.frames, *fastest, w.contacts, speed);
  }
  for (const Contact& c : w.contacts)
    if (-c.normal.dot(relative_velocity(s, c)) > tolerance::sweep_still)
      world.dissipated += stop_point(world, c);

  // What comes to rest on the other is held up by it for the remainder of the step. Not what turns
  // about the point they touch at: holding up a centre that moves would lift it for nothing.
  const Contact meeting{.a = event.a, .b = event.b, .normal = n, .position = event.contact.point};
  const double leaving = n.dot(relative_velocity(s, meeting));
  const double between_centres = n.dot(s.velocity[event.b] - s.velocity[event.a]);
  const double masses = (s.moves[event.a] ? s.inverse_mass[event.a] : 0) +
                        (s.moves[event.b] ? s.inverse_mass[event.b] : 0);
  const double slow = 0.5 * closing * (world.dt - t);
  if (masses > 0 && leaving <= slow && std::abs(between_centres) <= slow) {
    if (s.moves[event.a]) pull_a -= s.inverse_mass[event.a] / masses * closing * n;
    if (s.moves[event.b]) pull_b += s.inverse_mass[event.b] / masses * closing * n;
  }
  lay_path(world, event.a, t, pull_a);
  lay_path(world, event.b, t, pull_b);
  if (timed_by_step)
    take_back(world, event, gravity, energy - (world.dissipated - dissipated_before), left);
}

}  // namespace carom
