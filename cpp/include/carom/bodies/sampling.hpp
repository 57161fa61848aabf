// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>

#include <Eigen/Core>

#include "carom/bodies/mass_properties.hpp"

namespace carom {

/// Density in kg/m^3 at each row of points (N,3), m: 0 outside the body, never negative. It may
/// vary in space. Called with some thousand points at a time.
using DensityField = std::function<Eigen::VectorXd(const TriangleMesh::Vertices& points)>;

/// A body of one density from an inside test, point by point.
[[nodiscard]] DensityField uniform_density(std::function<bool(const Eigen::Vector3d&)> inside,
                                           double density);

enum class SamplingMethod {
  monte_carlo,  ///< independent points: error ~ N^-1/2 whatever the body
  stratified,   ///< two points in each cell of a grid: ~ N^-2/3 at a surface, N^-5/6 inside
  grid,         ///< cell centres: no error estimate, and a bias that does not shrink smoothly
};

struct SamplingOptions {
  long samples = 100'000;  ///< at most this many points, >= 2
  SamplingMethod method = SamplingMethod::stratified;
  std::uint64_t seed = 0;  ///< same seed, same points, on every machine
};

/// Mass properties by quadrature over the box lower..upper (m), which must hold the whole body.
///
/// `error` holds one standard error of each number, propagated to first order from the covariance
/// of the ten moments (in a cell the two points' difference gives the variance, with no bias).
/// @throws InvalidInput for an empty box, fewer than 2 samples, a density that is negative or not
/// finite, or no sample inside. Source: lecture notes, "Approximating Inertia Tensors"; W. G.
/// Cochran, "Sampling Techniques", 1977, 5.
[[nodiscard]] MassProperties sampled(const DensityField& density, const Eigen::Vector3d& lower,
                                     const Eigen::Vector3d& upper,
                                     const SamplingOptions& options = {});

}  // namespace carom
