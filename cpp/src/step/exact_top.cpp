// SPDX-License-Identifier: Apache-2.0
#include "carom/step/exact_top.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "carom/numerics/elliptic.hpp"
#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A free body: its frame, momentum in that frame, inverse moments of that frame's axes.
struct Top {
  Quaterniond q;
  Vector3d l, a;
};

/// Names the axes anew: new axis i is sign_i times old axis p_i; a rotation.
Top relabelled(const Top& top, const std::array<int, 3>& p, const Vector3d& sign) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) m(p[i], i) = sign[i];
  Top next{top.q * Quaterniond(m), {}, {}};
  for (int i = 0; i < 3; ++i) next.l[i] = sign[i] * top.l[p[i]], next.a[i] = top.a[p[i]];
  return next;
}

Top descending(const Top& top) {
  std::array<int, 3> p = {0, 1, 2};
  std::stable_sort(p.begin(), p.end(), [&](int i, int j) { return top.a[i] > top.a[j]; });
  const bool cyclic = (p[1] - p[0] + 3) % 3 == 1;
  return relabelled(top, p, {1, 1, cyclic ? 1.0 : -1.0});
}

Quaterniond about_z(double angle) {
  return {std::cos(0.5 * angle), 0, 0, std::sin(0.5 * angle)};
}

/// Turns l onto +z: about z until it lies in the x-z plane, then about y.
Quaterniond onto_z(const Vector3d& l) {
  const double tilt = std::atan2(std::hypot(l.x(), l.y()), l.z());
  const Quaterniond y(std::cos(0.5 * tilt), 0, std::sin(0.5 * tilt), 0);
  return y * about_z(std::atan2(l.y(), -l.x()));
}

/// A top with two equal moments: precession about l and spin about the third axis.
Quaterniond symmetric(const Top& top, const Vector3d& world_l, double a_pair, int axis, double t) {
  const Vector3d spin = (top.a[axis] - a_pair) * top.l[axis] * t * Vector3d::Unit(axis);
  return rotation_exponential(a_pair * t * world_l) * top.q * rotation_exponential(spin);
}

/// Integral of dv / (1 + nu sn(v)^2) over [u0, u0 + du]. A short one by Gauss's rule: the
/// difference of two long ones would leave the rounding of both.
double integral_between(double u0, double du, double m1, double nu) {
  if (std::abs(du) > tolerance::gauss_span)
    return integral_third(u0 + du, m1, nu) - integral_third(u0, m1, nu);
  constexpr std::array<double, 5> node = {0.14887433898163122, 0.43339539412924719,
                                          0.67940956829902440, 0.86506336668898451,
                                          0.97390652851717172};
  constexpr std::array<double, 5> weight = {0.29552422471475287, 0.26926671930999636,
                                            0.21908636251598204, 0.14945134915058059,
                                            0.066671344308688138};
  const double half = 0.5 * du, middle = u0 + half;
  double sum = 0;
  for (std::size_t i = 0; i < node.size(); ++i)
    for (const double side : {-1.0, 1.0}) {
      const double sn = jacobi_any(middle + side * half * node[i], m1).sn;
      sum += weight[i] / (1 + nu * sn * sn);
    }
  return half * sum;
}

}  // namespace

ExactFlight exact_flight(const Quaterniond& orientation, const Vector3d& angular_momentum,
                         const Vector3d& inverse_moments, double seconds) {
  const Quaterniond q0 = orientation.normalized();
  const double g = angular_momentum.stableNorm();
  if (!(g > 0)) return {q0, 0};
  Top top = descending({q0, q0.conjugate() * angular_momentum, inverse_moments});
  // `top` is the body under other names; what that did to its frame is undone at the end.
  const auto original = [&](const Quaterniond& q) {
    return (q * (top.q.conjugate() * q0)).normalized();
  };
  const double fastest = top.a.cwiseAbs().maxCoeff() * g;  // rad/s, a bound
  const double rounding = 4 * tolerance::unit_roundoff * (2 + fastest * std::abs(seconds));

  const double equal = tolerance::symmetric_moments * top.a.cwiseAbs().maxCoeff();
  if (top.a[1] - top.a[2] <= equal)
    return {original(symmetric(top, angular_momentum, top.a[1], 0, seconds)), rounding};
  if (top.a[0] - top.a[1] <= equal)
    return {original(symmetric(top, angular_momentum, top.a[1], 2, seconds)), rounding};

  // How far the motion is from the separatrix: > 0 it circles axis 3, < 0 axis 1.
  double near3 = std::sqrt(top.a[1] - top.a[2]) * top.l[2];
  double near1 = std::sqrt(top.a[0] - top.a[1]) * top.l[0];
  if (std::abs(near1) > std::abs(near3)) {
    top = relabelled(top, {2, 1, 0}, {1, -1, 1});
    std::swap(near1, near3);
  }
  const Vector3d& a = top.a;
  const Vector3d& l = top.l;
  const double d12 = std::abs(a[0] - a[1]), d23 = std::abs(a[1] - a[2]);
  const double d13 = std::abs(a[0] - a[2]);
  const double apart = (std::abs(near3) - std::abs(near1)) * (std::abs(near3) + std::abs(near1));
  const double p = d13 * l[0] * l[0] + d23 * l[1] * l[1];  // |2 T - a3 g^2|
  const double r = d12 * l[1] * l[1] + d13 * l[2] * l[2];  // |a1 g^2 - 2 T|
  const double rate = std::sqrt(r * d23);
  const double amplitude1 = std::sqrt(p / d13), amplitude2 = std::sqrt(p / d23);
  const double amplitude3 = std::sqrt(r / d13);
  // About a principal axis exactly (the middle one too) it keeps turning about it.
  if (!(amplitude1 > 0) || (l[0] == 0 && l[2] == 0)) {
    const Vector3d w = top.q * (a.cwiseProduct(l));
    return {original(rotation_exponential(w * seconds) * top.q), rounding};
  }
  const double m1 = std::min(1.0, d13 * apart / (r * d23));
  const double side3 = std::copysign(1.0, l[2]);
  const double side2 = side3 * std::copysign(1.0, a[1] - a[2]);

  const double u0 = jacobi_argument(
      {side2 * l[1] / amplitude2, l[0] / amplitude1, std::abs(l[2]) / amplitude3}, m1);
  const double du = rate * seconds;
  const Jacobi f = jacobi_any(u0 + du, m1);
  const Vector3d l_end(amplitude1 * f.cn, side2 * amplitude2 * f.sn, side3 * amplitude3 * f.dn);

  // The precession about the momentum, seen from the axis that keeps its integral tame: nu <= 1.
  const bool from3 = d12 <= d23;
  const double nu = from3 ? d12 / d23 : p / r;
  const double third = g * (a[0] - a[2]) / rate * integral_between(u0, du, m1, nu);
  const double precession = from3 ? g * a[2] * seconds + third : g * a[0] * seconds - third;

  const auto axis_last = [&](const Vector3d& v) -> Vector3d {
    return from3 ? v : Vector3d(v[1], v[2], v[0]);
  };
  const Quaterniond cyclic(0.5, 0.5, 0.5, 0.5);  // e1 -> e2 -> e3 -> e1, as a frame: (e2, e3, e1)
  const Quaterniond frame = from3 ? top.q : top.q * cyclic;
  Quaterniond q =
      frame * onto_z(axis_last(l)).conjugate() * about_z(precession) * onto_z(axis_last(l_end));
  if (!from3) q = q * cyclic.conjugate();

  // A nutation that is early by phase / rate leaves the body behind at the rate of the nutation.
  const double passes = m1 > 0 ? std::abs(du) / (2 * quarter_period(m1)) + 1 : 1;
  const double lost = 8 * tolerance::unit_roundoff * g *
                      (std::sqrt(d23) * std::abs(near3) + std::sqrt(d12) * std::abs(near1));
  const double phase = std::min(0.5 * lost / std::max(apart, lost), 1.0);
  return {original(q), rounding + passes * phase * d13 * g / rate};
}

}  // namespace carom
