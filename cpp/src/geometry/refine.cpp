// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <Eigen/Dense>

#include "carom/numerics/tolerance.hpp"

#include "geometry/creases.hpp"
#include "geometry/minkowski.hpp"

namespace carom::detail {
namespace {

using Eigen::Vector3d;

/// Best direction so far, and which bodies had their support point fixed by a crease there.
struct Best {
  double gap;
  Vector3d normal;
  bool crease_a = true, crease_b = true, changed = false;

  void offer(double g, const Vector3d& n, bool a, bool b, double slack) {
    if (!(g >= gap - slack)) return;
    gap = g, normal = n, crease_a = a, crease_b = b, changed = true;
  }
};

/// Largest gap on the circle n . axis = level near n: the derivative along it falls through zero
/// once, at a smooth top and at a corner alike, so halving finds either.
bool along_circle(const Difference& difference, const Crease& c, Vector3d& n) {
  const Vector3d flat = n - n.dot(c.axis) * c.axis;
  const double across = std::sqrt(1 - c.level * c.level);
  if (!(flat.norm() > 0) || !(across > 0)) return false;
  const Vector3d e1 = flat.normalized(), e2 = c.axis.cross(e1);
  const auto at = [&](double t) {
    return Vector3d(c.level * c.axis + across * (std::cos(t) * e1 + std::sin(t) * e2));
  };
  const auto rises = [&](double t) {
    return (std::cos(t) * e2 - std::sin(t) * e1).dot(difference.support(at(t)).w) > 0;
  };
  double low = -tolerance::crease, high = tolerance::crease;
  if (!rises(low) || rises(high)) return false;
  for (int i = 0; i < 60 && high - low > tolerance::unit_roundoff; ++i) {
    const double middle = 0.5 * (low + high);
    (rises(middle) ? low : high) = middle;
  }
  n = at(0.5 * (low + high));
  return true;
}

/// Newton on the sphere. Source of the second derivative: h is homogeneous of degree one, so on the
/// tangent plane it is that of h less h itself.
void newton(const Difference& difference, Vector3d& n, double& gap) {
  const Eigen::Matrix3d& R = difference.b_in_a.rotation;
  for (int i = 0; i < tolerance::newton_iterations; ++i) {
    const Vertex s = difference.support(n);
    Eigen::Matrix<double, 3, 2> T;
    T.col(0) = n.unitOrthogonal();
    T.col(1) = n.cross(T.col(0));
    const Eigen::Vector2d slope = T.transpose() * s.w;
    const Eigen::Matrix3d bend =
        difference.a.support_derivative(n) +
        R * difference.b.support_derivative(-(R.transpose() * n)) * R.transpose();
    const Eigen::Matrix2d M = T.transpose() * bend * T + n.dot(s.w) * Eigen::Matrix2d::Identity();
    const double det = M.determinant();
    if (!(det > 0) || !(M(0, 0) > 0)) return;  // not below a top of the gap
    const Eigen::Vector2d step = M.inverse() * slope;
    if (!(step.norm() < tolerance::crease)) return;
    const Vector3d next = (n + T * step).normalized();
    const double reached = difference.gap(next);
    if (!(reached >= gap - tolerance::expand_gain * std::abs(gap))) return;
    const bool done = step.norm() <= 4 * tolerance::unit_roundoff;
    n = next;
    gap = reached;
    if (done) return;
  }
}

}  // namespace

void refine(const Difference& difference, Found& found) {
  if (difference.a.is_polyhedral() && difference.b.is_polyhedral()) return;
  const Eigen::Matrix3d& R = difference.b_in_a.rotation;
  const double size = difference.a.bounding_radius() + difference.b.bounding_radius();
  const double slack = 16 * tolerance::unit_roundoff * size;
  Best best{difference.gap(found.normal), found.normal};

  Vector3d n = found.normal;
  double gap = best.gap;
  newton(difference, n, gap);
  best.offer(gap, n, false, false, 0);

  thread_local Creases creases;
  for (int side = 0; side < 2; ++side) {
    const Convex& body = side == 0 ? difference.a : difference.b;
    const Vector3d local = side == 0 ? found.normal : Vector3d(-(R.transpose() * found.normal));
    creases_near(body, local, creases);
    const auto to_a = [&](const Vector3d& x) { return side == 0 ? x : Vector3d(-(R * x)); };
    for (const Crease& c : creases.circles) {
      n = found.normal;
      if (along_circle(difference, {to_a(c.axis), c.level}, n))
        best.offer(difference.gap(n), n, side == 0, side == 1, slack);
    }
    for (const Vector3d& normal : creases.normals) {
      n = to_a(normal);
      best.offer(difference.gap(n), n, side == 0, side == 1, slack);
    }
  }
  if (!best.changed) return;
  found.normal = best.normal;
  found.distance = best.gap;
  const Vertex s = difference.support(best.normal);
  if (!best.crease_b) {
    found.b = s.b;
    found.a = best.crease_a ? Vector3d(s.b - best.gap * best.normal) : s.a;
  } else if (!best.crease_a) {
    found.a = s.a;
    found.b = s.a + best.gap * best.normal;
  }
}

}  // namespace carom::detail
