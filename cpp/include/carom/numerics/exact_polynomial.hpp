// SPDX-License-Identifier: Apache-2.0
// Signs of polynomials at the real roots of other polynomials, decided in closed form: no interval
// is ever bisected until something becomes definite, so the cost has a bound.
#pragma once
#include <algorithm>
#include <cmath>

#include "carom/numerics/exact_integer.hpp"

namespace carom {

/// c[0] + c[1] t + ... with integer coefficients; degree -1 is the zero polynomial.
template <class Int>
struct ExactPolynomial {
  Int c[4];
  int degree = -1;

  /// Drops leading zeros; call once the coefficients are in place.
  void settle(int bound) {
    degree = bound;
    while (degree >= 0 && c[degree].sign() == 0) --degree;
  }
};

/// A fraction m / 2^60 of the unit interval: the only instants an exact comparison is asked about.
struct Dyadic {
  static constexpr int bits = 60;
  std::int64_t m = 0;
  static Dyadic floor_of(double t) {
    return {static_cast<std::int64_t>(std::floor(std::ldexp(std::clamp(t, 0.0, 1.0), bits)))};
  }
};

/// Coefficients as doubles, scaled by one power of two so that the largest is near 1.
template <class Int>
void as_doubles(const ExactPolynomial<Int>& p, double* out) {
  int top = -(1 << 30), exponent[4];
  double mantissa[4];
  for (int i = 0; i <= p.degree; ++i) {
    mantissa[i] = p.c[i].leading(exponent[i]);
    if (mantissa[i] != 0) top = std::max(top, exponent[i]);
  }
  for (int i = 0; i < 4; ++i) {
    const bool used = i <= p.degree && mantissa[i] != 0;
    out[i] = used ? std::ldexp(mantissa[i], std::max(exponent[i] - top, -900) - 64) : 0;
  }
}

/// The sign of p(num / den), den > 0: Horner's rule on the homogeneous form.
template <class Int>
[[nodiscard]] int sign_at_rational(const ExactPolynomial<Int>& p, const Int& num, const Int& den) {
  if (p.degree < 0) return 0;
  Int sum = p.c[p.degree], scale = den;
  for (int i = p.degree - 1; i >= 0; --i) {
    sum = sum * num + p.c[i] * scale;
    if (i > 0) scale = scale * den;
  }
  return sum.sign();
}

template <class Int>
[[nodiscard]] int sign_at(const ExactPolynomial<Int>& p, Dyadic t) {
  if (p.degree < 0) return 0;
  Int sum = p.c[p.degree];
  const Int m(t.m);
  for (int i = p.degree - 1; i >= 0; --i)
    sum = sum * m + p.c[i].shifted(Dyadic::bits * (p.degree - i));
  return sum.sign();
}

/// The sign of x + y sqrt(d), d >= 0, given x, y and d.
template <class Int>
[[nodiscard]] int sign_of_surd(const Int& x, const Int& y, const Int& d) {
  const int sx = x.sign(), sy = d.sign() == 0 ? 0 : y.sign();
  if (sy == 0 || sx == sy) return sx;
  if (sx == 0) return sy;
  // Opposite signs: the larger square wins. Leading words decide all but near ties: each carries a
  // relative error below 2^-52, the products below 2^-49.
  int ex, ey, ed;
  const double mx = x.leading(ex), my = y.leading(ey), md = d.leading(ed);
  const int shift = 2 * ex - (2 * ey + ed);
  if (shift > 200) return sx;
  if (shift < -200) return sy;
  const double left = std::ldexp((mx * mx) * 0x1p-126, shift), right = (my * my) * 0x1p-126 * md;
  constexpr double slack = 1 + 0x1p-45;
  if (left > right * slack) return sx;
  if (right > left * slack) return sy;
  const int order = (x * x - y * y * d).sign();
  return order > 0 ? sx : order < 0 ? sy : 0;
}

/// The discriminant b^2 - 4 a c of a quadratic.
template <class Int>
[[nodiscard]] Int discriminant(const ExactPolynomial<Int>& q) {
  return q.c[1] * q.c[1] - (q.c[2] * q.c[0]).shifted(2);
}

/// A real root of g (degree 2, discriminant > 0): the lower one (which = -1) or the upper (+1).
template <class Int>
struct QuadraticRoot {
  const ExactPolynomial<Int>* g;
  const Int* d;  // the discriminant
  int which;
};

/// The sign of p, of degree <= 3, at the root of a quadratic: p mod g is linear, and a linear form
/// at (-b +- sqrt d) / 2a is a surd.
template <class Int>
[[nodiscard]] int sign_at(const ExactPolynomial<Int>& p, const QuadraticRoot<Int>& r) {
  if (p.degree <= 0) return p.degree < 0 ? 0 : p.c[0].sign();
  const Int &g0 = r.g->c[0], &g1 = r.g->c[1], &g2 = r.g->c[2];
  Int alpha, beta;  // sign(alpha t + beta) = sign p(t) where g(t) = 0
  if (p.degree == 1) {
    alpha = p.c[1];
    beta = p.c[0];
  } else if (p.degree == 2) {
    alpha = p.c[1] * g2 - p.c[2] * g1;
    beta = p.c[0] * g2 - p.c[2] * g0;
    if (g2.sign() < 0) alpha = -alpha, beta = -beta;
  } else {
    alpha = p.c[3] * (g1 * g1 - g0 * g2) - (p.c[2] * g1 - p.c[1] * g2) * g2;
    beta = (p.c[3] * g1 - p.c[2] * g2) * g0 + p.c[0] * (g2 * g2);
  }
  // alpha t + beta = (2 a beta - alpha b +- alpha sqrt d) / 2a; the upper root has + when a > 0
  const Int x = (g2 * beta).shifted(1) - alpha * g1;
  const int a_sign = g2.sign();
  return a_sign * sign_of_surd(x, r.which * a_sign > 0 ? alpha : -alpha, *r.d);
}

}  // namespace carom
