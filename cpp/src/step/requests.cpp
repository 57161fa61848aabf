// SPDX-License-Identifier: Apache-2.0
// What can be asked of a simulation between steps. Everything is checked before anything changes.
#include <algorithm>
#include <string>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

int row_of(const World& world, BodyId id) {
  const std::optional<int> row = world.scene.row(id);
  if (!row) throw InvalidInput("body", std::to_string(id.value), "is not in the scene");
  return *row;
}

void require_finite(const Eigen::Vector3d& v, std::string_view field, std::string_view unit) {
  if (!v.allFinite()) throw InvalidInput(field, with_unit(v.transpose(), unit), "must be finite");
}

void ask(World& world, const Request& request) {
  wake(world, request.row);
  world.requests.push_back(request);
  world.plan_is_stale = true;
}

Eigen::Vector3d arm(const World& world, int row, const std::optional<Eigen::Vector3d>& point) {
  if (!point) return Eigen::Vector3d::Zero();
  require_finite(*point, "point", "m");
  return *point - world.states.position[row];
}

}  // namespace

BodyId Simulation::add(BodyDefinition definition) {
  const BodyId id = world_->scene.add(std::move(definition));
  const Scene::Body& body = world_->scene.bodies.back();
  world_->states.push_back(body.properties, !body.is_static, body.pose, body.velocity,
                           body.angular_velocity);
  world_->plan_is_stale = true;
  return id;
}

void Simulation::remove(BodyId id) {
  const int row = row_of(*world_, id);
  wake(*world_, -1);
  world_->asleep.clear(), world_->bed.clear(), world_->still.clear();
  world_->manifold_cache.clear(), world_->sweep.waited.clear();  // rows close up
  world_->scene.remove(id);
  world_->states.erase(row);
  world_->solver.memory.erase(row);
  std::erase_if(world_->requests, [&](const Request& r) { return r.row == row; });
  for (Request& r : world_->requests) r.row -= r.row > row;
  std::erase_if(world_->contacts, [&](const Contact& c) { return c.a == row || c.b == row; });
  for (Contact& c :
       world_->contacts) {  // what rests on it keeps the impulses of its other contacts
    c.a -= c.a > row;
    c.b -= c.b > row;
  }
  world_->plan_is_stale = true;
}

void Simulation::set_state(BodyId id, const Pose& pose, const Eigen::Vector3d& velocity,
                           const Eigen::Vector3d& angular_velocity) {
  const int row = row_of(*world_, id);
  require_finite(pose.position, "position", "m");
  const Eigen::Quaterniond q = unit_quaternion(pose.orientation.coeffs(), "orientation");
  require_finite(velocity, "velocity", "m/s");
  require_finite(angular_velocity, "angular_velocity", "rad/s");
  if (!world_->states.moves[row] && !(velocity.isZero(0) && angular_velocity.isZero(0)))
    throw InvalidInput("velocity", with_unit(velocity.transpose(), "m/s"),
                       "must be 0 for a static body");
  // What stands may have carried anything that sleeps.
  if (!world_->scene.bodies[row].is_static)
    wake(*world_, row);
  else if (std::ranges::count(world_->asleep, 1) > 0)
    wake(*world_, -1);
  if (row < static_cast<int>(world_->boxed.size())) world_->boxed[row] = 0;
  world_->states.set(row, {pose.position, q}, velocity, angular_velocity);
}

void Simulation::apply_force(BodyId id, const Eigen::Vector3d& force,
                             const std::optional<Eigen::Vector3d>& point) {
  const int row = row_of(*world_, id);
  require_finite(force, "force", "N");
  const Eigen::Vector3d torque = arm(*world_, row, point).cross(force);
  ask(*world_, {.row = row, .force = force, .torque = torque});
}

void Simulation::apply_torque(BodyId id, const Eigen::Vector3d& torque) {
  const int row = row_of(*world_, id);
  require_finite(torque, "torque", "N m");
  ask(*world_, {.row = row, .torque = torque});
}

void Simulation::apply_impulse(BodyId id, const Eigen::Vector3d& impulse,
                               const std::optional<Eigen::Vector3d>& point) {
  const int row = row_of(*world_, id);
  require_finite(impulse, "impulse", "N s");
  const Eigen::Vector3d angular = arm(*world_, row, point).cross(impulse);
  ask(*world_, {.row = row, .impulse = impulse, .angular_impulse = angular});
}

void Simulation::apply_angular_impulse(BodyId id, const Eigen::Vector3d& impulse) {
  const int row = row_of(*world_, id);
  require_finite(impulse, "angular_impulse", "N m s");
  ask(*world_, {.row = row, .angular_impulse = impulse});
}

void Simulation::hold_wrench(const AppliedWrench& wrench) {
  const int row = row_of(*world_, wrench.body);
  require_valid(Effect{wrench}, "wrench");
  wake(*world_, row);
  std::vector<Effect>& effects = world_->scene.effects;
  std::erase_if(effects, [&](const Effect& effect) {
    const auto* held = std::get_if<AppliedWrench>(&effect);
    return held && held->body == wrench.body;
  });
  if (!wrench.force.isZero(0) || !wrench.torque.isZero(0)) effects.emplace_back(wrench);
  world_->plan_is_stale = true;
}

}  // namespace carom
