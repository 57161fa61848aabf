// SPDX-License-Identifier: Apache-2.0
#include "bodies/sampled_moments.hpp"

#include <cmath>

namespace carom {
namespace {

constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

/// Moments of (scale * p - shift) from those of p: linear, so it carries the covariance too.
SampledMoments::Matrix moved(const Eigen::Vector3d& scale, const Eigen::Vector3d& shift) {
  SampledMoments::Matrix T = SampledMoments::Matrix::Zero();
  T(0, 0) = 1;
  for (int k = 0; k < 3; ++k) {
    T(1 + k, 1 + k) = scale[k];
    T(1 + k, 0) = -shift[k];
  }
  for (int e = 0; e < 6; ++e) {
    const int k = pairs[e][0], l = pairs[e][1];
    T(4 + e, 4 + e) = scale[k] * scale[l];
    T(4 + e, 1 + k) -= scale[k] * shift[l];
    T(4 + e, 1 + l) -= scale[l] * shift[k];
    T(4 + e, 0) = shift[k] * shift[l];
  }
  return T;
}

}  // namespace

MassProperties body_of(const SampledMoments& moments, const Eigen::Vector3d& centre,
                       const Eigen::Vector3d& half) {
  MassProperties body;
  body.mass = moments.value[0];
  if (!(body.mass > 0)) return body;
  const Eigen::Vector3d offset = half.cwiseProduct(moments.value.segment<3>(1)) / body.mass;
  body.com = centre + offset;
  const SampledMoments::Matrix T = moved(half, offset);
  const SampledMoments::Vector m = T * moments.value;
  const SampledMoments::Matrix C = T * moments.covariance * T.transpose();
  Eigen::Matrix3d second;
  for (int e = 0; e < 6; ++e)
    second(pairs[e][0], pairs[e][1]) = second(pairs[e][1], pairs[e][0]) = m[4 + e];
  body.inertia = inertia_of_second_moments(second);

  // About its own centre the first moments vanish, so to first order the centre's error does not
  // reach the tensor.
  SamplingError& error = body.error.emplace();
  const auto root = [](double variance) { return std::sqrt(std::max(variance, 0.0)); };
  error.mass = root(C(0, 0));
  for (int k = 0; k < 3; ++k) {
    const int a = 4 + (k + 1) % 3, b = 4 + (k + 2) % 3, off = 7 + k;
    error.com[k] = root(C(1 + k, 1 + k)) / body.mass;
    error.inertia(k, k) = root(C(a, a) + C(b, b) + 2 * C(a, b));
    error.inertia(k, (k + 1) % 3) = error.inertia((k + 1) % 3, k) = root(C(off, off));
  }
  error.samples = moments.samples;
  return body;
}

}  // namespace carom
