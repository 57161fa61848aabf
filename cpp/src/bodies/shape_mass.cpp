// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape_mass.hpp"

#include <vector>

#include "carom/geometry/sdf.hpp"
#include "carom/numerics/invalid_input.hpp"

namespace carom::shape_mass {

MassProperties of(const Capsule& c, double density) {
  return MassProperties::capsule(c.radius, c.length, density);
}

MassProperties of(const Cylinder& c, double density) {
  return MassProperties::cylinder(c.radius, c.length, density);
}

MassProperties of(const Cone& c, double density) {
  return MassProperties::cone(c.radius, c.length, density);
}

MassProperties of(const Ellipsoid& e, double density) {
  return MassProperties::ellipsoid(e.radii, density);
}

MassProperties of(const ConvexHull& h, double density) {
  return MassProperties::mesh(*h.triangles, density);
}

MassProperties of(const Sdf& s, double density) {
  return MassProperties::mesh(s.grid->surface->mesh, density);
}

MassProperties of(const HeightField&, double) {
  throw InvalidInput("shape", "height_field", "has no mass", "set static");
}

MassProperties of(const ParticleSet& p, double density) {
  const MassProperties ball = MassProperties::sphere(p.radius, density);
  std::vector<MassProperties> balls;
  for (Eigen::Index i = 0; i < p.positions.rows(); ++i)
    balls.push_back(ball.transformed(Eigen::Matrix3d::Identity(), p.positions.row(i).transpose()));
  return MassProperties::combined(balls);
}

MassProperties of(const Compound& c, double density) {
  std::vector<MassProperties> all;
  for (const CompoundPart& part : *c.parts)
    all.push_back(mass_properties(part.shape, density)
                      .transformed(part.pose.orientation.toRotationMatrix(), part.pose.position));
  return MassProperties::combined(all);
}

}  // namespace carom::shape_mass
