// SPDX-License-Identifier: Apache-2.0
// Against the definition: from a point of the surface, out or in along its normal, the distance is
// known; and against GJK and the expanding polytope, which share none of the closed forms.
#include "geometry/point_distance.hpp"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "carom/geometry/hull.hpp"
#include "carom/geometry/separation.hpp"
#include "carom/geometry/shape.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

std::vector<Shape> bodies(std::mt19937& random) {
  std::uniform_real_distribution<double> size(0.1, 1.0);
  std::normal_distribution<double> normal;
  const auto s = [&] { return size(random); };
  TriangleMesh::Vertices cloud(20, 3);
  for (int i = 0; i < cloud.size(); ++i) cloud.data()[i] = normal(random);
  const double r = s();
  return {Sphere{s()},
          Box{{s(), s(), s()}},
          Capsule{s(), s()},
          Cylinder{s(), s()},
          Cone{s(), s()},
          Ellipsoid{{s(), s(), s()}},
          Ellipsoid{{r, r, s()}},
          Ellipsoid{{r, r, r * (1 + 1e-9)}},
          ConvexHull(cloud)};
}

TEST(PointDistance, IsThatOfTheExpandingPolytope) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 40; ++round) {
    const std::vector<Shape> all = bodies(random);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Convex body = *convex_of(all[k]);
      for (int i = 0; i < 20; ++i) {
        const Vector3d p(0.5 * normal(random), 0.5 * normal(random), 0.5 * normal(random));
        const PointDistance got = point_distance(body, p);
        const Separation other =
            separation(Convex::point(p), body, Frame{}, std::numeric_limits<double>::infinity());
        // The polytope of a curved body stops at 1e-12 of its size and is refined from there; the
        // least of several distances that are nearly equal may be missed by as much as it stops at.
        ASSERT_NEAR(got.distance, other.distance, 1e-10) << k << ": " << p.transpose();
        // What it says holds by itself: the point lies that far along the normal, and on a plane
        // that supports the body.
        ASSERT_NEAR(got.normal.norm(), 1, 1e-14);
        ASSERT_LT((got.point + got.distance * got.normal - p).norm(), 1e-14) << k;
        const double reach =
            got.normal.dot(body.support(got.normal)) + body.radius - got.normal.dot(got.point);
        ASSERT_NEAR(reach, 0, 1e-14) << k;
      }
    }
  }
}

// Closed form: a surface point of an ellipsoid, out by any distance and in by less than the
// smallest radius of curvature, r_min^2 / r_max, has that point as its nearest.
TEST(PointDistance, OfAnEllipsoidIsThatOfItsParameters) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (const Vector3d& r : {Vector3d(0.3, 0.4, 0.6), Vector3d(1e-3, 1, 1),
                            Vector3d(1, 1, 1 + 1e-12), Vector3d(2, 0.5, 0.5), Vector3d(1, 1, 1)}) {
    const Shape shape = Ellipsoid{r};
    const Convex body = *convex_of(shape);
    const double inward = r.minCoeff() * r.minCoeff() / r.maxCoeff();
    for (int i = 0; i < 2000; ++i) {
      Vector3d u = Vector3d(normal(random), normal(random), normal(random)).normalized();
      if (i % 4 == 1) u = Vector3d(u.x(), u.y(), 0).normalized();
      if (i % 4 == 2) u = Vector3d::Unit(i / 4 % 3);
      const Vector3d x = r.cwiseProduct(u);
      const Vector3d n = u.cwiseQuotient(r).normalized();
      for (const double d : {0.0, 1e-9, 3.0, -1e-9, -0.9 * inward}) {
        const PointDistance got = point_distance(body, x + d * n);
        // Coordinates of up to 4 m are off by half a unit, 4e-16 m each; so are x, n and the sum.
        ASSERT_NEAR(got.distance, d, 8e-15 * r.maxCoeff()) << r.transpose() << ' ' << i;
        ASSERT_LT((x + d * n - got.distance * got.normal - got.point).norm(), 1e-14);
      }
    }
  }
}

TEST(PointDistance, HasADirectionInTheMiddle) {
  std::mt19937 random(7);
  for (const Shape& shape : bodies(random)) {
    const Convex body = *convex_of(shape);
    const PointDistance got = point_distance(body, Vector3d::Zero());
    EXPECT_LT(got.distance, 0);
    EXPECT_NEAR(got.normal.norm(), 1, 1e-14);
    EXPECT_LT((got.point + got.distance * got.normal).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace carom
