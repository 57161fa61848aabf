// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/bodies/mass_properties.hpp"
#include "carom/numerics/invalid_input.hpp"

namespace carom {

/// A body whose products vanish, from its second moments per mass (m^2) about its centre of mass.
[[nodiscard]] inline MassProperties diagonal_body(double mass, const Eigen::Vector3d& second,
                                                  double com_z = 0) {
  if (!(mass > 0) || !std::isfinite(mass))
    throw InvalidInput("mass", with_unit(mass, "kg"), "must be finite and > 0",
                       "the sizes and the density leave the range of doubles");
  MassProperties body;
  body.mass = mass;
  body.com.z() = com_z;
  body.inertia = (mass * Eigen::Vector3d(second.y() + second.z(), second.z() + second.x(),
                                         second.x() + second.y()))
                     .asDiagonal();
  if (!body.inertia.allFinite())
    throw InvalidInput("inertia", "infinite", "must be finite",
                       "the sizes and the density leave the range of doubles");
  return body;
}

}  // namespace carom
