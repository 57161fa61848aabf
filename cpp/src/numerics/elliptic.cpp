// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/elliptic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

/// atan(sqrt(e)) / sqrt(e), Carlson's R_C(1, 1 + e), e >= 0.
double rc_one_plus(double e) {
  const double r = std::sqrt(e);
  return r > 0 ? std::atan(r) / r : 1;
}

double largest(double a, double b, double c, double d) {
  return std::max(std::max(std::abs(a), std::abs(b)), std::max(std::abs(c), std::abs(d)));
}

}  // namespace

double carlson_rf(double x, double y, double z) {
  double a = (x + y + z) / 3;
  double off = largest(a - x, a - y, a - z, 0);
  // The series below errs by the sixth power of off / a.
  while (off > tolerance::carlson_series * a) {
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const double lambda = rx * ry + ry * rz + rz * rx;
    x = 0.25 * (x + lambda), y = 0.25 * (y + lambda), z = 0.25 * (z + lambda);
    a = (x + y + z) / 3;
    off = largest(a - x, a - y, a - z, 0);
  }
  const double dx = (a - x) / a, dy = (a - y) / a, dz = -(dx + dy);
  const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
  return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / std::sqrt(a);
}

double carlson_rj(double x, double y, double z, double p) {
  double a = (x + y + z + 2 * p) / 5;
  double delta = (p - x) * (p - y) * (p - z);
  double off = largest(a - x, a - y, a - z, a - p);
  double scale = 1, sum = 0;  // scale: 4^-n
  while (off > tolerance::carlson_series * a) {
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z), rp = std::sqrt(p);
    const double lambda = rx * ry + ry * rz + rz * rx;
    const double d = (rp + rx) * (rp + ry) * (rp + rz);
    sum += scale / d * rc_one_plus(delta / (d * d));
    scale *= 0.25, delta /= 64;
    x = 0.25 * (x + lambda), y = 0.25 * (y + lambda), z = 0.25 * (z + lambda);
    p = 0.25 * (p + lambda);
    a = (x + y + z + 2 * p) / 5;
    off = largest(a - x, a - y, a - z, a - p);
  }
  const double dx = (a - x) / a, dy = (a - y) / a, dz = (a - z) / a;
  const double dp = -(dx + dy + dz) / 2;
  const double e2 = dx * dy + dx * dz + dy * dz - 3 * dp * dp;
  const double e3 = dx * dy * dz + 2 * e2 * dp + 4 * dp * dp * dp;
  const double e4 = (2 * dx * dy * dz + e2 * dp + 3 * dp * dp * dp) * dp;
  const double e5 = dx * dy * dz * dp * dp;
  const double series =
      1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 - 9 * e2 * e3 / 52 + 3 * e5 / 26;
  return scale * series / (a * std::sqrt(a)) + 6 * sum;
}

double quarter_period(double m1) {
  return m1 > 0 ? carlson_rf(0, m1, 1) : std::numeric_limits<double>::infinity();
}

Jacobi jacobi(double u, double m1) {
  if (!(m1 > 0)) {
    const double sech = 1 / std::cosh(u);
    return {std::tanh(u), sech, sech};
  }
  std::array<double, 16> means{}, roots{};  // halves its digits' distance each time: 8 do at 1e-300
  double a = 1, c = 1, product = m1;
  int last = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    last = static_cast<int>(i);
    means[i] = a;
    product = std::sqrt(product);
    roots[i] = product;
    c = 0.5 * (a + product);
    if (std::abs(a - product) <= tolerance::newton_last_change * a) break;
    product *= a;
    a = c;
  }
  u *= c;
  double sn = std::sin(u), cn = std::cos(u), dn = 1;
  if (sn == 0) return {sn, cn, dn};
  a = cn / sn;
  c *= a;
  for (int i = last; i >= 0; --i) {
    const double b = means[i];
    a *= c;
    c *= dn;
    dn = (roots[i] + a) / (b + a);
    a = c / b;
  }
  sn = std::copysign(1 / std::sqrt(c * c + 1), sn);
  return {sn, c * sn, dn};
}

Jacobi jacobi_any(double u, double m1) {
  if (!(m1 > 0)) return jacobi(u, m1);
  const double period = 2 * quarter_period(m1);
  const double turns = std::nearbyint(u / period);
  Jacobi f = jacobi(u - turns * period, m1);
  if (std::fmod(turns, 2) != 0) f.sn = -f.sn, f.cn = -f.cn;
  return f;
}

double jacobi_argument(const Jacobi& at, double m1) {
  if (!(m1 > 0)) return std::asinh(at.sn / at.cn);
  const double u = at.sn * carlson_rf(at.cn * at.cn, at.dn * at.dn, 1);
  return at.cn >= 0 ? u : std::copysign(2 * quarter_period(m1), at.sn) - u;
}

double integral_third(double u, double m1, double nu) {
  if (!(m1 > 0)) {
    const double r = std::sqrt(nu);
    return (u + r * std::atan(r * std::tanh(u))) / (1 + nu);
  }
  const double k = quarter_period(m1);
  const double turns = std::nearbyint(u / (2 * k));
  const Jacobi f = jacobi(u - turns * 2 * k, m1);
  const double s2 = f.sn * f.sn, c2 = f.cn * f.cn, d2 = f.dn * f.dn;
  double sum = f.sn * (carlson_rf(c2, d2, 1) - nu / 3 * s2 * carlson_rj(c2, d2, 1, 1 + nu * s2));
  if (turns != 0) sum += 2 * turns * (k - nu / 3 * carlson_rj(0, m1, 1, 1 + nu));
  return sum;
}

}  // namespace carom
