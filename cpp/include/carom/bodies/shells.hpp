// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/bodies/mass_properties.hpp"

/// Thin shells: all mass on the surface. surface_density: kg/m^2, > 0 (density times thickness).
/// Frames and sizes are those of the solids in MassProperties, so a cone's shell has its centre of
/// mass off the origin. Each @throws InvalidInput naming the offending argument.
namespace carom::shell {

enum class Caps { closed, open };  ///< whether the flat ends belong to the surface

[[nodiscard]] MassProperties sphere(double radius, double surface_density);
[[nodiscard]] MassProperties hemisphere(double radius, double surface_density,
                                        Caps caps = Caps::closed);
[[nodiscard]] MassProperties box(const Eigen::Vector3d& extents, double surface_density);
[[nodiscard]] MassProperties capsule(double radius, double length, double surface_density);
[[nodiscard]] MassProperties cylinder(double radius, double length, double surface_density,
                                      Caps caps = Caps::closed);
[[nodiscard]] MassProperties cone(double radius, double length, double surface_density,
                                  Caps caps = Caps::closed);
[[nodiscard]] MassProperties torus(double major_radius, double minor_radius,
                                   double surface_density);

/// Skin of one thickness everywhere (not the homoeoid of the textbooks, which is thinner at the
/// flat sides). The elliptic integrals are summed to rounding for any ratio of the radii up to 1e6.
[[nodiscard]] MassProperties ellipsoid(const Eigen::Vector3d& radii, double surface_density);

/// The faces of a mesh, which may be open and wound any way.
[[nodiscard]] MassProperties mesh(const TriangleMesh& mesh, double surface_density);

}  // namespace carom::shell
