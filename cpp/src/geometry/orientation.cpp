// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/orientation.hpp"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "carom/numerics/double_double.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

int sign_in_double_double(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  std::array<DoubleDouble, 3> u, v, w;
  for (int k = 0; k < 3; ++k) {
    u[k] = exact_difference(a[k], p[k]);
    v[k] = exact_difference(b[k], p[k]);
    w[k] = exact_difference(c[k], p[k]);
  }
  DoubleDouble sum;
  double sizes = 0;
  for (int j = 0; j < 3; ++j) {
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    const DoubleDouble plus = u[j] * (v[k] * w[l]), minus = u[j] * (v[l] * w[k]);
    sum += plus - minus;
    sizes += std::abs(plus.hi) + std::abs(minus.hi);
  }
  const double bound = tolerance::orientation_exact * sizes;
  return sum.hi < -bound ? 1 : sum.hi > bound ? -1 : 0;
}

}  // namespace

int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& p) {
  const Eigen::Vector3d u = a - p, v = b - p, w = c - p;
  const double det = u.dot(v.cross(w));
  const Eigen::Vector3d vw(std::abs(v.y() * w.z()) + std::abs(v.z() * w.y()),
                           std::abs(v.z() * w.x()) + std::abs(v.x() * w.z()),
                           std::abs(v.x() * w.y()) + std::abs(v.y() * w.x()));
  const double bound = tolerance::orientation_filter * u.cwiseAbs().dot(vw);
  if (det < -bound) return 1;
  if (det > bound) return -1;
  return sign_in_double_double(a, b, c, p);
}

Passage passage(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& a,
                const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const int above = orientation(a, b, c, p);
  if (above == 0 || orientation(a, b, c, q) != -above) return Passage::none;
  const int x = orientation(p, q, a, b), y = orientation(p, q, b, c), z = orientation(p, q, c, a);
  const bool within = (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
  const int zeros = (x == 0) + (y == 0) + (z == 0);
  if (!within || zeros == 3) return Passage::none;
  if (zeros == 0) return Passage::inside;
  if (zeros == 2) return Passage::corner;
  return x == 0 ? Passage::ab : y == 0 ? Passage::bc : Passage::ca;
}

bool crosses_ridge(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  const int fold = orientation(a, b, c, d);
  if (fold == 0) return orientation(a, b, c, p) * orientation(a, b, c, q) < 0;
  // +1 strictly in the smaller wedge between the triangles, -1 strictly out of it, 0 on one of them
  const auto side = [&](const Eigen::Vector3d& point) {
    const int to_c = orientation(a, b, c, point) * fold, to_d = orientation(a, b, d, point) * fold;
    if (to_c > 0 && to_d < 0) return 1;
    return to_c < 0 || to_d > 0 ? -1 : 0;
  };
  return side(p) * side(q) < 0;
}

}  // namespace carom
