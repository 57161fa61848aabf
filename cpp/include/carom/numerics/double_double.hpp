// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace carom {

/// Unevaluated sum of two doubles, |lo| <= ulp(hi)/2: about 106 bits. For sums that cancel, where
/// a double would return its own rounding error. Plain operations only: no fused multiply-add is
/// needed, so every CPU gives the same bits.
///
/// Relative error per operation: add and subtract 2^-104 of the larger operand's size after exact
/// cancellation of the leading parts, multiply 2^-102. Factors beyond 1e300 overflow.
/// Source: T. J. Dekker, "A floating-point technique for extending the available precision", 1971.
struct DoubleDouble {
  double hi = 0.0;
  double lo = 0.0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : hi(value) {}  // NOLINT: a double is one, exactly
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}

  constexpr explicit operator double() const { return hi + lo; }
};

/// a + b exactly, as value and rounding error (Knuth).
[[nodiscard]] constexpr DoubleDouble exact_sum(double a, double b) {
  const double s = a + b;
  const double t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// a - b exactly.
[[nodiscard]] constexpr DoubleDouble exact_difference(double a, double b) {
  return exact_sum(a, -b);
}

/// a * b exactly, as value and rounding error (Dekker, Veltkamp).
[[nodiscard]] constexpr DoubleDouble exact_product(double a, double b) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double p = a * b;
  const double ca = splitter * a, cb = splitter * b;
  const double a1 = ca - (ca - a), b1 = cb - (cb - b);
  const double a2 = a - a1, b2 = b - b1;
  return {p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

[[nodiscard]] constexpr DoubleDouble renormalised(double hi, double lo) {
  const double s = hi + lo;
  return {s, lo - (s - hi)};
}

[[nodiscard]] constexpr DoubleDouble operator-(DoubleDouble a) {
  return {-a.hi, -a.lo};
}

[[nodiscard]] constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = exact_sum(a.hi, b.hi);
  const DoubleDouble t = exact_sum(a.lo, b.lo);
  const DoubleDouble r = renormalised(s.hi, s.lo + t.hi);
  return renormalised(r.hi, r.lo + t.lo);
}

[[nodiscard]] constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) {
  return a + (-b);
}

[[nodiscard]] constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = exact_product(a.hi, b.hi);
  return renormalised(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// One Newton correction of the double quotient: 2^-100.
[[nodiscard]] constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double q = a.hi / b.hi;
  const DoubleDouble r = a - b * DoubleDouble(q);
  const double q2 = r.hi / b.hi;
  const DoubleDouble r2 = r - b * DoubleDouble(q2);
  return exact_sum(q, q2) + DoubleDouble(r2.hi / b.hi);
}

constexpr DoubleDouble& operator+=(DoubleDouble& a, DoubleDouble b) {
  return a = a + b;
}

constexpr DoubleDouble& operator-=(DoubleDouble& a, DoubleDouble b) {
  return a = a - b;
}

}  // namespace carom
