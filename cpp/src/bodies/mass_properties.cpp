// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/mass_properties.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "bodies/parallel_axis.hpp"
#include "bodies/shape_mass.hpp"

namespace carom {
namespace {

void require_rotation(const Eigen::Matrix3d& R) {
  const double off = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= tolerance::rotation_matrix))
    throw InvalidInput("rotation", "off R R^T = 1 by " + with_unit(off, ""), "must be a rotation",
                       "scale the sizes instead of the frame");
  if (!(R.determinant() > 0))
    throw InvalidInput("rotation", "determinant -1", "must be a rotation, not a reflection",
                       "mirror the shape instead");
}

void add_warnings(std::vector<std::string>& to, const std::vector<std::string>& from) {
  for (const std::string& text : from)
    if (std::find(to.begin(), to.end(), text) == to.end()) to.push_back(text);
}

/// First-order propagation of the parts' errors into the union, in quadrature as if the errors of
/// mass, centre and inertia were independent.
SamplingError combined_error(std::span<const MassProperties> parts, const MassProperties& whole) {
  SamplingError total;
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  // variances until the end
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const MassProperties& part : parts) {
    if (!part.error) continue;
    const SamplingError& e = *part.error;
    const Eigen::Vector3d d = part.com - whole.com;
    const Eigen::Matrix3d arm = d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose();
    total.mass = std::hypot(total.mass, e.mass);
    com += (part.mass / whole.mass * e.com).cwiseAbs2() + (e.mass / whole.mass * d).cwiseAbs2();
    inertia += e.inertia.cwiseAbs2() + (e.mass * arm).cwiseAbs2();
    for (int k = 0; k < 3; ++k) {  // d arm / d d_k
      Eigen::Matrix3d slope = 2 * d[k] * Eigen::Matrix3d::Identity();
      slope.row(k) -= d.transpose();
      slope.col(k) -= d;
      inertia += (part.mass * e.com[k] * slope).cwiseAbs2();
    }
    total.samples += e.samples;
  }
  total.com = com.cwiseSqrt();
  total.inertia = inertia.cwiseSqrt();
  return total;
}

}  // namespace

MassProperties MassProperties::checked(double mass, const Eigen::Vector3d& com,
                                       const Eigen::Matrix3d& inertia) {
  require_positive(mass, "mass", "kg");
  if (!com.allFinite())
    throw InvalidInput("com", with_unit(com.transpose(), "m"), "must be finite");
  MassProperties body;
  body.mass = mass;
  body.com = com;
  body.inertia = physical_inertia(inertia, "inertia");
  return body;
}

MassProperties MassProperties::combined(std::span<const MassProperties> parts) {
  MassProperties whole = gathered(
      std::ssize(parts), [&](Eigen::Index i) { return parts[i].mass; },
      [&](Eigen::Index i) -> const Eigen::Vector3d& { return parts[i].com; },
      [&](Eigen::Index i) -> const Eigen::Matrix3d& { return parts[i].inertia; });
  if (!(whole.mass > 0) || !std::isfinite(whole.mass) || !whole.inertia.allFinite())
    throw InvalidInput("parts", with_unit(whole.mass, "kg"), "must add up to a finite mass > 0");
  for (const MassProperties& part : parts) add_warnings(whole.warnings, part.warnings);
  if (std::any_of(parts.begin(), parts.end(), [](const auto& p) { return p.error.has_value(); }))
    whole.error = combined_error(parts, whole);
  return whole;
}

MassProperties operator+(const MassProperties& a, const MassProperties& b) {
  const MassProperties parts[] = {a, b};
  return MassProperties::combined(parts);
}

MassProperties MassProperties::transformed(const Eigen::Matrix3d& rotation,
                                           const Eigen::Vector3d& translation) const {
  require_rotation(rotation);
  if (!translation.allFinite())
    throw InvalidInput("translation", with_unit(translation.transpose(), "m"), "must be finite");
  MassProperties moved = *this;
  moved.com = rotation * com + translation;
  const Eigen::Matrix3d turned = rotation * inertia * rotation.transpose();
  moved.inertia = 0.5 * (turned + turned.transpose());
  if (error) {  // entries are correlated in an unknown way: the bound is their sum
    const Eigen::Matrix3d R = rotation.cwiseAbs();
    moved.error->com = R * error->com;
    moved.error->inertia = R * error->inertia * R.transpose();
  }
  return moved;
}

MassProperties MassProperties::scaled_to(double new_mass) const {
  require_positive(new_mass, "mass", "kg");
  require_positive(mass, "mass of the body to scale", "kg");
  MassProperties scaled = *this;
  const double factor = new_mass / mass;
  scaled.mass = new_mass;
  scaled.inertia *= factor;
  if (error) {
    // The mass is given now, so it carries no error; the tensor's part of it stays, a bound.
    scaled.error->mass = 0;
    scaled.error->inertia *= factor;
  }
  return scaled;
}

MassProperties mass_properties(const Shape& shape, double density) {
  struct Visit {
    double density;
    MassProperties operator()(const Sphere& s) const {
      return MassProperties::sphere(s.radius, density);
    }
    MassProperties operator()(const Box& b) const {
      return MassProperties::box(b.extents, density);
    }
    MassProperties operator()(const Plane&) const {
      throw InvalidInput("shape", "plane", "has no mass", "set static");
    }
    MassProperties operator()(const Mesh& m) const {
      return MassProperties::mesh(*m.triangles, density);
    }
    MassProperties operator()(const Capsule& x) const { return shape_mass::of(x, density); }
    MassProperties operator()(const Cylinder& x) const { return shape_mass::of(x, density); }
    MassProperties operator()(const Cone& x) const { return shape_mass::of(x, density); }
    MassProperties operator()(const Ellipsoid& x) const { return shape_mass::of(x, density); }
    MassProperties operator()(const ConvexHull& x) const { return shape_mass::of(x, density); }
    MassProperties operator()(const Sdf& x) const { return shape_mass::of(x, density); }
    MassProperties operator()(const HeightField& x) const { return shape_mass::of(x, density); }
    MassProperties operator()(const ParticleSet& x) const { return shape_mass::of(x, density); }
    MassProperties operator()(const Compound& x) const { return shape_mass::of(x, density); }
  };
  return std::visit(Visit{density}, shape);
}

}  // namespace carom
