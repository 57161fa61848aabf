// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/principal_axes.hpp"

#include <algorithm>
#include <cmath>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

/// One Jacobi rotation in the plane (p, q) that makes a(p, q) zero. The smaller of the two angles,
/// so that equal moments are not stirred. Source: Golub and Van Loan, "Matrix Computations", 8.5.2.
void annihilate(Eigen::Matrix3d& a, Eigen::Matrix3d& axes, int p, int q) {
  // Demmel and Veselic 1992: below this an entry changes no moment by more than its last bit.
  if (std::abs(a(p, q)) <= tolerance::unit_roundoff * std::sqrt(std::abs(a(p, p) * a(q, q)))) {
    a(p, q) = a(q, p) = 0;
    return;
  }
  const double theta = (a(q, q) - a(p, p)) / (2 * a(p, q));
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(1.0, theta));
  const double c = 1 / std::sqrt(1 + t * t), s = t * c;
  const int r = 3 - p - q;
  const double apq = a(p, q), apr = a(p, r), aqr = a(q, r);
  a(p, p) -= t * apq;
  a(q, q) += t * apq;
  a(p, q) = a(q, p) = 0;
  a(p, r) = a(r, p) = c * apr - s * aqr;
  a(q, r) = a(r, q) = s * apr + c * aqr;
  const Eigen::Vector3d vp = axes.col(p), vq = axes.col(q);
  axes.col(p) = c * vp - s * vq;
  axes.col(q) = s * vp + c * vq;
}

/// Exchanges two axes and turns a third, so that the frame stays right-handed.
void exchange(Eigen::Vector3d& moments, Eigen::Matrix3d& axes, int i, int j) {
  if (!(moments[i] > moments[j])) return;
  std::swap(moments[i], moments[j]);
  const Eigen::Vector3d held = axes.col(i);
  axes.col(i) = axes.col(j);
  axes.col(j) = -held;
}

}  // namespace

PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia) {
  const double scale = inertia.cwiseAbs().maxCoeff();
  if (!(scale > 0) || !std::isfinite(scale)) return {};
  int exponent = 0;
  std::frexp(scale, &exponent);  // a power of two: scaling by it loses no bit
  Eigen::Matrix3d a = (inertia * std::ldexp(1.0, -exponent)).selfadjointView<Eigen::Upper>();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  // Convergence is quadratic: 4 to 5 sweeps; the cap only bounds the loop.
  for (int sweep = 0; sweep < 16; ++sweep) {
    const double off = std::abs(a(0, 1)) + std::abs(a(0, 2)) + std::abs(a(1, 2));
    if (off == 0) break;
    annihilate(a, axes, 0, 1);
    annihilate(a, axes, 0, 2);
    annihilate(a, axes, 1, 2);
  }
  Eigen::Vector3d moments = a.diagonal();
  exchange(moments, axes, 0, 1);
  exchange(moments, axes, 1, 2);
  exchange(moments, axes, 0, 1);
  return {std::ldexp(1.0, exponent) * moments.cwiseMax(0), Eigen::Quaterniond(axes).normalized()};
}

Eigen::Vector3d inverse_moments(const Eigen::Vector3d& moments) {
  const double zero = tolerance::inertia_rank * moments.maxCoeff();
  return (moments.array() > zero).select(moments.cwiseInverse(), 0.0);
}

int inertia_rank(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d moments = principal_axes(inertia).moments;
  return static_cast<int>((moments.array() > tolerance::inertia_rank * moments.maxCoeff()).count());
}

Eigen::Matrix3d inverse_inertia(const Eigen::Matrix3d& inertia) {
  const PrincipalAxes principal = principal_axes(inertia);
  const Eigen::Matrix3d Q = principal.rotation();
  return Q * inverse_moments(principal.moments).asDiagonal() * Q.transpose();
}

Eigen::Matrix3d physical_inertia(const Eigen::Matrix3d& inertia, std::string_view field) {
  if (!inertia.allFinite())
    throw InvalidInput(field, with_unit(inertia.reshaped().transpose(), "kg m^2"),
                       "must be finite");
  const double scale = inertia.cwiseAbs().maxCoeff();
  const double skewness = (inertia - inertia.transpose()).cwiseAbs().maxCoeff();
  if (!(skewness <= tolerance::inertia_symmetry * scale))
    throw InvalidInput(field, "off symmetry by " + with_unit(skewness, "kg m^2"),
                       "must be symmetric", "give the mean of the tensor and its transpose");
  const Eigen::Matrix3d symmetric = 0.5 * (inertia + inertia.transpose());
  // The smallest moment before it is clamped at zero: trace minus the other two would cancel.
  const PrincipalAxes principal = principal_axes(symmetric);
  const Eigen::Matrix3d Q = principal.rotation();
  const Eigen::Vector3d moments = (Q.transpose() * symmetric * Q).diagonal();
  if (!(moments.minCoeff() >= -tolerance::impossible_inertia * moments.maxCoeff()))
    throw InvalidInput(field, with_unit(moments.minCoeff(), "kg m^2") + " about one axis",
                       "must have no negative moment");
  const Eigen::Vector3d& sorted = principal.moments;
  if (!(sorted[2] <= (sorted[0] + sorted[1]) * (1 + tolerance::impossible_inertia)))
    throw InvalidInput(field, "principal moments " + with_unit(sorted.transpose(), "kg m^2"),
                       "must have no moment above the sum of the other two",
                       "no distribution of mass has this tensor: check the units and the signs of "
                       "the products");
  return symmetric;
}

Eigen::Matrix3d inertia_of_second_moments(const Eigen::Matrix3d& second) {
  Eigen::Matrix3d inertia = -second;
  // Sums of the two that remain, not trace minus one: a needle's own moment keeps its digits.
  for (int i = 0; i < 3; ++i)
    inertia(i, i) = second((i + 1) % 3, (i + 1) % 3) + second((i + 2) % 3, (i + 2) % 3);
  return inertia;
}

}  // namespace carom
