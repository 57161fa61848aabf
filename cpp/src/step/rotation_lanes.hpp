// SPDX-License-Identifier: Apache-2.0
// Drives the kernels over rows, a vector of bodies at a time, with each body's own sub-steps.
// Included by one file per CPU level; D is a vector type of that level alone.
#pragma once
#include "carom/numerics/tolerance.hpp"
#include "carom/step/rotation.hpp"

#include "step/rotation_kernel.hpp"

namespace carom::kernel {

template <class D>
inline D load(const double* from) {
  D v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
template <class D>
inline D gather(const double* from, const int* rows) {
  D v;
  for (unsigned i = 0; i < sizeof(D) / sizeof(double); ++i) v[i] = from[rows[i]];
  return v;
}

/// Square of how many sub-steps the splitting wants, before rounding up.
///
/// Turns about l commute with the rest, so only the body-frame rates count. Both are conserved:
/// (k ld)^2 + k d l2^2 is (2 T - as |l|^2) k, so the spin of the top never exceeds
/// B = sqrt(|that| + |k d| |l|^2). With A = k ld^2 / 2 and C = d l2^2 / 2, what the splitting keeps
/// differs from the energy by h^2 ({A, {A, C}} / 12 + {C, {C, A}} / 24), where {A, {A, C}} is
/// k^2 d ld^2 times a difference of two squares of l and the other k d^2 l2^2 times one: their
/// swing is at most (h B)^2 |d| |l|^2 / 4. Sub-steps keep that below rotation_energy times T, and
/// h B below top_spin_per_substep, where the rest would be kicked at the top's own rhythm. A
/// symmetric top needs none at any speed.
template <class D>
inline D substeps_wanted(const Spin<D>& b, const TopSplit<D>& t, double dt) {
  const D k = t.k1 + t.k3;  // one of them is 0
  const D ld = t.k1 != 0.0 ? along1(b) : along3(b);
  const D l2 = along2(b);
  const D square = (b.lx * b.lx + b.ly * b.ly) + b.lz * b.lz;
  const D kd = absolute(k * t.d);
  const D rate = absolute((k * ld) * (k * ld) + k * t.d * (l2 * l2)) + kd * square;
  const D turned = rate * (dt * dt);
  const auto matters = absolute(t.d) > tolerance::symmetric_moments * absolute(t.as);
  constexpr double per_spin = tolerance::top_spin_per_substep * tolerance::top_spin_per_substep;
  const D energy = (t.as * square + k * (ld * ld)) + t.d * (l2 * l2);  // twice, J
  const D by_rest = turned * (absolute(t.d) * square) /
                    ((energy > 0.0 ? energy : zero<D>() + 1.0) * (2 * tolerance::rotation_energy));
  const D by_spin = turned * (1.0 / per_spin);
  return matters ? (by_rest > by_spin ? by_rest : by_spin) : zero<D>();
}

/// The other methods: |h w| below rotation_per_substep.
template <class D>
inline D substeps_wanted(const Spin<D>& b, double dt) {
  const D x = b.a1 * along1(b), y = b.a2 * along2(b), z = b.a3 * along3(b);
  constexpr double per_turn = tolerance::rotation_per_substep * tolerance::rotation_per_substep;
  return ((x * x + y * y) + z * z) * (dt * dt / per_turn);
}

template <Integrator M, class D>
inline void step(Spin<D>& b, [[maybe_unused]] const TopSplit<D>& t, D h, RotationReport& report) {
  if constexpr (M == Integrator::lecture_exponential) step_exponential(b, h);
  if constexpr (M == Integrator::lecture_quaternion) step_quaternion(b, h);
  if constexpr (M == Integrator::lecture_quaternion_sqrt) {
    if (any(step_quaternion_sqrt(b, h))) ++report.clamped;
  }
  if constexpr (M == Integrator::midpoint) step_midpoint(b, h);
  if constexpr (M == Integrator::cayley) step_cayley(b, h);
  if constexpr (M == Integrator::symmetric_top) step_symmetric_top(b, t, h);
  if constexpr (M == Integrator::symmetric_top_4) step_symmetric_top_4(b, t, h);
}

template <Integrator M, class D>
inline void advance_spin(Spin<D>& b, double dt, int lanes_used, RotationReport& report) {
  constexpr bool top = M == Integrator::symmetric_top || M == Integrator::symmetric_top_4;
  TopSplit<D> t{};
  D wanted;
  if constexpr (top) {
    t = split_top(b);
    // Most groups hold bodies whose left-over is slow, or none: no need to know how slow.
    wanted = any(t.d != 0.0) ? substeps_wanted(b, t, dt) : zero<D>();
  } else {
    wanted = substeps_wanted(b, dt);
  }
  if (!any(wanted > 1.0)) [[likely]] {
    step<M>(b, t, zero<D>() + dt, report);
    if (report.most_substeps < 1) report.most_substeps = 1;
    return;
  }
  constexpr double cap = tolerance::rotation_substeps;
  D n = root(wanted);
  for (int i = 0; i < lanes_used; ++i) report.capped += n[i] > cap;
  n = n < cap ? n : zero<D>() + cap;
  const D down = (n + detail::round_magic) - detail::round_magic;
  n = down < n ? down + 1.0 : down;
  n = n < 1.0 ? zero<D>() + 1.0 : n;
  int most = 1;
  for (int i = 0; i < lanes_used; ++i) most = n[i] > most ? static_cast<int>(n[i]) : most;
  if (report.most_substeps < most) report.most_substeps = most;
  const D h = dt / n;
  for (int k = 0; k < most; ++k) {
    const Spin<D> before = b;
    step<M>(b, t, h, report);
    const auto done = n <= static_cast<double>(k);  // a slower neighbour waits, to the bit
    b.qx = done ? before.qx : b.qx, b.qy = done ? before.qy : b.qy;
    b.qz = done ? before.qz : b.qz, b.qw = done ? before.qw : b.qw;
  }
}

template <Integrator M, class D>
inline void advance_rows(const RotationArrays& r, const int* rows, int count, double dt,
                         RotationReport& report) {
  constexpr int lanes = sizeof(D) / sizeof(double);
  for (int first = 0; first < count; first += lanes) {
    int row[lanes];
    const int used = count - first < lanes ? count - first : lanes;
    for (int i = 0; i < lanes; ++i) row[i] = rows[first + (i < used ? i : used - 1)];
    Spin<D> b;
    const int at = row[0];
    if (row[lanes - 1] - at == lanes - 1) {  // ascending rows: no gaps
      b = {load<D>(r.qx + at), load<D>(r.qy + at), load<D>(r.qz + at), load<D>(r.qw + at),
           load<D>(r.lx + at), load<D>(r.ly + at), load<D>(r.lz + at), load<D>(r.a1 + at),
           load<D>(r.a2 + at), load<D>(r.a3 + at)};
      advance_spin<M>(b, dt, lanes, report);
      __builtin_memcpy(r.qx + at, &b.qx, sizeof(D));
      __builtin_memcpy(r.qy + at, &b.qy, sizeof(D));
      __builtin_memcpy(r.qz + at, &b.qz, sizeof(D));
      __builtin_memcpy(r.qw + at, &b.qw, sizeof(D));
      continue;
    }
    b = {gather<D>(r.qx, row), gather<D>(r.qy, row), gather<D>(r.qz, row), gather<D>(r.qw, row),
         gather<D>(r.lx, row), gather<D>(r.ly, row), gather<D>(r.lz, row), gather<D>(r.a1, row),
         gather<D>(r.a2, row), gather<D>(r.a3, row)};
    advance_spin<M>(b, dt, used, report);
    for (int i = 0; i < used; ++i) {
      r.qx[row[i]] = b.qx[i], r.qy[row[i]] = b.qy[i];
      r.qz[row[i]] = b.qz[i], r.qw[row[i]] = b.qw[i];
    }
  }
}

/// False for the methods that do not run in lanes.
template <class D>
inline bool advance_in_lanes(Integrator method, const RotationArrays& r, const int* rows, int count,
                             double dt, RotationReport& report) {
  switch (method) {
#define CAROM_IN_LANES(name)                                       \
  case Integrator::name:                                           \
    advance_rows<Integrator::name, D>(r, rows, count, dt, report); \
    return true;
    CAROM_IN_LANES(lecture_exponential)
    CAROM_IN_LANES(lecture_quaternion)
    CAROM_IN_LANES(lecture_quaternion_sqrt)
    CAROM_IN_LANES(midpoint)
    CAROM_IN_LANES(cayley)
    CAROM_IN_LANES(symmetric_top)
    CAROM_IN_LANES(symmetric_top_4)
#undef CAROM_IN_LANES
    default:
      return false;
  }
}

}  // namespace carom::kernel
