// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom {

/// Diagonal form: inertia = axes * moments.asDiagonal() * axes^T, axes a rotation (det = +1),
/// moments ascending and never below 0. Source: lecture notes, "Inertia Tensor Simplified 2".
struct PrincipalAxes {
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();         ///< kg m^2
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();  ///< principal frame to B

  [[nodiscard]] Eigen::Matrix3d rotation() const { return axes.toRotationMatrix(); }
};

/// By cyclic Jacobi rotations: a tensor that is diagonal already keeps its moments to the last bit,
/// and equal moments give back the axes they came with (a sphere's are B's own).
/// @param inertia (3,3) kg m^2, symmetric; only the upper triangle is read
[[nodiscard]] PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia);

/// How many axes resist rotation: 3 for a solid, 2 for a rod, 0 for a point. A moment counts as
/// zero when <= tolerance::inertia_rank times the largest one.
[[nodiscard]] int inertia_rank(const Eigen::Matrix3d& inertia);

/// The inverse moments, 0 where the moment counts as zero (see inertia_rank).
[[nodiscard]] Eigen::Vector3d inverse_moments(const Eigen::Vector3d& moments);

/// Pseudo-inverse of an inertia tensor, (3,3) in 1/(kg m^2): axes about which nothing resists
/// rotation map to zero. Source: lecture notes, "Degenerate Inertia Tensors".
[[nodiscard]] Eigen::Matrix3d inverse_inertia(const Eigen::Matrix3d& inertia);

/// Refuses a tensor that no distribution of mass has: not finite, not symmetric, a negative moment,
/// or a largest moment above the sum of the other two (a flat plate is the limit, and legal).
/// @return the tensor made symmetric to the last bit @throws InvalidInput naming `field`
[[nodiscard]] Eigen::Matrix3d physical_inertia(const Eigen::Matrix3d& inertia,
                                               std::string_view field);

/// The tensor of second moments C: inertia = trace(C) 1 - C, with C = sum of m p p^T.
[[nodiscard]] Eigen::Matrix3d inertia_of_second_moments(const Eigen::Matrix3d& second);

}  // namespace carom
