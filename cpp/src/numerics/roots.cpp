// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/roots.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "carom/numerics/exact_roots.hpp"
#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

using Coefficients = std::array<double, 4>;

double value(const Coefficients& c, double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

// Horner's rule in doubles is off by at most 6u sum |c_i| t^i (Higham 2002, section 5.1, 2 n u).
int sign(const Coefficients& c, double t) {
  const double v = value(c, t);
  const double size =
      std::fabs(c[0]) + t * (std::fabs(c[1]) + t * (std::fabs(c[2]) + t * std::fabs(c[3])));
  const double bound = 6 * tolerance::unit_roundoff * size;
  return (v > bound) - (v < -bound);
}

// The derivative's roots inside (0, 1), ascending; cancellation-free form of the quadratic formula.
int extrema(const Coefficients& c, double (&out)[2]) {
  const double a = 3 * c[3], half = c[2];
  const double d = half * half - a * c[1];
  if (!(d >= 0)) return 0;
  const double q = -(half + std::copysign(std::sqrt(d), half));
  double found[2] = {q / a, c[1] / q};  // an infinity or NaN is filtered with the rest
  if (found[0] > found[1]) std::swap(found[0], found[1]);
  int count = 0;
  for (const double t : found)
    if (t > 0 && t < 1 && (count == 0 || t > out[0])) out[count++] = t;
  return count;
}

// Secant (Illinois: an end kept twice has its value halved) with bisection every third time.
double bracketed_root(const Coefficients& c, double a, double b, const RootOptions& options,
                      CubicRoots& report) {
  double fa = value(c, a), fb = value(c, b);
  int kept = 0;
  for (int i = 1; b - a > options.width; ++i) {
    if (i > options.max_iterations) {
      report.status = std::max(report.status, RootStatus::cap);
      break;
    }
    ++report.iterations;
    double x = a - fa * (b - a) / (fb - fa);
    if (i % 3 == 0 || !(x > a && x < b)) x = a + 0.5 * (b - a);
    if (x == a || x == b) {
      report.status = std::max(report.status, RootStatus::stagnated);
      break;
    }
    const double f = value(c, x);
    if (f == 0) return x;
    if ((f > 0) == (fa > 0)) {
      a = x;
      fa = f;
      if (kept > 0) fb *= 0.5;
      kept = 1;
    } else {
      b = x;
      fb = f;
      if (kept < 0) fa *= 0.5;
      kept = -1;
    }
  }
  return a + 0.5 * (b - a);
}

void add(CubicRoots& r, double t) {
  r.root[static_cast<std::size_t>(r.count++)] = std::clamp(t, 0.0, 1.0);
}

CubicRoots lecture_roots(const Coefficients& c, const RootOptions& options) {
  double cut[4] = {0};
  double inner[2];
  int last = 0;
  const int found = extrema(c, inner);
  for (int i = 0; i < found; ++i) cut[++last] = inner[i];
  cut[++last] = 1;
  CubicRoots r;
  int before = sign(c, cut[0]);
  if (before == 0) add(r, 0);
  for (int i = 1; i <= last; ++i) {
    const int here = sign(c, cut[i]);
    // two zero signs in a row: a monotone piece that is 0 to rounding, one multiple root
    if (here == 0 && before != 0) add(r, cut[i]);
    if (here * before < 0) add(r, bracketed_root(c, cut[i - 1], cut[i], options, r));
    before = here;
  }
  return r;
}

CubicRoots exact_roots(const Coefficients& c, const RootOptions& options) {
  // 4 d^3 of the extrema needs 6 times the coefficients' bits (at most 2098) and a few; a Dyadic
  // comparison 180 more than them
  using Int = ExactInteger<208>;
  int lowest = 1 << 20, exponent[4];
  std::int64_t mantissa[4];
  for (int i = 0; i < 4; ++i) {
    const double m = std::frexp(c[static_cast<std::size_t>(i)], &exponent[i]);
    mantissa[i] = static_cast<std::int64_t>(std::ldexp(m, 53));
    if (mantissa[i] != 0) lowest = std::min(lowest, exponent[i]);
  }
  ExactPolynomial<Int> p;
  for (int i = 0; i < 4; ++i)
    p.c[i] = mantissa[i] == 0 ? Int(0) : Int(mantissa[i]).shifted(exponent[i] - lowest);
  p.settle(3);
  CubicRoots r;
  visit_roots(p, std::max(options.width, 2 * tolerance::unit_roundoff), [&](const auto& root) {
    add(r, 0.5 * (root.lower + root.upper));
    return false;
  });
  return r;
}

}  // namespace

CubicRoots cubic_roots(const std::array<double, 4>& c, const RootOptions& options) {
  for (const double x : c) require_finite(x, "coefficients");
  require_positive(options.width, "width", "");
  if (options.max_iterations < 1)
    throw InvalidInput("max_iterations", with_unit(options.max_iterations, ""), "must be >= 1");
  if (std::all_of(c.begin(), c.end(), [](double x) { return x == 0; })) {
    CubicRoots r;
    r.status = RootStatus::zero_polynomial;
    return r;
  }
  return options.method == RootMethod::exact ? exact_roots(c, options) : lecture_roots(c, options);
}

}  // namespace carom
