// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>

#include "carom/bodies/mass_properties.hpp"
#include "carom/geometry/shape.hpp"

/// A body as the particles it is made of. Rows are particles. "World" quantities are where the
/// particles are now; "object" positions never change while the body moves.
/// Source: lecture notes, "Rigid Bodies" to "Inertia Tensor Simplified".
namespace carom {

using Rows3 = TriangleMesh::Vertices;  ///< (N,3), row by row, as arrays from Python lie

struct Particles {
  Rows3 positions;         ///< (N,3) m, object space
  Eigen::VectorXd masses;  ///< (N,) kg, >= 0, one at least > 0
};

/// Refuses wrong sizes, negative or no mass, and what is not finite. @throws InvalidInput
void require_valid(const Particles& particles);

/// Mass, centre of mass and inertia; collinear particles give rank 2, a single one rank 0.
[[nodiscard]] MassProperties mass_properties(const Particles& particles);

/// The same particles with the centre of mass moved to the origin of object space.
[[nodiscard]] Particles centred(const Particles& particles);

/// x_i = R p_i + X. positions (N,3) -> (N,3), m.
[[nodiscard]] Rows3 to_world(const Rows3& positions, const Pose& pose);
/// p_i = R^T (x_i - X), the way back.
[[nodiscard]] Rows3 to_object(const Rows3& positions, const Pose& pose);

/// v_i = omega x (x_i - X) + V, m/s: x_i, X in m (world), omega in rad/s, V in m/s the velocity at
/// X.
[[nodiscard]] Rows3 rigid_velocities(const Rows3& world_positions, const Eigen::Vector3d& centre,
                                     const Eigen::Vector3d& velocity,
                                     const Eigen::Vector3d& angular_velocity);

/// P = sum of m_i v_i, kg m/s.
[[nodiscard]] Eigen::Vector3d momentum(const Eigen::VectorXd& masses, const Rows3& velocities);
/// L = sum of m_i (x_i - X) x v_i about the point X, kg m^2/s.
[[nodiscard]] Eigen::Vector3d angular_momentum(const Eigen::VectorXd& masses,
                                               const Rows3& world_positions,
                                               const Rows3& velocities,
                                               const Eigen::Vector3d& about);
/// Sum of m_i v_i^2 / 2, J.
[[nodiscard]] double kinetic_energy(const Eigen::VectorXd& masses, const Rows3& velocities);

struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m, about the point asked for
};
/// F = sum of F_i and T = sum of (x_i - X) x F_i. Internal forces, equal and opposite along the
/// line between two particles, add nothing to either.
[[nodiscard]] Wrench net_wrench(const Rows3& forces, const Rows3& world_positions,
                                const Eigen::Vector3d& about);

}  // namespace carom
