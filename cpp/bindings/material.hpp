// SPDX-License-Identifier: Apache-2.0
// What a body is made of, in the words all factories of MassProperties share.
#pragma once
#include <optional>
#include <string>

#include "carom/bodies/mass_properties.hpp"
#include "carom/numerics/invalid_input.hpp"

namespace carom::python {

struct Material {
  std::optional<double> density, mass;
  bool shell = false;
  std::optional<double> thickness;

  /// @param solid, skin  the body of a density in kg/m^3, and of a surface density in kg/m^2
  template <class Solid, class Skin>
  [[nodiscard]] MassProperties fill(const Solid& solid, const Skin& skin) const {
    if (mass && density) throw InvalidInput("mass", "2 ways", "give one of mass and density");
    const double rho = density.value_or(default_density);
    if (!shell && !thickness) return mass ? solid(rho).scaled_to(*mass) : solid(rho);
    if (mass && thickness) throw InvalidInput("mass", "2 ways", "give one of mass and thickness");
    if (mass) return skin(1.0).scaled_to(*mass);
    if (!thickness)
      throw InvalidInput("shell", "no weight", "must come with thickness (m) or mass (kg)");
    require_positive(*thickness, "thickness", "m");
    require_positive(rho, "density", "kg/m^3");
    return skin(rho * *thickness);
  }
};

inline constexpr const char* material_doc =
    "\ndensity: kg/m^3 (1000 where nothing is given), or mass: kg, spread evenly.\n"
    "shell: all mass in a thin skin; with thickness (m, implies shell) it weighs density *\n"
    "thickness per m^2, else give mass.";

}  // namespace carom::python
