// SPDX-License-Identifier: Apache-2.0
#include "contact/cone.hpp"

#include <random>

#include <gtest/gtest.h>

namespace carom::contact {
namespace {

// The projection is the one point p of the cone with (z - p) . p = 0 and (z - p) . x <= 0 for all x
// of the cone; its rays suffice.
TEST(ConeProjection, IsTheNearestPoint) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3d z(normal(random), normal(random), normal(random));
    const double mu = k % 10 == 0 ? 0.0 : std::abs(normal(random));
    const Eigen::Vector3d p = project_on_cone(z, mu).value;
    const double tolerance = 16 * 1.2e-16 * (1 + mu * mu) * z.squaredNorm();
    EXPECT_LE(p.tail<2>().norm(), mu * p.x() * (1 + 4e-16) + 1e-300);
    EXPECT_NEAR((z - p).dot(p), 0, tolerance);
    for (int i = 0; i < 16; ++i) {
      const double angle = i * M_PI / 8;
      const Eigen::Vector3d ray(1, mu * std::cos(angle), mu * std::sin(angle));
      EXPECT_LE((z - p).dot(ray), tolerance / std::max(z.norm(), 1e-3) * ray.norm() * 4);
    }
  }
}

TEST(ConeProjection, HasTheDerivativeOfCentralDifferences) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  const double h = 1e-6;  // truncation h^2 times third derivatives, rounding 1e-16 / h
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3d z(normal(random), normal(random), normal(random));
    const double mu = 0.2 + std::abs(normal(random));
    const ConeProjection p = project_on_cone(z, mu);
    Eigen::Matrix3d numeric;
    bool smooth = true;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(i);
      const ConeProjection up = project_on_cone(z + d, mu), down = project_on_cone(z - d, mu);
      smooth &= up.branch == p.branch && down.branch == p.branch;
      numeric.col(i) = (up.value - down.value) / (2 * h);
    }
    const double t = z.tail<2>().norm();
    if (!smooth || t < 0.01) continue;
    EXPECT_LT((numeric - cone_derivative(z, mu, p.branch)).norm(), 1e-9 + h * h * 10 / (t * t * t));
  }
}

TEST(ClampCoulomb, KeepsTheDirectionOfTheTangent) {
  const Eigen::Vector3d l = clamp_coulomb({2, 3, 4}, 0.5);
  EXPECT_DOUBLE_EQ(l.x(), 2);
  EXPECT_NEAR(l.y(), 0.6, 1e-15);
  EXPECT_NEAR(l.z(), 0.8, 1e-15);
  EXPECT_TRUE(clamp_coulomb({-1, 3, 4}, 0.5).isZero(0));
}

}  // namespace
}  // namespace carom::contact
