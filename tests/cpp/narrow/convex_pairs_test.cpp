// SPDX-License-Identifier: Apache-2.0
// Every pair of convex shapes against a plain search over directions.
#include <gtest/gtest.h>

#include "carom/narrow/contacts.hpp"

#include "narrow/shapes_for_tests.hpp"
#include "narrow/support_reference.hpp"

using namespace carom;
using namespace carom::testing;

namespace {

std::vector<Shape> convex_shapes() {
  std::mt19937_64 random(3);
  TriangleMesh::Vertices cloud(40, 3);
  for (int i = 0; i < 40; ++i) cloud.row(i) = 0.5 * random_vector(random).normalized().transpose();
  return {Sphere{0.4},        Box{{0.5, 0.7, 0.9}},
          Capsule{0.25, 0.6}, Cylinder{0.35, 0.8},
          Cone{0.4, 0.9},     Ellipsoid{{0.3, 0.4, 0.6}},
          ConvexHull(cloud),  Mesh(box_mesh({0.6, 0.6, 0.8}, 2))};
}

}  // namespace

TEST(ConvexPairs, DistanceAndDepthMatchAPlainSearch) {
  const auto shapes = convex_shapes();
  std::mt19937_64 random(17);
  for (const Shape& a : shapes)
    for (const Shape& b : shapes) {
      double worst_value = 0, worst_search = 0;
      int met = 0;
      for (int trial = 0; trial < 12; ++trial) {
        const Pose pa = random_pose(random, 0.2), pb = random_pose(random, 0.7);
        const double margin = 0.3;
        const auto m = collide(a, pa, b, pb, margin);
        const double reference = largest_gap(a, pa, b, pb, random, 600, 3);
        if (reference > margin + 1e-9) {
          EXPECT_EQ(m.count, 0) << name_of(a) << ' ' << name_of(b);
          continue;
        }
        if (m.count == 0) {
          EXPECT_GT(reference, margin - 1e-6) << name_of(a) << ' ' << name_of(b);
          continue;
        }
        ++met;
        const double ours = deepest({m});
        // It is the gap along its own normal, and no direction tried has a larger one.
        const double along = std::abs(ours - gap(a, pa, b, pb, m.normal));
        worst_value = std::max(worst_value, along);
        worst_search = std::max(worst_search, reference - ours);
        EXPECT_LE(along, 1e-9) << name_of(a) << ' ' << name_of(b) << " trial " << trial << " gap "
                               << ours << " reference " << reference;
        EXPECT_LE(reference - ours, 1e-9)
            << name_of(a) << ' ' << name_of(b) << " trial " << trial << " gap " << ours;
      }
      EXPECT_GT(met, 4);
      std::printf("%-12s %-12s %3d met  value %.1e  search %.1e\n", name_of(a).data(),
                  name_of(b).data(), met, worst_value, worst_search);
    }
}
