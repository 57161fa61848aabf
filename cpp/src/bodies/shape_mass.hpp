// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/bodies/mass_properties.hpp"

// Mass properties of the shapes beyond sphere, box and mesh; density in kg/m^3.
namespace carom::shape_mass {

[[nodiscard]] MassProperties of(const Capsule& capsule, double density);
[[nodiscard]] MassProperties of(const Cylinder& cylinder, double density);
[[nodiscard]] MassProperties of(const Cone& cone, double density);
[[nodiscard]] MassProperties of(const Ellipsoid& ellipsoid, double density);
[[nodiscard]] MassProperties of(const ConvexHull& hull, double density);
/// Of the mesh of its zero level: off by the square of the cell size.
[[nodiscard]] MassProperties of(const Sdf& sdf, double density);
[[nodiscard]] MassProperties of(const HeightField& terrain, double density);
/// Balls and parts add up; where they overlap, mass counts twice.
[[nodiscard]] MassProperties of(const ParticleSet& particles, double density);
[[nodiscard]] MassProperties of(const Compound& compound, double density);

}  // namespace carom::shape_mass
