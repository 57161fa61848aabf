// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "carom/bodies/mass_properties.hpp"
#include "carom/geometry/shape.hpp"

namespace carom {

/// Three scalars per body, each in an array of its own.
struct Array3 {
  std::vector<double> x, y, z;

  [[nodiscard]] Eigen::Vector3d operator[](int i) const { return {x[i], y[i], z[i]}; }
  void set(int i, const Eigen::Vector3d& v) { x[i] = v.x(), y[i] = v.y(), z[i] = v.z(); }
  void push_back(const Eigen::Vector3d& v);
  void erase(int i);
};

/// Quaternions, four arrays.
struct Array4 {
  std::vector<double> x, y, z, w;

  [[nodiscard]] Eigen::Quaterniond operator[](int i) const { return {w[i], x[i], y[i], z[i]}; }
  void set(int i, const Eigen::Quaterniond& q) {
    x[i] = q.x(), y[i] = q.y(), z[i] = q.z(), w[i] = q.w();
  }
  void push_back(const Eigen::Quaterniond& q);
  void erase(int i);
};

/// State and constants of all bodies as a structure of arrays; row i is body i of the scene.
///
/// What is carried is the centre of mass, the principal frame P (diagonal inertia) and the world
/// angular momentum: |L| then keeps its digits however long a body tumbles. The body frame B that
/// users see is derived. Static bodies have zero inverse mass and moments and a frame P equal to B.
struct BodyStates {
  Array3 position;          ///< m, centre of mass
  Array3 velocity;          ///< m/s, of the centre of mass
  Array4 orientation;       ///< principal frame to world
  Array3 angular_momentum;  ///< kg m^2/s, about the centre of mass, world axes

  std::vector<double> mass;          ///< kg; 0 for static bodies
  std::vector<double> inverse_mass;  ///< 1/kg; 0 for static bodies
  Array3 moments;                    ///< kg m^2, principal, ascending
  Array3 inverse_moments;            ///< pseudo-inverse: 0 about an axis that resists nothing
  Array3 com_b;                      ///< m, centre of mass in B
  Array4 axes_b;                     ///< principal frame to B
  std::vector<std::uint8_t> moves;   ///< 1 for dynamic bodies

  [[nodiscard]] int size() const { return static_cast<int>(mass.size()); }
  void push_back(const MassProperties& properties, bool moves, const Pose& pose,
                 const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity);
  void erase(int i);
  /// Pose of the body frame, velocity of its origin (m/s) and angular velocity (rad/s), world axes.
  void set(int i, const Pose& pose, const Eigen::Vector3d& velocity,
           const Eigen::Vector3d& angular_velocity);

  [[nodiscard]] Pose pose(int i) const;                         ///< of the body frame
  [[nodiscard]] Eigen::Vector3d angular_velocity(int i) const;  ///< rad/s, world axes
  [[nodiscard]] double angular_speed(int i) const;              ///< rad/s
  [[nodiscard]] Eigen::Matrix3d world_inverse_inertia(int i) const;
  /// Velocity of a world point that moves with body i, m/s.
  [[nodiscard]] Eigen::Vector3d velocity_at(int i, const Eigen::Vector3d& point) const;
  [[nodiscard]] double kinetic_energy(int i) const;  ///< J
};

}  // namespace carom
