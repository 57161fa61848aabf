// SPDX-License-Identifier: Apache-2.0
#include "carom/scene/scene.hpp"

#include <algorithm>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"

namespace carom {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_name(std::string_view name) {
  return !name.empty() && is_letter(name[0]) && std::ranges::all_of(name, [](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
  });
}

void require_finite(const Eigen::Vector3d& v, const std::string& field, std::string_view unit) {
  if (!v.allFinite()) throw InvalidInput(field, with_unit(v.transpose(), unit), "must be finite");
}

void require_valid_mass(const BodyDefinition& body) {
  const int given = int{body.mass.has_value()} + int{body.density.has_value()} +
                    int{body.mass_properties.has_value()};
  if (given > 1)
    throw InvalidInput(body.name + ".mass", std::to_string(given) + " ways",
                       "give one of mass, density and mass_properties");
  if (body.mass)
    require_positive(*body.mass, body.name + ".mass", "kg", "give density or set static");
  if (body.density) require_positive(*body.density, body.name + ".density", "kg/m^3");
  if (body.mass_properties)
    require_positive(body.mass_properties->mass, body.name + ".mass_properties.mass", "kg");
  if (std::holds_alternative<Plane>(body.shape) && !body.is_static)
    throw InvalidInput(body.name + ".shape", "plane", "cannot move", "set static");
  if (std::holds_alternative<HeightField>(body.shape) && !body.is_static)
    throw InvalidInput(body.name + ".shape", "height field", "cannot move", "set static");
}

void require_valid(const BodyDefinition& body) {
  if (!is_name(body.name))
    throw InvalidInput("name", "'" + body.name + "'", "must match [A-Za-z][A-Za-z0-9_]*");
  require_valid(body.shape, body.name + ".shape");
  require_valid_mass(body);
  require_finite(body.pose.position, body.name + ".position", "m");
  (void)unit_quaternion(body.pose.orientation.coeffs(), body.name + ".orientation");
  require_finite(body.velocity, body.name + ".velocity", "m/s");
  require_finite(body.angular_velocity, body.name + ".angular_velocity", "rad/s");
  require_non_negative(body.friction, body.name + ".friction", "");
  if (!(body.restitution >= 0 && body.restitution <= 1))
    throw InvalidInput(body.name + ".restitution", with_unit(body.restitution, ""),
                       "must be from 0 to 1");
  require_non_negative(body.rolling_resistance, body.name + ".rolling_resistance", "m");
  require_non_negative(body.spinning_resistance, body.name + ".spinning_resistance", "m");
  if (body.groups == 0)
    throw InvalidInput(body.name + ".groups", "0", "must have a bit set",
                       "a body that nothing touches has meets = 0");
  if (body.is_static && (!body.velocity.isZero(0) || !body.angular_velocity.isZero(0)))
    throw InvalidInput(body.name + ".velocity", with_unit(body.velocity.transpose(), "m/s"),
                       "must be 0 for a static body");
}

}  // namespace

MassProperties mass_properties(const BodyDefinition& body) {
  if (body.is_static) return {};
  if (body.mass_properties) return *body.mass_properties;
  MassProperties properties = mass_properties(body.shape, body.density.value_or(default_density));
  if (body.mass) {  // inertia scales with mass at a given shape
    properties.inertia *= *body.mass / properties.mass;
    properties.mass = *body.mass;
  }
  return properties;
}

BodyId Scene::add(BodyDefinition body) {
  const BodyId id{next_id_};
  if (body.name.empty()) body.name = "body_" + std::to_string(id.value);
  require_valid(body);
  if (names_.size() != bodies.size()) {
    names_.clear();
    for (const Body& b : bodies) names_.add(b.name, b.id);
  }
  if (find_indexed(body.name, names_compared_))
    throw InvalidInput("name", "'" + body.name + "'", "is taken", "names are unique in a scene");
  body.pose.orientation.normalize();
  const MassProperties properties = mass_properties(body);
  bodies.push_back({std::move(body), id, properties});
  names_.add(bodies.back().name, id);
  ++next_id_;
  return id;
}

void Scene::never_meet(BodyId a, BodyId b) {
  const auto body = [&](BodyId id) -> const Body& {
    const std::optional<int> i = row(id);
    if (!i) throw InvalidInput("never_meet", std::to_string(id.value), "is not in the scene");
    return bodies[*i];
  };
  const Body &first = body(a), &second = body(b);
  if (a == b)
    throw InvalidInput("never_meet", "'" + first.name + "' twice", "must be two bodies",
                       "a body that nothing touches has meets = 0");
  if (first.is_static && second.is_static)
    throw InvalidInput("never_meet", "'" + first.name + "' and '" + second.name + "'",
                       "are both static", "static bodies never meet");
  const auto pair = std::minmax(a, b);
  const auto at = std::ranges::lower_bound(never, std::pair<BodyId, BodyId>(pair));
  if (at == never.end() || *at != std::pair<BodyId, BodyId>(pair)) never.insert(at, pair);
}

void Scene::remove(BodyId id) {
  const std::optional<int> i = row(id);
  if (!i) throw InvalidInput("body", std::to_string(id.value), "is not in the scene");
  names_.remove(bodies[*i].name, id);
  bodies.erase(bodies.begin() + *i);
  std::erase_if(never, [&](const auto& pair) { return pair.first == id || pair.second == id; });
  std::erase_if(effects, [&](const Effect& effect) { return body_of(effect) == id; });
}

std::optional<BodyId> Scene::find_indexed(std::string_view name, std::int64_t& compared) const {
  const auto named = [&](BodyId id) {
    const std::optional<int> i = row(id);
    return i && bodies[*i].name == name;
  };
  return names_.find(name, named, compared);
}

std::optional<BodyId> Scene::find(std::string_view name) const {
  std::int64_t compared = 0;
  if (const auto id = find_indexed(name, compared)) return id;
  // Whoever renames a body in place is still found.
  const auto it = std::ranges::find(bodies, name, &Body::name);
  return it == bodies.end() ? std::nullopt : std::optional(it->id);
}

std::optional<int> Scene::row(BodyId id) const {
  const auto it = std::ranges::lower_bound(bodies, id, {}, &Body::id);
  if (it == bodies.end() || it->id != id) return std::nullopt;
  return static_cast<int>(it - bodies.begin());
}

}  // namespace carom
