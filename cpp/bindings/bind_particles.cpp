// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>

#include "carom/bodies/particles.hpp"
#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"

#include "arguments.hpp"
#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;
using carom::python::ArrayLike;

namespace {

/// x y z qx qy qz qw, as a row of Simulation.poses().
Pose pose_of(const ArrayLike& array) {
  const Eigen::VectorXd p = python::numbers(array, "pose");
  if (p.size() != 7)
    throw InvalidInput("pose", std::to_string(p.size()) + " numbers", "must be x y z qx qy qz qw");
  return {p.head<3>(), unit_quaternion(p.tail<4>(), "pose")};
}

Rows3 rows(const ArrayLike& array, const char* field, Eigen::Index n = -1) {
  Rows3 r = python::rows3(array, field);
  if (n >= 0 && r.rows() != n)
    throw InvalidInput(field, std::to_string(r.rows()) + " rows",
                       "must have one for each of " + std::to_string(n) + " particles");
  return r;
}

}  // namespace

void bind_particles(py::module_& parent) {
  py::module_ m = parent.def_submodule("particles", "A body as the particles it is made of.");
  m.def(
      "centred",
      [](const ArrayLike& positions, const ArrayLike& masses) {
        return centred({python::rows3(positions, "positions"), python::numbers(masses, "masses")})
            .positions;
      },
      "positions"_a, "masses"_a,
      "(N, 3) m: the same particles with their centre of mass at the origin of object space.");
  m.def(
      "to_world",
      [](const ArrayLike& positions, const ArrayLike& pose) {
        return to_world(rows(positions, "positions"), pose_of(pose));
      },
      "positions"_a, "pose"_a, "x = R p + X. positions: (N, 3) m; pose: (7,) x y z qx qy qz qw.");
  m.def(
      "to_object",
      [](const ArrayLike& positions, const ArrayLike& pose) {
        return to_object(rows(positions, "positions"), pose_of(pose));
      },
      "positions"_a, "pose"_a, "p = R^T (x - X), the inverse of to_world.");
  m.def(
      "velocities",
      [](const ArrayLike& positions, const ArrayLike& centre, const ArrayLike& velocity,
         const ArrayLike& angular_velocity) {
        return rigid_velocities(rows(positions, "positions"), python::vector3(centre, "centre"),
                                python::vector3(velocity, "velocity"),
                                python::vector3(angular_velocity, "angular_velocity"));
      },
      "positions"_a, "centre"_a, "velocity"_a, "angular_velocity"_a,
      "v = omega x (x - X) + V, (N, 3) m/s. positions: (N, 3) m, world; centre: (3,) m.");
  m.def(
      "momentum",
      [](const ArrayLike& masses, const ArrayLike& velocities) {
        const Eigen::VectorXd mass = python::numbers(masses, "masses");
        return momentum(mass, rows(velocities, "velocities", mass.size()));
      },
      "masses"_a, "velocities"_a, "Sum of m v, (3,) kg m/s.");
  m.def(
      "angular_momentum",
      [](const ArrayLike& masses, const ArrayLike& positions, const ArrayLike& velocities,
         const ArrayLike& about) {
        const Eigen::VectorXd mass = python::numbers(masses, "masses");
        return angular_momentum(mass, rows(positions, "positions", mass.size()),
                                rows(velocities, "velocities", mass.size()),
                                python::vector3(about, "about"));
      },
      "masses"_a, "positions"_a, "velocities"_a, "about"_a,
      "Sum of m (x - X) x v about the point X, (3,) kg m^2/s; world axes.");
  m.def(
      "kinetic_energy",
      [](const ArrayLike& masses, const ArrayLike& velocities) {
        const Eigen::VectorXd mass = python::numbers(masses, "masses");
        return kinetic_energy(mass, rows(velocities, "velocities", mass.size()));
      },
      "masses"_a, "velocities"_a, "Sum of m v^2 / 2, J.");
  m.def(
      "net_wrench",
      [](const ArrayLike& forces, const ArrayLike& positions, const ArrayLike& about) {
        const Rows3 f = rows(forces, "forces");
        const Wrench net =
            net_wrench(f, rows(positions, "positions", f.rows()), python::vector3(about, "about"));
        return py::make_tuple(net.force, net.torque);
      },
      "forces"_a, "positions"_a, "about"_a,
      "(force (3,) N, torque (3,) N m about the point) of forces (N, 3) at positions (N, 3).");
}
