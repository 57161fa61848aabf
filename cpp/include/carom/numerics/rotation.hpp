// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom {

/// Unit quaternion of the rotation by |phi| radians about phi/|phi|; the identity for phi = 0.
///
/// Exact to rounding for every finite phi, denormals included: sin(x)/x needs no series because
/// sin(x) itself is correctly rounded near 0.
[[nodiscard]] Eigen::Quaterniond rotation_exponential(const Eigen::Vector3d& phi);

/// The other way: the shortest rotation vector, |phi| <= pi. q and -q give the same answer.
[[nodiscard]] Eigen::Vector3d rotation_logarithm(const Eigen::Quaterniond& q);

/// Angle between two orientations, rad in [0, pi], accurate near 0 and near pi. The metric of every
/// study.
[[nodiscard]] double rotation_angle(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

/// A quaternion from outside, in storage order x y z w, normalised.
/// @throws InvalidInput when not finite, or its length is off 1 by more than
/// tolerance::quaternion_norm
[[nodiscard]] Eigen::Quaterniond unit_quaternion(const Eigen::Vector4d& xyzw,
                                                 std::string_view field);

/// The matrix a* of the cross product: skew(a) b = a x b.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& a);

}  // namespace carom
