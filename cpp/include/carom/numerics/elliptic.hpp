// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace carom {

/// Carlson's symmetric integral of the first kind, x, y, z >= 0 and at most one of them 0.
/// Relative error a few u. Source: B. C. Carlson, Numerical computation of real or complex elliptic
/// integrals, Numerical Algorithms 10, 1995.
[[nodiscard]] double carlson_rf(double x, double y, double z);

/// Carlson's integral of the third kind for 0 <= x, y, z <= p, at most one of x, y, z equal to 0.
[[nodiscard]] double carlson_rj(double x, double y, double z, double p);

struct Jacobi {
  double sn, cn, dn;
};

/// Jacobi's elliptic functions for |u| <= K(m), given by the complementary parameter m1 = 1 - m in
/// [0, 1], so that nothing is lost as m nears 1. cn and dn keep their relative accuracy where they
/// are small. m1 = 0 gives tanh and 1/cosh. Source: R. Bulirsch, Numerical calculation of elliptic
/// integrals and elliptic functions, Numerische Mathematik 7, 1965.
[[nodiscard]] Jacobi jacobi(double u, double m1);

/// Integral of dv / (1 + nu sn(v)^2) from 0 to u at parameter m = 1 - m1, nu in [0, 1], any u.
/// m1 = 0 takes its closed form.
[[nodiscard]] double integral_third(double u, double m1, double nu);

/// sn, cn, dn for any u: whole periods taken off first.
[[nodiscard]] Jacobi jacobi_any(double u, double m1);

/// u with sn(u), cn(u), dn(u) as given, in (-2 K, 2 K]; the inverse of jacobi_any.
[[nodiscard]] double jacobi_argument(const Jacobi& at, double m1);

/// Quarter period K(m), infinite for m1 = 0.
[[nodiscard]] double quarter_period(double m1);

}  // namespace carom
