// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include <Eigen/Core>

namespace carom {

/// The four cubic B-splines that are not zero between two samples, `t` cells after the first, and
/// their slopes, 1/cell.
struct SplineWeights {
  std::array<double, 4> value, slope;

  explicit SplineWeights(double t) {
    const double s = 1 - t;
    value = {s * s * s / 6, (4 - 3 * t * t * (1 + s)) / 6, (4 - 3 * s * s * (1 + t)) / 6,
             t * t * t / 6};
    slope = {-s * s / 2, t * (3 * t - 4) / 2, -s * (3 * s - 4) / 2, t * t / 2};
  }
};

/// Coefficients of a cubic spline along samples on a grid, two more along each axis than it has
/// samples: the first belongs to the place one cell before the first sample.
///
/// Each is worked out from five samples a side, f - d2 f / 6 + d4 f / 36: cubics come out exact and
/// smooth functions as by the spline through all samples, to the sixth order. That one would carry
/// what happens at a crease on without end, 0.27 times as much in every cell; here it ends after
/// four. At the ends of the grid the last four samples go on as their cubic.
/// @param samples  x fastest
/// @param count    along each axis, >= 4
/// Source: C. de Boor, G. Fix, J. Approx. Theory 8, 1973 (quasi-interpolants).
[[nodiscard]] std::vector<double> spline_coefficients(const std::vector<double>& samples,
                                                      const Eigen::Vector3i& count);

}  // namespace carom
