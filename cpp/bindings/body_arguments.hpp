// SPDX-License-Identifier: Apache-2.0
// The arguments that describe a body, once: Scene.add and Simulation.add take the same.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/scene/scene.hpp"

#include "arguments.hpp"

namespace carom::python {

inline constexpr const char* add_doc =
    "Adds a body and returns its id; ids are never used again.\n\n"
    "shape: any shape of this module; name: unique, letters, digits and _, a letter first\n"
    "('body_<id>' where none is given); static: never moves;\n"
    "mass: kg, spread evenly, or density: kg/m^3 (1000 where nothing is given), or\n"
    "mass_properties in the body frame;\n"
    "position: (3,) m and orientation: (4,) x y z w, of the body frame;\n"
    "velocity: (3,) m/s of that frame's origin; angular_velocity: (3,) rad/s; world axes;\n"
    "friction: >= 0, a pair uses sqrt(mu1 mu2); restitution: 0 to 1, a pair uses the larger;\n"
    "rolling_resistance, spinning_resistance: m, >= 0: torque bounds over the normal force, a "
    "pair\n"
    "uses the larger;\n"
    "ccd: 'auto' follows the body along its path in steps that move it farther than its own\n"
    "thickness allows, 'always' in every step, 'never': it may then pass through things;\n"
    "groups, meets: bits of the groups the body belongs to and of those it meets: two bodies meet\n"
    "where each belongs to a group the other meets; meets 0: nothing touches it.\n\n"
    "Raises InvalidInput (a ValueError) naming the field; nothing has changed then.";

inline Ccd ccd(const std::string& name, const std::string& field) {
  if (name == "auto") return Ccd::automatic;
  if (name == "always") return Ccd::always;
  if (name == "never") return Ccd::never;
  throw InvalidInput(field, "'" + name + "'", "must be 'auto', 'always' or 'never'");
}

/// 32 bits. @throws InvalidInput naming `field`
inline std::uint32_t group_bits(std::int64_t value, const std::string& field) {
  if (value < 0 || value > 0xffffffff)
    throw InvalidInput(field, std::to_string(value), "must be 32 bits, 0 to 0xffffffff");
  return static_cast<std::uint32_t>(value);
}

/// Binds `add(self, BodyDefinition)` under the name "add" with the keyword arguments of a body.
template <class Class, class Add>
void define_add(Class& cls, Add add) {
  namespace py = pybind11;
  using namespace py::literals;
  using Self = typename Class::type;
  const ArrayLike zero{py::make_tuple(0.0, 0.0, 0.0)};
  cls.def(
      "add",
      [add](Self& self, const Shape& shape, const std::string& name, bool is_static,
            std::optional<double> mass, std::optional<double> density,
            std::optional<MassProperties> mass_properties, const ArrayLike& position,
            const ArrayLike& orientation, const ArrayLike& velocity,
            const ArrayLike& angular_velocity, double friction, double restitution,
            double rolling_resistance, double spinning_resistance, const std::string& ccd,
            std::int64_t groups, std::int64_t meets) {
        const std::string at = name.empty() ? "" : name + ".";
        BodyDefinition body;
        body.name = name;
        body.shape = shape;
        body.is_static = is_static;
        body.mass = mass;
        body.density = density;
        body.mass_properties = mass_properties;
        body.pose.position = vector3(position, at + "position");
        body.pose.orientation = python::orientation(orientation, at + "orientation");
        body.velocity = vector3(velocity, at + "velocity");
        body.angular_velocity = vector3(angular_velocity, at + "angular_velocity");
        body.friction = friction;
        body.restitution = restitution;
        body.rolling_resistance = rolling_resistance;
        body.spinning_resistance = spinning_resistance;
        body.ccd = python::ccd(ccd, at + "ccd");
        body.groups = group_bits(groups, at + "groups");
        body.meets = group_bits(meets, at + "meets");
        return add(self, std::move(body));
      },
      "shape"_a, py::kw_only(), "name"_a = "", "static"_a = false, "mass"_a = py::none(),
      "density"_a = py::none(), "mass_properties"_a = py::none(),
      py::arg_v("position", zero, "(0, 0, 0)"),
      py::arg_v("orientation", ArrayLike{py::make_tuple(0.0, 0.0, 0.0, 1.0)}, "(0, 0, 0, 1)"),
      py::arg_v("velocity", zero, "(0, 0, 0)"), py::arg_v("angular_velocity", zero, "(0, 0, 0)"),
      "friction"_a = BodyDefinition{}.friction, "restitution"_a = BodyDefinition{}.restitution,
      "rolling_resistance"_a = 0.0, "spinning_resistance"_a = 0.0, "ccd"_a = "auto",
      "groups"_a = std::int64_t{BodyDefinition{}.groups},
      "meets"_a = std::int64_t{BodyDefinition{}.meets}, add_doc);
}

}  // namespace carom::python
