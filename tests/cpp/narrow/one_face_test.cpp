// SPDX-License-Identifier: Apache-2.0
// Near a single face a polytope is a half-space; the way there must give what the general one
// gives.
#include <random>

#include <gtest/gtest.h>

#include "carom/geometry/separation.hpp"
#include "carom/narrow/contacts.hpp"

#include "box_mesh.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

const Vector3d half(2, 1.5, 0.5);

std::vector<std::pair<const char*, Shape>> bodies() {
  TriangleMesh::Vertices points(6, 3);
  points << 0.2, 0, 0, -0.2, 0.05, 0, 0, 0.3, 0.1, 0.05, -0.25, 0, 0, 0, 0.2, 0.1, 0, -0.15;
  return {{"ball", Sphere{0.2}},
          {"capsule", Capsule{0.1, 0.4}},
          {"cylinder", Cylinder{0.2, 0.4}},
          {"cone", Cone{0.2, 0.4}},
          {"ellipsoid", Ellipsoid{{0.1, 0.2, 0.3}}},
          {"hull", ConvexHull(points)},
          {"box", Box{{0.3, 0.2, 0.4}}}};
}

double deepest(const std::vector<Manifold>& all) {
  double least = std::numeric_limits<double>::infinity();
  for (const Manifold& m : all)
    for (int k = 0; k < m.count; ++k) least = std::min(least, m.points[k].separation);
  return least;
}

/// Wherever it answers, separation() finds the same depth by another road: a simplex search.
TEST(OneFace, AnswersWithTheDepthOfTheSimplexSearch) {
  const Polytope floor = box_polytope(2 * half);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> in(-1, 1);
  const double margin = 0.05;
  int answered = 0, deep = 0;
  for (const auto& [name, shape] : bodies()) {
    const Convex body = *convex_of(shape);
    for (int k = 0; k < 3000; ++k) {
      const Vector3d at(2 * in(random), 1.5 * in(random), 0.5 + 0.5 * in(random));
      const Eigen::Quaterniond turn(in(random), in(random), in(random), in(random));
      const Frame frame(Pose{at, turn.normalized()});
      std::vector<Manifold> out;
      if (!one_face(floor, body, {}, frame, margin, out)) continue;
      const Separation s = separation(Convex::hull(floor), body, frame, margin);
      if (out.empty()) {
        EXPECT_TRUE(s.status == SeparationStatus::beyond || s.distance > margin) << name;
        continue;
      }
      ++answered, deep += s.distance < -0.05;
      // The search ends within 1e-9 of bodies a metre across.
      ASSERT_NEAR(deepest(out), s.distance, 2e-9) << name << " " << at.transpose();
      ASSERT_GT(s.normal.dot(out[0].normal), 1 - 1e-9) << name;
    }
  }
  EXPECT_GT(answered, 3000);
  EXPECT_GT(deep, 300);
}

/// The deep case that a half-space gets wrong: through the long side it is nearer out.
TEST(OneFace, LeavesToOthersWhatIsDeepBesideTheRim) {
  const Polytope floor = box_polytope(2 * half);
  const Convex pin = *convex_of(Shape(Cylinder{0.05, 0.9}));
  std::vector<Manifold> out;
  const Frame deep(Pose{{1.9, 0, 0.1}, Eigen::Quaterniond::Identity()});  // 0.85 m under the top
  EXPECT_FALSE(one_face(floor, pin, {}, deep, 0.01, out));
  const Frame shallow(Pose{{1.9, 0, 0.94}, Eigen::Quaterniond::Identity()});
  EXPECT_TRUE(one_face(floor, pin, {}, shallow, 0.01, out));
  EXPECT_NEAR(deepest(out), -0.01, 1e-15);
}

/// Both orders, a mesh and a box of the same corners: the same contacts, mirrored.
TEST(OneFace, IsTheSameWhicheverIsAskedFirst) {
  const Shape slab = Mesh(box_mesh(-half, half)), box = Box{2 * half};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in(-1, 1);
  for (const auto& [name, shape] : bodies())
    for (int k = 0; k < 200; ++k) {
      const Eigen::Quaterniond turn(in(random), in(random), in(random), in(random));
      const Pose pose{{in(random), in(random), 0.6 + 0.2 * in(random)}, turn.normalized()};
      const Manifold there = collide(slab, Pose{}, shape, pose, 0.05);
      const Manifold back = collide(shape, pose, slab, Pose{}, 0.05);
      const Manifold of_box = collide(box, Pose{}, shape, pose, 0.05);
      ASSERT_EQ(there.count, back.count) << name;
      ASSERT_EQ(there.count > 0, of_box.count > 0) << name;
      if (there.count == 0) continue;
      EXPECT_LT((there.normal + back.normal).norm(), 1e-9) << name;
      EXPECT_NEAR(deepest({there}), deepest({back}), 1e-9) << name;
      EXPECT_NEAR(deepest({there}), deepest({of_box}), 1e-9) << name;
    }
}

}  // namespace
}  // namespace carom
