// SPDX-License-Identifier: Apache-2.0
// The distinct real roots of a cubic in [0, 1], in order, as exact objects; the sign of another
// polynomial at such a root.
#pragma once
#include <utility>

#include "carom/numerics/exact_polynomial.hpp"

namespace carom {

/// A cubic (degree 3, leading coefficient > 0) cut at its extrema into monotone pieces 0, 2, 4; the
/// extrema are 1 and 3. Without extrema the whole line is piece 0.
///
/// This is the lecture's route (derivative's quadratic, extrema, brackets) with exact signs.
template <class Int>
struct CubicPieces {
  const ExactPolynomial<Int>* f = nullptr;
  ExactPolynomial<Int> slope, bend;  // f', f'' / 2
  Int d;                             // f2^2 - 3 f1 f3: extrema where > 0
  bool monotone = true;
  int at_extremum[2] = {0, 0};  // sign of f at the lower and the upper extremum
  Int double_num, double_den;   // the double root, where one of the two signs is 0

  explicit CubicPieces(const ExactPolynomial<Int>& cubic) : f(&cubic) {
    const Int &f0 = cubic.c[0], &f1 = cubic.c[1], &f2 = cubic.c[2], &f3 = cubic.c[3];
    const Int three(3);
    const Int f1f3 = three * (f1 * f3), f2f2 = f2 * f2;
    d = f2f2 - f1f3;
    monotone = d.sign() <= 0;
    slope.c[0] = f1;
    slope.c[1] = f2.shifted(1);
    slope.c[2] = three * f3;
    slope.settle(2);
    bend.c[0] = f2;
    bend.c[1] = slope.c[2];
    bend.settle(1);
    if (monotone) return;
    // 9 f3 f mod f' = -2 d t + beta; at t = (-f2 -+ sqrt d) / 3 f3 this is (x +- 2 d sqrt d) / 3 f3
    const Int beta = (three * three) * (f0 * f3) - f1 * f2;
    const Int x = (d * f2).shifted(1) + (three * f3) * beta, y = d.shifted(1);
    at_extremum[0] = sign_of_surd(x, y, d);
    at_extremum[1] = sign_of_surd(x, -y, d);
    if (at_extremum[0] * at_extremum[1] == 0) {  // a multiple root of a rational cubic is rational
      double_num = beta;
      double_den = y;
    }
  }

  /// Where a point with these signs of f' and f'' lies.
  [[nodiscard]] int piece(int slope_sign, int bend_sign) const {
    if (monotone) return 0;
    if (slope_sign < 0) return 2;
    if (slope_sign > 0) return bend_sign < 0 ? 0 : 4;
    return bend_sign < 0 ? 1 : 3;
  }

  /// sign(r - x) for the simple root r in `root_piece` and a point x of which the signs are given.
  [[nodiscard]] int root_minus_point(int root_piece, int f_sign, int slope_sign,
                                     int bend_sign) const {
    const int where = piece(slope_sign, bend_sign);
    if (where != root_piece) return root_piece > where ? 1 : -1;
    return root_piece == 2 ? f_sign : -f_sign;
  }
};

/// A real root in [0, 1], in one of three exact forms, and a verified bracket of it.
template <class Int>
struct ExactRoot {
  enum class Kind { rational, quadratic, cubic } kind = Kind::rational;
  Int num, den;                              // rational, den > 0
  QuadraticRoot<Int> surd{};                 // quadratic
  const CubicPieces<Int>* pieces = nullptr;  // cubic: the simple root in `piece`
  int piece = 0;
  double lower = 0, upper = 1;  // lower <= root <= upper
};

/// sign(root - t)
template <class Int>
[[nodiscard]] int root_minus(const ExactRoot<Int>& r, Dyadic t) {
  using Kind = typename ExactRoot<Int>::Kind;
  if (r.kind == Kind::rational) return (r.num.shifted(Dyadic::bits) - r.den * Int(t.m)).sign();
  if (r.kind == Kind::quadratic) {
    ExactPolynomial<Int> line;
    line.c[0] = Int(-t.m);
    line.c[1] = Int(1).shifted(Dyadic::bits);
    line.degree = 1;
    return sign_at(line, r.surd);
  }
  const auto& p = *r.pieces;
  if (p.monotone) return -sign_at(*p.f, t);
  const int where = p.piece(sign_at(p.slope, t), sign_at(p.bend, t));
  if (where != r.piece) return r.piece > where ? 1 : -1;
  const int value = sign_at(*p.f, t);
  return r.piece == 2 ? value : -value;
}

/// Halves [lower, upper] around the root until it is at most `width` wide. A good first guess costs
/// two comparisons; without one the loop needs log2(1 / width).
template <class Int>
void tighten(ExactRoot<Int>& r, double guess, double width) {
  // Ends are multiples of 2^-60, so that the exact comparison sees the very number returned.
  const auto round_down = [](double t) {
    return std::ldexp(static_cast<double>(Dyadic::floor_of(t).m), -Dyadic::bits);
  };
  const auto at_or_after = [&](double t) { return root_minus(r, Dyadic::floor_of(t)) >= 0; };
  guess = round_down(guess);
  const int side = root_minus(r, Dyadic::floor_of(guess));
  if (side == 0) {
    r.lower = r.upper = guess;
    return;
  }
  (side > 0 ? r.lower : r.upper) = guess;
  for (const double reach : {width * 0x1p-8, width}) {
    const double t = round_down(side > 0 ? std::min(1.0, guess + reach) : guess - reach);
    if (t > r.lower && t < r.upper) (at_or_after(t) ? r.lower : r.upper) = t;
    if (r.upper - r.lower <= width) return;
  }
  while (r.upper - r.lower > width) {
    const double middle = round_down(0.5 * (r.lower + r.upper));
    (at_or_after(middle) ? r.lower : r.upper) = middle;
  }
}

/// The sign of p, of degree <= 2, at a root.
template <class Int>
[[nodiscard]] int sign_at(const ExactPolynomial<Int>& p, const ExactRoot<Int>& r) {
  using Kind = typename ExactRoot<Int>::Kind;
  assert(p.degree <= 2);
  if (p.degree <= 0) return p.degree < 0 ? 0 : p.c[0].sign();
  // Over the bracket first: |p(t) - p(lower)| <= (|c1| + 2 |c2|) (t - lower) on [0, 1], and the
  // double evaluation is off by less than 8u (|c0| + |c1| + |c2|), conversions included.
  double c[4];
  as_doubles(p, c);
  const double value = c[0] + r.lower * (c[1] + r.lower * c[2]);
  const double slope = std::fabs(c[1]) + 2 * std::fabs(c[2]);
  if (std::fabs(value) >
      slope * (r.upper - r.lower) * (1 + 0x1p-40) + 0x1p-49 * (std::fabs(c[0]) + slope))
    return value > 0 ? 1 : -1;

  if (r.kind == Kind::rational) return sign_at_rational(p, r.num, r.den);
  if (r.kind == Kind::quadratic) return sign_at(p, r.surd);
  // The root of a cubic: where does it lie among the roots of p? Only signs of the cubic and its
  // derivatives at those (rational or quadratic) points are needed.
  const auto& pieces = *r.pieces;
  const auto compare = [&](const auto& sign_there) {
    const int bend = pieces.monotone ? 0 : sign_there(pieces.bend);
    const int slope_sign = pieces.monotone ? 0 : sign_there(pieces.slope);
    return pieces.root_minus_point(r.piece, sign_there(*pieces.f), slope_sign, bend);
  };
  if (p.degree == 1) {
    const bool up = p.c[1].sign() > 0;
    const Int num = up ? -p.c[0] : p.c[0], den = up ? p.c[1] : -p.c[1];
    const int side = compare([&](const auto& q) { return sign_at_rational(q, num, den); });
    return up ? side : -side;
  }
  const Int d = discriminant(p);
  const int lead = p.c[2].sign();
  if (d.sign() < 0) return lead;
  if (d.sign() == 0) {
    const Int num = lead > 0 ? -p.c[1] : p.c[1];
    const Int den = (lead > 0 ? p.c[2] : -p.c[2]).shifted(1);
    return compare([&](const auto& q) { return sign_at_rational(q, num, den); }) == 0 ? 0 : lead;
  }
  const QuadraticRoot<Int> low{&p, &d, -1}, high{&p, &d, 1};
  const int after_low = compare([&](const auto& q) { return sign_at(q, low); });
  if (after_low <= 0) return after_low == 0 ? 0 : lead;
  return lead * compare([&](const auto& q) { return sign_at(q, high); });
}

namespace detail {

// A guess at the root in a monotone piece, in doubles; every digit of it is verified by tighten().
inline double guess_root(const double* c, bool monotone, int piece) {
  double a = 0, b = 1;
  if (!monotone) {
    const double root = std::sqrt(std::fmax(0, c[2] * c[2] - 3 * c[1] * c[3]));
    const double q = -(c[2] + std::copysign(root, c[2]));
    double low = q / (3 * c[3]), high = q != 0 ? c[1] / q : 0;
    if (low > high) std::swap(low, high);
    if (piece > 0) a = std::clamp(piece == 2 ? low : high, 0.0, 1.0);
    if (piece < 4) b = std::clamp(piece == 0 ? low : high, 0.0, 1.0);
  }
  const double up = piece == 2 ? -1 : 1;
  double x = 0.5 * (a + b);
  for (int i = 0; i < 60 && b - a > 0x1p-50; ++i) {
    const double value = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
    const double slope = c[1] + x * (2 * c[2] + x * 3 * c[3]);
    (up * value < 0 ? a : b) = x;
    const double newton = x - value / slope;
    if (std::fabs(newton - x) < 0x1p-51) return newton;
    x = newton > a && newton < b ? newton : 0.5 * (a + b);
  }
  return x;
}

template <class Int>
[[nodiscard]] bool in_unit_interval(const ExactRoot<Int>& r) {
  return root_minus(r, Dyadic{0}) >= 0 && root_minus(r, Dyadic{std::int64_t{1} << 60}) <= 0;
}

template <class Int, class Visit>
bool visit_rational(const Int& num, const Int& den, double width, Visit& visit) {
  ExactRoot<Int> r;
  r.num = den.sign() > 0 ? num : -num;
  r.den = den.sign() > 0 ? den : -den;
  if (r.num.sign() < 0 || (r.den - r.num).sign() < 0) return false;
  int en, ed;
  const double n = r.num.leading(en), d = r.den.leading(ed);
  tighten(r, std::ldexp(n / d, std::max(en - ed, -2000)), width);
  return visit(r);
}

template <class Int, class Visit>
bool visit_quadratic(const ExactPolynomial<Int>& p, double width, Visit& visit) {
  const Int d = discriminant(p);
  if (d.sign() < 0) return false;
  if (d.sign() == 0) return visit_rational(-p.c[1], p.c[2].shifted(1), width, visit);
  double c[4];
  as_doubles(p, c);
  const double root = std::sqrt(std::fmax(0, c[1] * c[1] - 4 * c[2] * c[0]));
  const double q = -0.5 * (c[1] + std::copysign(root, c[1]));
  double low = q / c[2], high = q != 0 ? c[0] / q : 0;
  if (low > high) std::swap(low, high);
  for (const int which : {-1, 1}) {
    ExactRoot<Int> r;
    r.kind = ExactRoot<Int>::Kind::quadratic;
    r.surd = {&p, &d, which};
    if (!in_unit_interval(r)) continue;
    tighten(r, which < 0 ? low : high, width);
    if (visit(r)) return true;
  }
  return false;
}

}  // namespace detail

/// Calls visit(const ExactRoot&) for each distinct root in [0, 1], in increasing order, until it
/// returns true; returns whether it did. Roots come with a bracket at most `width` wide, of which
/// the lower end is a double <= the root. Nothing for the zero polynomial.
template <class Int, class Visit>
bool visit_roots(const ExactPolynomial<Int>& p, double width, Visit&& visit) {
  if (p.degree <= 0) return false;
  if (p.degree == 1) return detail::visit_rational(-p.c[0], p.c[1], width, visit);
  if (p.degree == 2) return detail::visit_quadratic(p, width, visit);
  ExactPolynomial<Int> f = p;
  if (f.c[3].sign() < 0)
    for (Int& c : f.c) c = -c;
  const CubicPieces<Int> pieces(f);
  double c[4];
  as_doubles(f, c);
  const auto simple = [&](int piece) {
    ExactRoot<Int> r;
    r.kind = ExactRoot<Int>::Kind::cubic;
    r.pieces = &pieces;
    r.piece = piece;
    if (!detail::in_unit_interval(r)) return false;
    tighten(r, detail::guess_root(c, pieces.monotone, piece), width);
    return static_cast<bool>(visit(r));
  };
  const auto multiple = [&] {
    return detail::visit_rational(pieces.double_num, pieces.double_den, width, visit);
  };
  if (pieces.monotone) return simple(0);
  const int low = pieces.at_extremum[0], high = pieces.at_extremum[1];
  if (low > 0 && simple(0)) return true;
  if (high == 0 || (low == 0 && multiple())) return high == 0 ? multiple() : true;
  if (low > 0 && high < 0 && simple(2)) return true;
  return high < 0 && simple(4);
}

}  // namespace carom
