// SPDX-License-Identifier: Apache-2.0
// Continuous collision: bodies that went farther than their own thickness allows are followed along
// their paths, hit by hit in the order of time, until nothing meets before the step ends.
#include "step/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "carom/numerics/tolerance.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

/// Marks what the step moved farther than allowed.
bool mark_fast(World& world) {
  SweepWork& w = world.sweep;
  const BodyStates& s = world.states;
  bool any = false;
  for (const int i : world.plan.movers) {
    const Ccd ccd = w.ccd[i];
    if (w.fast[i] && ccd != Ccd::never) {
      any = true;
      continue;
    }
    const Eigen::Vector3d way = s.position[i] - w.position_before[i];
    const double far = way.norm() + turn_bound(world, i) * w.turning_radius[i];
    const bool calls =
        far > tolerance::sweep_share * w.thickness[i] || (ccd == Ccd::always && far > 0);
    w.fast[i] = calls && ccd != Ccd::never;
    any = any || w.fast[i];
  }
  return any;
}

/// Whether the two have met nothing but each other in this step.
bool note_meeting(SweepWork& w, int a, int b) {
  const auto note = [&](int row, int other) {
    int& met = w.met_only[row];
    met = met == row || met == other ? other : -1;
    return met == other;
  };
  const bool of_a = note(a, b), of_b = note(b, a);
  return of_a && of_b;
}

void handle(World& world, const SweepEvent& event) {
  SweepWork& w = world.sweep;
  const double t = event.contact.time;
  const bool certain = event.contact.status == FirstContact::Status::contact;
  const auto tired = [&](int row) {
    return world.states.moves[row] && !w.waits[row] && ++w.hits[row] > tolerance::sweep_hits;
  };
  const bool stop_a = tired(event.a), stop_b = tired(event.b);
  if (world.options.verify)
    for (const int row : {event.a, event.b}) keep_trail(world, row, t);
  if (certain) {
    ++world.report.sweep.impacts;
    strike(world, event);
  } else {
    ++world.report.sweep.gave_up;
  }
  const bool alone = note_meeting(w, event.a, event.b);
  const auto stop = [&](int row, bool tires) {
    const bool waits = world.states.moves[row] && (tires || !certain) && !w.waits[row];
    if (waits) wait_at(world, row, t);
    return waits && (tires || (!w.waited.empty() && w.waited[row]));
  };
  const bool jams_a = stop(event.a, stop_a), jams_b = stop(event.b, stop_b);
  if (jams_a && jams_b && alone) {
    calm_together(world, event.a, event.b);
  } else {
    if (jams_a) calm(world, event.a);
    if (jams_b) calm(world, event.b);
  }
  for (const int row : {event.a, event.b}) {
    if (!world.states.moves[row]) continue;
    ++w.version[row];
    w.fast[row] = 1;
    w.boxed[row] = 0;
  }
  ask_about(world, event.a, -1, t);
  ask_about(world, event.b, world.states.moves[event.a] ? event.a : -1, t);
}

}  // namespace

void run_sweep(World& world) {
  SweepWork& w = world.sweep;
  const int n = world.states.size();
  bool any = mark_fast(world);
  any = mark_turned(world) || any;
  const bool verify = world.options.verify;
  world.report.sweep.swept = static_cast<int>(std::ranges::count(w.fast, 1));
  if (!any && !verify) return w.waited.clear();
  begin_paths(world);
  if (verify)
    for (int i = 0; i < n; ++i) need_path(world, i);
  w.boxes.resize(n);
  w.events.clear(), w.strayed.clear();
  if (any) {
    foresee(world);
    ask_all(world);
  }
  while (!w.events.empty()) {
    std::pop_heap(w.events.begin(), w.events.end());
    const SweepEvent event = w.events.back();
    w.events.pop_back();
    if (w.version[event.a] == event.version_a && w.version[event.b] == event.version_b)
      handle(world, event);
  }
  w.waited.clear();
  if (std::ranges::count(w.waits, 1) > 0) w.waited = w.waits;
  if (verify) verify_step(world);
}

}  // namespace carom
