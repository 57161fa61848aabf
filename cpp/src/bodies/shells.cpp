// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/shells.hpp"

#include <cmath>
#include <numbers>

#include "bodies/diagonal_body.hpp"

namespace carom::shell {
namespace {
constexpr double pi = std::numbers::pi;

void require_surface_density(double density) {
  require_positive(density, "surface_density", "kg/m^2");
}

/// Adds up coaxial pieces: area, height of its centre, second moments per area about that centre.
struct Piece {
  double area, z, across, along;
};

MassProperties joined(std::initializer_list<Piece> pieces, double surface_density) {
  double area = 0, z = 0, across = 0, along = 0;
  for (const Piece& p : pieces) {
    area += p.area;
    z += p.area * p.z;
  }
  z /= area;
  for (const Piece& p : pieces) {
    across += p.area * p.across / area;
    along += p.area * (p.along + (p.z - z) * (p.z - z)) / area;
  }
  return diagonal_body(surface_density * area, {across, across, along}, z);
}

Piece flat_end(double radius, double z) {
  return {pi * radius * radius, z, radius * radius / 4, 0};
}

/// Integrals over the unit sphere of u_i^2 sqrt(sum z_j u_j^2), i = 0..2.
///
/// Weighted with a Gaussian and with sqrt(Q) = (1/2 sqrt(pi)) int (1 - e^{-sQ}) s^{-3/2} ds they
/// become one line integral of positive terms, so nothing cancels whatever the ratios. s = exp(pi
/// sinh(t)) makes the trapezoid rule converge doubly exponentially (Takahasi and Mori, 1974).
Eigen::Vector3d surface_integrals(const Eigen::Vector3d& z) {
  const double scale = z.maxCoeff(), step = 1.0 / 64;
  const Eigen::Vector3d x = z / scale;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = -64 * 4; k <= 64 * 4; ++k) {
    const double t = k * step;
    const double s = std::exp(pi * std::sinh(t));
    const Eigen::Vector3d d = x.array() / (1 + s * x.array());  // -d/ds log of each factor
    const double product = 1 / std::sqrt((1 + s * x.array()).prod());
    const double weight = std::sqrt(s) * product * pi * std::cosh(t);
    sum +=
        weight * (d.array() + 0.5 * d.sum()).matrix().cwiseQuotient((1 + s * x.array()).matrix());
  }
  return step * 0.5 * pi * std::sqrt(scale) * sum;
}

}  // namespace

MassProperties sphere(double radius, double surface_density) {
  require_positive(radius, "radius", "m");
  require_surface_density(surface_density);
  const double r2 = radius * radius;
  return diagonal_body(surface_density * 4 * pi * r2, Eigen::Vector3d::Constant(r2 / 3));
}

MassProperties hemisphere(double radius, double surface_density, Caps caps) {
  require_positive(radius, "radius", "m");
  require_surface_density(surface_density);
  const double r2 = radius * radius;
  const Piece dome{2 * pi * r2, radius / 2, r2 / 3, r2 / 12};
  if (caps == Caps::open) return joined({dome}, surface_density);
  return joined({dome, flat_end(radius, 0)}, surface_density);
}

MassProperties box(const Eigen::Vector3d& extents, double surface_density) {
  for (int i = 0; i < 3; ++i) require_positive(extents[i], "extents", "m");
  require_surface_density(surface_density);
  const double a = extents.x(), b = extents.y(), c = extents.z();
  const double area = 2 * (a * b + b * c + c * a);
  Eigen::Vector3d second;
  for (int i = 0; i < 3; ++i) {
    const double e = extents[i], f = extents[(i + 1) % 3], g = extents[(i + 2) % 3];
    second[i] = e * e * (f * g / 2 + e * (f + g) / 6) / area;
  }
  return diagonal_body(surface_density * area, second);
}

MassProperties capsule(double radius, double length, double surface_density) {
  require_positive(radius, "radius", "m");
  require_non_negative(length, "length", "m");
  require_surface_density(surface_density);
  const double r = radius, r2 = r * r, l = length;
  return joined({Piece{2 * pi * r * l, 0, r2 / 2, l * l / 12},
                 Piece{4 * pi * r2, 0, r2 / 3, r2 / 3 + l * l / 4 + l * r / 2}},
                surface_density);
}

MassProperties cylinder(double radius, double length, double surface_density, Caps caps) {
  require_positive(radius, "radius", "m");
  require_positive(length, "length", "m");
  require_surface_density(surface_density);
  const Piece side{2 * pi * radius * length, 0, radius * radius / 2, length * length / 12};
  if (caps == Caps::open) return joined({side}, surface_density);
  return joined({side, flat_end(radius, length / 2), flat_end(radius, -length / 2)},
                surface_density);
}

MassProperties cone(double radius, double length, double surface_density, Caps caps) {
  require_positive(radius, "radius", "m");
  require_positive(length, "length", "m");
  require_surface_density(surface_density);
  const double base = -length / 4;
  const Piece side{pi * radius * std::hypot(radius, length), base + length / 3, radius * radius / 4,
                   length * length / 18};
  if (caps == Caps::open) return joined({side}, surface_density);
  return joined({side, flat_end(radius, base)}, surface_density);
}

MassProperties torus(double major_radius, double minor_radius, double surface_density) {
  require_positive(major_radius, "major_radius", "m");
  require_positive(minor_radius, "minor_radius", "m");
  if (!(minor_radius <= major_radius))
    throw InvalidInput("minor_radius", with_unit(minor_radius, "m"), "must not exceed major_radius",
                       "a ring that overlaps itself has no closed form: mesh it");
  require_surface_density(surface_density);
  const double R2 = major_radius * major_radius, r2 = minor_radius * minor_radius;
  const double across = R2 / 2 + 3 * r2 / 4;
  return diagonal_body(surface_density * 4 * pi * pi * major_radius * minor_radius,
                       {across, across, r2 / 2});
}

MassProperties ellipsoid(const Eigen::Vector3d& radii, double surface_density) {
  for (int i = 0; i < 3; ++i) require_positive(radii[i], "radii", "m");
  require_surface_density(surface_density);
  // dA = abc sqrt(sum u_i^2 / a_i^2) d(solid angle) at the point (a_i u_i).
  const double size = radii.maxCoeff();
  const Eigen::Vector3d a = radii / size;
  const Eigen::Vector3d integrals = a.prod() * surface_integrals(a.cwiseAbs2().cwiseInverse());
  const double area = integrals.sum();
  return diagonal_body(surface_density * area * size * size,
                       size * size * a.cwiseAbs2().cwiseProduct(integrals) / area);
}

}  // namespace carom::shell
