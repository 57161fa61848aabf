// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

#include "carom/bodies/mass_properties.hpp"
#include "carom/numerics/double_double.hpp"

namespace carom {

using DoubleDouble3 = std::array<DoubleDouble, 3>;

/// Adds the six entries of m (p.p 1 - p p^T), in the order xx yy zz xy yz zx.
inline void add_point_inertia(std::array<DoubleDouble, 6>& inertia, DoubleDouble mass,
                              const DoubleDouble3& p) {
  DoubleDouble3 mp, square;
  for (int i = 0; i < 3; ++i) {
    mp[i] = mass * p[i];
    square[i] = mp[i] * p[i];
  }
  for (int i = 0; i < 3; ++i) {
    inertia[i] += square[(i + 1) % 3] + square[(i + 2) % 3];
    inertia[3 + i] -= mp[i] * p[(i + 1) % 3];
  }
}

/// Union of n bodies by the parallel-axis theorem. Two passes: the second is about the centre of
/// mass rounded to a double, so differences of positions are (nearly) exact and a far origin costs
/// no digits. All sums in double-double: the order of the parts is below the last bits.
template <class MassAt, class ComAt, class InertiaAt>
MassProperties gathered(Eigen::Index n, const MassAt& mass_at, const ComAt& com_at,
                        const InertiaAt& inertia_at) {
  DoubleDouble mass;
  DoubleDouble3 first;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double m = mass_at(i);
    mass += m;
    for (int k = 0; k < 3; ++k) first[k] += exact_product(m, com_at(i)[k]);
  }
  MassProperties body;
  body.mass = double(mass);
  if (!(body.mass > 0)) return body;
  for (int k = 0; k < 3; ++k) body.com[k] = double(first[k] / mass);

  std::array<DoubleDouble, 6> inertia;
  DoubleDouble3 shift;  // from the rounded centre to the true one, summed first
  for (int k = 0; k < 3; ++k) shift[k] = first[k] / mass - DoubleDouble(body.com[k]);
  for (Eigen::Index i = 0; i < n; ++i) {
    DoubleDouble3 p;
    for (int k = 0; k < 3; ++k) p[k] = exact_difference(com_at(i)[k], body.com[k]) - shift[k];
    add_point_inertia(inertia, mass_at(i), p);
    const Eigen::Matrix3d& own = inertia_at(i);
    for (int k = 0; k < 3; ++k) {
      inertia[k] += own(k, k);
      inertia[3 + k] += own(k, (k + 1) % 3);
    }
  }
  for (int k = 0; k < 3; ++k) {
    body.inertia(k, k) = double(inertia[k]);
    body.inertia(k, (k + 1) % 3) = body.inertia((k + 1) % 3, k) = double(inertia[3 + k]);
  }
  return body;
}

}  // namespace carom
