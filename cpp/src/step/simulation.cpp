// SPDX-License-Identifier: Apache-2.0
#include "carom/step/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "carom/geometry/thickness.hpp"
#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "step/options.hpp"
#include "step/world.hpp"

namespace carom {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

using Run = void (*)(World&);
constexpr Run runners[] = {run_gravity,  run_applied_wrench, run_drag,  run_torsion,   run_pairs,
                           run_contacts, run_repulsion,      run_solve, run_integrate, run_sweep};

/// Impulses act at once, before the forces: a body hit now moves at its new speed through the step.
void take_impulses(World& world) {
  BodyStates& s = world.states;
  for (Request& r : world.requests) {
    if (!s.moves[r.row]) continue;
    const double before = s.kinetic_energy(r.row);
    s.velocity.set(r.row, s.velocity[r.row] + s.inverse_mass[r.row] * r.impulse);
    s.angular_momentum.set(r.row, s.angular_momentum[r.row] + r.angular_impulse);
    world.work += s.kinetic_energy(r.row) - before;
  }
}

/// Sizes that tell which motion is too fast for a body, and what contacts ask of it.
void measure_bodies(World& world) {
  const std::size_t n = world.scene.bodies.size();
  world.touch.resize(n), world.is_ball.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Scene::Body& body = world.scene.bodies[i];
    world.touch[i] = {body.friction, body.restitution, body.rolling_resistance,
                      body.spinning_resistance};
    world.is_ball[i] = std::holds_alternative<Sphere>(body.shape);
  }
  SweepWork& w = world.sweep;
  w.thickness.resize(n), w.turning_radius.resize(n), w.radius.resize(n), w.ccd.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Scene::Body& body = world.scene.bodies[i];
    w.thickness[i] = inner_radius(body.shape);
    w.ccd[i] = body.ccd;
    w.turning_radius[i] = turning_radius(body.shape) + body.properties.com.norm();
    w.radius[i] = bounding_radius(body.shape) + body.properties.com.norm();
  }
  double thickest = 0, thinnest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i)
    if (const double t = w.thickness[i]; world.states.moves[i])
      thickest = std::max(thickest, t);
    else
      thinnest = std::min(thinnest, t);
  w.has_thin = thinnest < thickest;
}

void refresh_plan(World& world) {
  if (!world.plan_is_stale) return;
  world.plan = compile(world.scene, !world.requests.empty());
  world.filter.build(world.scene);
  if (!world.asleep.empty())
    std::erase_if(world.plan.movers, [&](int i) { return !world.states.moves[i]; });
  if (world.plan.runs(StageKind::pairs)) measure_bodies(world);
  world.boxed.assign(world.scene.bodies.size(), 0);
  world.plan_is_stale = false;
}

StageTime& time_of(Report& report, std::string_view stage) {
  const auto it = std::ranges::find(report.stages, stage, &StageTime::stage);
  if (it != report.stages.end()) return *it;
  return report.stages.emplace_back(StageTime{std::string(stage), 0, 0});
}

void end_step(World& world, double dt) {
  world.clock.tick(dt);
  world.report.time = world.clock.now();
  world.report.simulated += dt;
  ++world.report.steps;
}

void run_step(World& world, double dt) {
  // All asleep since a whole step: nothing that a stage could find out.
  const bool still = !world.plan_is_stale && world.plan.movers.empty() && !world.asleep.empty() &&
                     world.requests.empty();
  if (still) return end_step(world, dt);
  refresh_plan(world);
  world.dt = dt;
  take_impulses(world);
  world.velocity_before = world.states.velocity;
  world.angular_momentum_before = world.states.angular_momentum;
  world.has_mean_momentum.clear();
  if (world.plan.runs(StageKind::sweep)) {
    world.sweep.position_before = world.states.position;
    world.sweep.orientation_before = world.states.orientation;
  }
  for (const Stage& stage : world.plan.stages) {
    if (!stage.on) continue;
    const Clock::time_point start = Clock::now();
    runners[static_cast<int>(stage.kind)](world);
    StageTime& time = time_of(world.report, name_of(stage.kind));
    time.seconds += seconds_since(start);
    time.bodies = stage.bodies;
  }
  if (!world.plan.runs(StageKind::contacts)) world.contacts.clear();
  fall_asleep(world);
  end_step(world, dt);
}

/// The totals of two moments, as what happened between them.
Report difference(const Report& now, const Report& then) {
  Report r = now;
  r.simulated -= then.simulated;
  r.steps -= then.steps;
  r.wall_seconds -= then.wall_seconds;
  r.contact.iterations -= then.contact.iterations;
  r.contact.gave_up -= then.contact.gave_up;
  for (auto field :
       {&SweepReport::sweeps, &SweepReport::queries, &SweepReport::impacts, &SweepReport::waited,
        &SweepReport::gave_up, &SweepReport::verified, &SweepReport::crossings})
    r.sweep.*field -= then.sweep.*field;
  r.sweep.time_lost -= then.sweep.time_lost;
  r.rotation.capped -= then.rotation.capped;
  r.rotation.clamped -= then.rotation.clamped;
  r.rotation.not_converged -= then.rotation.not_converged;
  for (auto count : {&RepulsionReport::gradient, &RepulsionReport::swept_hit,
                     &RepulsionReport::velocity, &RepulsionReport::kept, &RepulsionReport::pushed,
                     &RepulsionReport::capped, &RepulsionReport::stagnated})
    r.repulsion.*count -= then.repulsion.*count;
  for (StageTime& stage : r.stages)
    for (const StageTime& before : then.stages)
      if (before.stage == stage.stage) stage.seconds -= before.seconds;
  return r;
}

}  // namespace

Simulation::Simulation(Scene scene, SimulationOptions options) : world_(std::make_unique<World>()) {
  require_valid(options);
  for (std::size_t i = 0; i < scene.effects.size(); ++i) {
    const std::string field = "effects[" + std::to_string(i) + "]";
    require_valid(scene.effects[i], field);
    const std::optional<BodyId> body = body_of(scene.effects[i]);
    if (body && !scene.row(*body))
      throw InvalidInput(field + ".body", std::to_string(body->value), "is not in the scene");
  }
  for (const Scene::Body& body : scene.bodies)
    world_->states.push_back(body.properties, !body.is_static, body.pose, body.velocity,
                             body.angular_velocity);
  world_->scene = std::move(scene);
  world_->options = options;
  if (options.threads > 1) world_->workers = std::make_unique<Workers>(options.threads);
  refresh_plan(*world_);
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::step(std::optional<double> dt) {
  const double h = dt.value_or(world_->options.dt);
  require_non_negative(h, "dt", "s", "time only runs forward");
  if (h == 0) return;
  const Clock::time_point start = Clock::now();
  run_step(*world_, h);
  world_->report.wall_seconds += seconds_since(start);
}

Report Simulation::advance(double seconds) {
  require_non_negative(seconds, "seconds", "s", "time only runs forward");
  const Report before = world_->report;
  world_->report.contact.deepest_overlap = world_->report.contact.residual = 0;
  world_->report.sweep.smallest_gap = SweepReport{}.smallest_gap;
  world_->report.repulsion.fastest = 0;
  const double end = before.time + seconds;
  // Equal steps that land on the end; a ratio that is whole but for rounding is not split once
  // more.
  const double ratio = seconds / world_->options.dt;
  const double whole = std::round(ratio);
  const auto n = static_cast<std::int64_t>(
      std::abs(ratio - whole) <= 4 * tolerance::unit_roundoff * ratio ? whole : std::ceil(ratio));
  for (std::int64_t k = 0; k < n; ++k) step(seconds / static_cast<double>(n));
  world_->clock.set(end);
  world_->report.time = end;
  Report report = difference(world_->report, before);
  ContactReport& total = world_->report.contact;
  total.deepest_overlap = std::max(total.deepest_overlap, before.contact.deepest_overlap);
  total.residual = std::max(total.residual, before.contact.residual);
  double& gap = world_->report.sweep.smallest_gap;
  gap = std::min(gap, before.sweep.smallest_gap);
  double& fastest = world_->report.repulsion.fastest;
  fastest = std::max(fastest, before.repulsion.fastest);
  return report;
}

int Simulation::size() const {
  return world_->states.size();
}
double Simulation::time() const {
  return world_->report.time;
}
double Simulation::dt() const {
  return world_->options.dt;
}
const Scene& Simulation::scene() const {
  return world_->scene;
}
const Plan& Simulation::plan() const {
  refresh_plan(*world_);
  return world_->plan;
}
const BodyStates& Simulation::states() const {
  return world_->states;
}
const Report& Simulation::report() const {
  return world_->report;
}
std::span<const Contact> Simulation::contacts() const {
  return world_->contacts;
}

}  // namespace carom
