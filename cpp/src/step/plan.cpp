// SPDX-License-Identifier: Apache-2.0
#include "carom/step/plan.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "carom/numerics/tolerance.hpp"

#include "step/pair_filter.hpp"

namespace carom {
namespace {

std::string count(int n, std::string_view one, std::string_view many) {
  return std::to_string(n) + ' ' + std::string(n == 1 ? one : many);
}

template <class E>
int effects_of(const Scene& scene) {
  return static_cast<int>(std::ranges::count_if(
      scene.effects, [](const Effect& e) { return std::holds_alternative<E>(e); }));
}

/// Bodies whose inertia is not that of a sphere: only these have a gyroscopic term.
int tops(const Scene& scene) {
  return static_cast<int>(std::ranges::count_if(scene.bodies, [](const Scene::Body& body) {
    if (body.is_static) return false;
    const Eigen::Matrix3d& I = body.properties.inertia;
    return !I.isApprox(I(0, 0) * Eigen::Matrix3d::Identity(), tolerance::equal_moments);
  }));
}

}  // namespace

std::string_view name_of(StageKind kind) {
  constexpr std::string_view names[] = {"gravity",   "applied_wrench", "drag",      "torsion",
                                        "pairs",     "contacts",       "repulsion", "solve",
                                        "integrate", "sweep"};
  return names[static_cast<int>(kind)];
}

bool Plan::runs(StageKind kind) const {
  return std::ranges::any_of(stages, [&](const Stage& s) { return s.kind == kind && s.on; });
}

std::string Plan::to_string() const {
  std::ostringstream out;
  for (const Stage& s : stages)
    out << (s.on ? "on   " : "off  ") << std::left << std::setw(16) << name_of(s.kind) << s.reason
        << '\n';
  return out.str();
}

Plan compile(const Scene& scene, bool wrench_requested) {
  Plan plan;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (!scene.bodies[i].is_static) plan.movers.push_back(static_cast<int>(i));
  const int bodies = static_cast<int>(scene.bodies.size());
  const int movers = static_cast<int>(plan.movers.size());
  const bool moves = movers > 0;
  const std::string moving = count(movers, "body moves", "bodies move");

  const auto add = [&](StageKind kind, bool on, std::string because, std::string why_not, int n) {
    plan.stages.push_back({kind, on, on ? std::move(because) : std::move(why_not), on ? n : 0});
  };
  const int gravities = effects_of<UniformGravity>(scene);
  add(StageKind::gravity, gravities && moves, "UniformGravity in the scene, " + moving,
      gravities ? "nothing moves" : "no UniformGravity in the scene", movers);

  const int held = effects_of<AppliedWrench>(scene);
  add(StageKind::applied_wrench, held || wrench_requested,
      held ? "a wrench is held on " + count(held, "body", "bodies")
           : "a force or impulse was asked for the next step",
      "no wrench is held or asked for", std::max(held, 1));

  const int drags = effects_of<LinearDrag>(scene), springs = effects_of<TorsionSpring>(scene);
  add(StageKind::drag, drags && moves, "LinearDrag in the scene, " + moving,
      drags ? "nothing moves" : "no LinearDrag in the scene", movers);
  add(StageKind::torsion, springs && moves,
      "a TorsionSpring turns " + count(springs, "body", "bodies"),
      springs ? "nothing moves" : "no TorsionSpring in the scene", springs);

  const bool can_meet = moves && bodies >= 2;
  const std::string meet = count(bodies, "shape", "shapes") + ", " + moving;
  const std::string alone = moves ? "a single body has nothing to meet" : "nothing moves";
  const std::string filters = filters_of(scene);
  add(StageKind::pairs, can_meet, meet + (filters.empty() ? "" : "; filters on: " + filters), alone,
      bodies);
  add(StageKind::contacts, can_meet, meet, alone, bodies);
  const int repulsions = effects_of<Repulsion>(scene);
  add(StageKind::repulsion, repulsions && can_meet, "Repulsion in the scene, " + moving,
      repulsions ? alone : "no Repulsion in the scene", movers);
  const auto any = [&](auto test) { return std::ranges::any_of(scene.bodies, test); };
  const bool rubs = any([](const Scene::Body& b) { return b.friction > 0; });
  const bool bounces = any([](const Scene::Body& b) { return b.restitution > 0; });
  const bool resists = any(
      [](const Scene::Body& b) { return b.rolling_resistance > 0 || b.spinning_resistance > 0; });
  add(StageKind::solve, can_meet,
      std::string("contacts push; friction ") +
          (rubs ? "on: a body has friction > 0" : "off: none asked") + "; restitution " +
          (bounces ? "on: a body has restitution > 0" : "off: none asked") +
          (resists ? "; rolling or spinning resistance on: a body has it > 0" : ""),
      alone, movers);

  const int asymmetric = tops(scene);
  add(StageKind::integrate, moves,
      moving + "; gyroscopic term " +
          (asymmetric ? "on: " + count(asymmetric, "body has", "bodies have") +
                            " unequal principal moments"
                      : "off: all principal moments are equal"),
      "nothing moves", movers);

  const auto swept = std::ranges::count_if(
      scene.bodies, [](const Scene::Body& b) { return !b.is_static && b.ccd != Ccd::never; });
  add(StageKind::sweep, can_meet && swept > 0,
      count(static_cast<int>(swept), "body is", "bodies are") +
          " followed along the path in steps faster than its thickness allows",
      can_meet ? "every body has ccd: never" : alone, static_cast<int>(swept));
  return plan;
}

}  // namespace carom
