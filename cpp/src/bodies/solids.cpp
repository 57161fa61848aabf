// SPDX-License-Identifier: Apache-2.0
// Closed forms of the solids. Source: any handbook, e.g. W. D. MacMillan, "Dynamics of Rigid
// Bodies", 1936; the tests integrate each one again.
#include <cmath>
#include <numbers>

#include "carom/bodies/mass_properties.hpp"

#include "bodies/diagonal_body.hpp"

namespace carom {
namespace {
constexpr double pi = std::numbers::pi;

void require_density(double density) {
  require_positive(density, "density", "kg/m^3");
}

void require_hollow(double inner_radius, double outer_radius) {
  require_positive(outer_radius, "outer_radius", "m");
  require_non_negative(inner_radius, "inner_radius", "m");
  if (!(inner_radius < outer_radius))
    throw InvalidInput("inner_radius", with_unit(inner_radius, "m"), "must be below outer_radius",
                       "a shell without thickness is in carom::shell");
}
}  // namespace

MassProperties MassProperties::sphere(double radius, double density) {
  require_positive(radius, "radius", "m");
  require_density(density);
  const double r2 = radius * radius;
  return diagonal_body(density * 4 / 3 * pi * r2 * radius, Eigen::Vector3d::Constant(r2 / 5));
}

MassProperties MassProperties::hemisphere(double radius, double density) {
  require_positive(radius, "radius", "m");
  require_density(density);
  const double r2 = radius * radius;
  return diagonal_body(density * 2 / 3 * pi * r2 * radius,
                       {r2 / 5, r2 / 5, r2 * (1.0 / 5 - 9.0 / 64)}, 3 * radius / 8);
}

MassProperties MassProperties::hollow_sphere(double inner_radius, double outer_radius,
                                             double density) {
  require_hollow(inner_radius, outer_radius);
  require_density(density);
  // The differences of powers are divided out by hand: a thin wall would cancel.
  const double a = inner_radius, b = outer_radius;
  const double cubes = a * a + a * b + b * b;  // over b - a
  const double fifths = a * a * a * a + a * b * (a * a + a * b + b * b) + b * b * b * b;
  return diagonal_body(density * 4 / 3 * pi * (b - a) * cubes,
                       Eigen::Vector3d::Constant(fifths / cubes / 5));
}

MassProperties MassProperties::box(const Eigen::Vector3d& extents, double density) {
  for (int i = 0; i < 3; ++i) require_positive(extents[i], "extents", "m");
  require_density(density);
  return diagonal_body(density * extents.prod(), extents.cwiseAbs2() / 12);
}

MassProperties MassProperties::capsule(double radius, double length, double density) {
  require_positive(radius, "radius", "m");
  require_non_negative(length, "length", "m");
  require_density(density);
  const double r = radius, r2 = r * r, l = length;
  const double middle = pi * r2 * l, caps = pi * r2 * r * 4 / 3;
  const double across = (middle * r2 / 4 + caps * r2 / 5) / (middle + caps);
  const double along =
      (middle * l * l / 12 + caps * (r2 / 5 + l * l / 4 + 3 * l * r / 8)) / (middle + caps);
  return diagonal_body(density * (middle + caps), {across, across, along});
}

MassProperties MassProperties::cylinder(double radius, double length, double density) {
  return tube(0, radius, length, density);
}

MassProperties MassProperties::tube(double inner_radius, double outer_radius, double length,
                                    double density) {
  require_hollow(inner_radius, outer_radius);
  require_positive(length, "length", "m");
  require_density(density);
  const double across = (inner_radius * inner_radius + outer_radius * outer_radius) / 4;
  return diagonal_body(
      density * pi * (outer_radius - inner_radius) * (outer_radius + inner_radius) * length,
      {across, across, length * length / 12});
}

MassProperties MassProperties::cone(double radius, double length, double density) {
  require_positive(radius, "radius", "m");
  require_positive(length, "length", "m");
  require_density(density);
  const double across = 3 * radius * radius / 20;
  return diagonal_body(density * pi / 3 * radius * radius * length,
                       {across, across, 3 * length * length / 80});
}

MassProperties MassProperties::ellipsoid(const Eigen::Vector3d& radii, double density) {
  for (int i = 0; i < 3; ++i) require_positive(radii[i], "radii", "m");
  require_density(density);
  return diagonal_body(density * 4 / 3 * pi * radii.prod(), radii.cwiseAbs2() / 5);
}

MassProperties MassProperties::torus(double major_radius, double minor_radius, double density) {
  require_positive(major_radius, "major_radius", "m");
  require_positive(minor_radius, "minor_radius", "m");
  if (!(minor_radius <= major_radius))
    throw InvalidInput("minor_radius", with_unit(minor_radius, "m"), "must not exceed major_radius",
                       "a ring that overlaps itself has no closed form: sample or mesh it");
  require_density(density);
  const double R2 = major_radius * major_radius, r2 = minor_radius * minor_radius;
  const double across = R2 / 2 + 3 * r2 / 8;
  return diagonal_body(density * 2 * pi * pi * major_radius * r2, {across, across, r2 / 4});
}

MassProperties MassProperties::point(const Eigen::Vector3d& position, double mass) {
  require_positive(mass, "mass", "kg");
  for (int i = 0; i < 3; ++i) require_finite(position[i], "position", "m");
  MassProperties body = diagonal_body(mass, Eigen::Vector3d::Zero());
  body.com = position;
  return body;
}

MassProperties MassProperties::rod(double length, double mass) {
  require_positive(length, "length", "m");
  require_positive(mass, "mass", "kg");
  return diagonal_body(mass, {0, 0, length * length / 12});
}

MassProperties MassProperties::disc(double radius, double mass) {
  require_positive(radius, "radius", "m");
  require_positive(mass, "mass", "kg");
  return diagonal_body(mass, {radius * radius / 4, radius * radius / 4, 0});
}

MassProperties MassProperties::plate(const Eigen::Vector2d& extents, double mass) {
  for (int i = 0; i < 2; ++i) require_positive(extents[i], "extents", "m");
  require_positive(mass, "mass", "kg");
  return diagonal_body(mass, {extents.x() * extents.x() / 12, extents.y() * extents.y() / 12, 0});
}

}  // namespace carom
