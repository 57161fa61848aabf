// SPDX-License-Identifier: Apache-2.0
#include "carom/step/taylor_top.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int order = 16;
using Series = std::array<double, order + 1>;

double product(const Series& f, const Series& g, int n) {
  double sum = 0;
  for (int i = 0; i <= n; ++i) sum += f[i] * g[n - i];
  return sum;
}

double value(const Series& f, double t) {
  double sum = f[order];
  for (int n = order - 1; n >= 0; --n) sum = sum * t + f[n];
  return sum;
}

struct Expansion {
  Series x, y, z, w;  // of the quaternion, powers of time

  [[nodiscard]] Quaterniond at(double t) const {
    return Quaterniond(value(w, t), value(x, t), value(y, t), value(z, t)).normalized();
  }
  [[nodiscard]] double size(int n) const {
    return std::sqrt(x[n] * x[n] + y[n] * y[n] + z[n] * z[n] + w[n] * w[n]);
  }
};

/// Coefficients of q' = q w / 2 and of Euler's equations l' = l x w, w = a l, in principal axes.
Expansion expand(const Quaterniond& q, const Vector3d& l, const Vector3d& a) {
  Expansion e;
  Series l1, l2, l3, w1, w2, w3;
  e.x[0] = q.x(), e.y[0] = q.y(), e.z[0] = q.z(), e.w[0] = q.w();
  const Vector3d start = q.conjugate() * l;
  l1[0] = start[0], l2[0] = start[1], l3[0] = start[2];
  for (int n = 0; n < order; ++n) {
    w1[n] = a[0] * l1[n], w2[n] = a[1] * l2[n], w3[n] = a[2] * l3[n];
    const double f = 1.0 / (n + 1), h = 0.5 * f;
    l1[n + 1] = f * (a[2] - a[1]) * product(l2, l3, n);
    l2[n + 1] = f * (a[0] - a[2]) * product(l3, l1, n);
    l3[n + 1] = f * (a[1] - a[0]) * product(l1, l2, n);
    e.w[n + 1] = -h * (product(e.x, w1, n) + product(e.y, w2, n) + product(e.z, w3, n));
    e.x[n + 1] = h * (product(e.w, w1, n) + product(e.y, w3, n) - product(e.z, w2, n));
    e.y[n + 1] = h * (product(e.w, w2, n) + product(e.z, w1, n) - product(e.x, w3, n));
    e.z[n + 1] = h * (product(e.w, w3, n) + product(e.x, w2, n) - product(e.y, w1, n));
  }
  return e;
}

/// How a small world turn of the body at the step's start shows at its end: e' = A (L x e), by two
/// Runge-Kutta steps. It only scales an error estimate: a few per cent will do.
Matrix3d transport(const Expansion& e, const Vector3d& l, const Vector3d& a, double h) {
  const auto slope_at = [&](double t) -> Matrix3d {
    const Matrix3d r = e.at(t).toRotationMatrix();
    Matrix3d cross;
    cross << 0, -l.z(), l.y(), l.z(), 0, -l.x(), -l.y(), l.x(), 0;
    return r * a.asDiagonal() * r.transpose() * cross;
  };
  Matrix3d m = Matrix3d::Identity();
  Matrix3d left = slope_at(0);
  for (int half = 0; half < 2; ++half) {
    const double s = 0.5 * h;
    const Matrix3d middle = slope_at((half + 0.5) * s), right = slope_at((half + 1) * s);
    const Matrix3d k1 = left * m, k2 = middle * (m + 0.5 * s * k1);
    const Matrix3d k3 = middle * (m + 0.5 * s * k2), k4 = right * (m + s * k3);
    m += s / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    left = right;
  }
  return m;
}

/// The smallest ellipsoid of its kind that holds the sum of ellipsoid `c` and a ball of radius e:
/// errors may all point the same way.
Matrix3d grown(const Matrix3d& c, double e) {
  const double old = std::sqrt(c.trace()), ball = std::sqrt(3.0) * e;
  if (!(old > 0)) return e * e * Matrix3d::Identity();
  if (!(ball > 0)) return c;
  return (1 + ball / old) * c + (1 + old / ball) * e * e * Matrix3d::Identity();
}

TaylorFlight fly(const Quaterniond& start, const Vector3d& l, const Vector3d& a, double seconds,
                 double error_rate, double longest) {
  TaylorFlight flight;
  Quaterniond q = start;
  Matrix3d truncation = Matrix3d::Zero(), rounding = Matrix3d::Zero();
  const double span = std::abs(seconds), side = seconds < 0 ? -1 : 1;
  double t = 0;
  while (t < span) {
    if (flight.steps == tolerance::taylor_steps) {
      flight.capped = true;
      break;
    }
    const Expansion e = expand(q, l, a);
    // The last two terms shrink like h^n: the step at which they reach the error allowed. An error
    // e of the quaternion turns the body by 2 e.
    double h = std::min(longest, span - t);
    for (const int n : {order - 1, order}) {
      const double c = 2 * e.size(n);
      if (c > 0) h = std::min(h, std::pow(error_rate / c, 1.0 / (n - 1)));
    }
    if (t + h == t) h = span - t;  // nothing left but rounding
    const double dropped = 2 * e.size(order) * std::pow(h, order);
    const Matrix3d m = transport(e, l, a, side * h);
    const Vector3d w = a.cwiseProduct(q.conjugate() * l);
    // Roundings of steps within one radian look alike: they add up there, and only then as chance
    // has it.
    const double turn = w.norm() * h;
    const double rounded =
        tolerance::unit_roundoff * (4 + 2 * turn) / std::sqrt(std::min(1.0, turn));
    truncation = grown(m * truncation * m.transpose(), dropped);
    rounding = m * rounding * m.transpose() + rounded * rounded / 3 * Matrix3d::Identity();
    q = e.at(side * h);
    t = span - t <= h ? span : t + h;
    ++flight.steps;
  }
  flight.orientation = q;
  flight.truncation = std::sqrt(truncation.trace());
  flight.rounding = 3 * std::sqrt(rounding.trace());
  return flight;
}

}  // namespace

TaylorFlight taylor_flight(const Quaterniond& orientation, const Vector3d& angular_momentum,
                           const Vector3d& inverse_moments, double seconds, double allowed,
                           std::int64_t least_steps) {
  const Vector3d& l = angular_momentum;
  const Vector3d& a = inverse_moments;
  const double span = std::abs(seconds);
  TaylorFlight flight;
  flight.orientation = orientation;
  const double speed = a.maxCoeff() * l.stableNorm();
  if (!(span > 0) || !(speed > 0)) return flight;
  const double longest = span / static_cast<double>(std::max<std::int64_t>(least_steps, 1));
  // Below one rounding per radian smaller steps only add rounding.
  const double least_rate = tolerance::unit_roundoff * speed / 8;
  double rate = 0.2 * allowed / (span * (1 + 0.2 * speed * span));
  for (int pass = 0; pass < tolerance::taylor_passes; ++pass) {
    rate = std::max(rate, least_rate);
    flight = fly(orientation, l, a, seconds, rate, longest);
    if (flight.capped || flight.truncation <= 0.5 * allowed || rate == least_rate) break;
    rate *= 0.2 * allowed / flight.truncation;
  }
  return flight;
}

}  // namespace carom
