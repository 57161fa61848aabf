// SPDX-License-Identifier: Apache-2.0
// The closed form of box pairs against the search by support points, which shares nothing with it.
#include <gtest/gtest.h>

#include "carom/geometry/separation.hpp"
#include "carom/narrow/contacts.hpp"

#include "narrow/boxes.hpp"
#include "narrow/shapes_for_tests.hpp"

using namespace carom;
using namespace carom::testing;

namespace {

Separation searched(const Box& a, const Pose& pa, const Box& b, const Pose& pb, double beyond) {
  return separation(Convex::hull(scratch_polytope(a, 0)), Convex::hull(scratch_polytope(b, 1)),
                    relative(Frame(pa), Frame(pb)), beyond);
}

double least_separation(const Manifold& m) {
  double least = m.points[0].separation;
  for (int k = 1; k < m.count; ++k) least = std::min(least, m.points[k].separation);
  return least;
}

}  // namespace

TEST(BoxBox, GapAndDepthAreThoseOfASearch) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> size(0.2, 1.2);
  const double margin = 0.1;
  int apart = 0, overlapping = 0, none = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const Box a{{size(random), size(random), size(random)}},
        b{{size(random), size(random), size(random)}};
    const Pose pa = random_pose(random, 0.2), pb = random_pose(random, 0.6);
    const Separation s = searched(a, pa, b, pb, 2 * margin);
    const Manifold m = collide(Shape(a), pa, Shape(b), pb, margin);
    if (s.distance > margin + 1e-9) {
      ++none;
      EXPECT_EQ(m.count, 0) << trial;
      continue;
    }
    if (s.distance > margin - 1e-9) continue;  // either answer is right within rounding
    ASSERT_GT(m.count, 0) << trial << " gap " << s.distance;
    // A few roundings of metre-sized numbers on either side; the search ends within 1e-10.
    EXPECT_NEAR(least_separation(m), s.distance, 1e-9) << trial;
    s.distance > 0 ? ++apart : ++overlapping;
  }
  EXPECT_GT(apart, 200);
  EXPECT_GT(overlapping, 500);
  EXPECT_GT(none, 200);
}

// Nearly parallel edges have cross products of no length: the faces must decide.
TEST(BoxBox, AlmostAlignedBoxesStandOnFourCorners) {
  const Box cube{{1, 1, 1}};
  for (const double tilt : {0.0, 1e-16, 1e-12, 1e-9, 1e-7, 1e-5}) {
    const Pose above{{0.1, 0.2, 1.0},
                     Eigen::Quaterniond(1, tilt, -0.7 * tilt, 0.3 * tilt).normalized()};
    const Manifold m = collide(Shape(cube), Pose{}, Shape(cube), above, 0.02);
    EXPECT_EQ(m.count, 4) << tilt;
    // The normal is that of one of the faces, which are within 2 * 1.3 tilt of z.
    EXPECT_LT((m.normal - Eigen::Vector3d::UnitZ()).norm(), 3 * tilt + 1e-15) << tilt;
    for (int k = 0; k < m.count; ++k)
      EXPECT_LT(std::abs(m.points[k].separation), 2 * tilt + 1e-15) << tilt;
  }
}
