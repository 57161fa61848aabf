// SPDX-License-Identifier: Apache-2.0
#include "carom/step/rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "carom/numerics/tolerance.hpp"
#include "carom/step/exact_top.hpp"
#include "carom/step/taylor_top.hpp"

#include "step/lone_schemes.hpp"
#include "step/rotation_cpu_levels.hpp"

namespace carom {
namespace {
using Eigen::Quaterniond;
using Eigen::Vector3d;

bool has_avx2() {
#if defined(__x86_64__) && defined(__GNUC__)
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
#else
  return false;
#endif
}

bool advance_in_lanes(Integrator method, const RotationArrays& arrays, const int* rows, int count,
                      double dt, RotationReport& report) {
#ifdef __x86_64__
  if (has_avx2()) return kernel::advance_rotation_avx2(method, arrays, rows, count, dt, report);
#endif
  return kernel::advance_rotation_portable(method, arrays, rows, count, dt, report);
}

Quaterniond lone_step(Integrator method, const Quaterniond& q, const Vector3d& l, const Vector3d& a,
                      double h, bool& converged) {
  if (method == Integrator::implicit_midpoint)
    return kernel::implicit_midpoint(q, l, a, h, converged);
  const Eigen::Matrix3d next = kernel::lecture_update(q.toRotationMatrix(), l, a.asDiagonal(), h);
  return Quaterniond(method == Integrator::lecture_polar ? kernel::polar_rotation(next, converged)
                                                         : kernel::gram_schmidt(next));
}

/// Bodies one at a time, by the methods that iterate.
Quaterniond advance_one(Integrator method, Quaterniond q, const Vector3d& l, const Vector3d& a,
                        double dt, RotationReport& report) {
  if (method == Integrator::exact) return exact_flight(q, l, a, dt).orientation;
  if (method == Integrator::taylor) {
    const TaylorFlight flight = taylor_flight(q, l, a, dt, tolerance::taylor_step_error);
    report.not_converged += flight.capped;
    return flight.orientation;
  }
  const double turn = a.cwiseProduct(q.conjugate() * l).norm() * std::abs(dt);
  const double wanted = std::ceil(turn / tolerance::rotation_per_substep);
  report.capped += wanted > tolerance::rotation_substeps;
  const int n = static_cast<int>(std::clamp(wanted, 1.0, tolerance::rotation_substeps));
  report.most_substeps = std::max(report.most_substeps, n);
  bool converged = true;
  for (int i = 0; i < n; ++i) q = lone_step(method, q, l, a, dt / n, converged);
  report.not_converged += !converged;
  return q;
}

}  // namespace

std::string_view rotation_cpu_level() {
  return has_avx2() ? "avx2" : "portable";
}

void advance_rotation(Integrator method, const RotationArrays& r, std::span<const int> rows,
                      double dt, RotationReport& report) {
  const int count = static_cast<int>(rows.size());
  if (dt == 0 || advance_in_lanes(method, r, rows.data(), count, dt, report)) return;
  for (const int i : rows) {
    const Quaterniond q(r.qw[i], r.qx[i], r.qy[i], r.qz[i]);
    const Vector3d l(r.lx[i], r.ly[i], r.lz[i]), a(r.a1[i], r.a2[i], r.a3[i]);
    if (!std::isfinite(l.squaredNorm() + q.squaredNorm())) continue;  // the caller freezes it
    const Quaterniond next = advance_one(method, q, l, a, dt, report).normalized();
    r.qx[i] = next.x(), r.qy[i] = next.y(), r.qz[i] = next.z(), r.qw[i] = next.w();
  }
}

void advance_rotation(Integrator method, const RotationArrays& arrays, int begin, int end,
                      double dt, RotationReport& report) {
  constexpr int block = 256;
  std::array<int, block> rows;
  for (int first = begin; first < end; first += block) {
    const int count = std::min(block, end - first);
    std::iota(rows.begin(), rows.begin() + count, first);
    advance_rotation(method, arrays, std::span<const int>(rows.data(), count), dt, report);
  }
}

}  // namespace carom
