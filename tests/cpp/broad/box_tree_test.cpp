// SPDX-License-Identifier: Apache-2.0
#include "carom/broad/box_tree.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
using Flags = std::vector<std::uint8_t>;

// The independent answer: every pair, compared by itself.
std::vector<BodyPair> all_pairs(const std::vector<Aabb>& boxes, const Flags& moves) {
  std::vector<BodyPair> out;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(boxes.size()); ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if (boxes[a].empty() || boxes[b].empty() || (moves[a] | moves[b]) == 0) continue;
      if (boxes[a].overlaps(boxes[b])) out.push_back({i, j});
    }
  return out;
}

struct World {
  std::mt19937_64 random;
  std::vector<Aabb> boxes;
  std::vector<Eigen::Vector3d> velocity;
  Flags moves;

  double uniform(double a, double b) {
    return a + (b - a) * std::uniform_real_distribution<double>()(random);
  }
  Eigen::Vector3d vector(double a, double b) {
    return {uniform(a, b), uniform(a, b), uniform(a, b)};
  }
  World(int n, double side, double speed, double still, unsigned seed) : random(seed) {
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d centre = vector(0, side), half = vector(0.2, 0.7);
      boxes.push_back({centre - half, centre + half});
      velocity.push_back(vector(-speed, speed));
      moves.push_back(uniform(0, 1) < still ? 0 : 1);
    }
  }
  void step() {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (moves[i] == 0) continue;
      boxes[i].lower += velocity[i];
      boxes[i].upper += velocity[i];
      if (uniform(0, 1) < 0.02) velocity[i] = -velocity[i];
    }
  }
};

void agrees_for(BoxTree& tree, World& world, int steps) {
  for (int s = 0; s < steps; ++s) {
    const std::span<const BodyPair> found = tree.update(world.boxes, world.moves);
    const std::vector<BodyPair> expected = all_pairs(world.boxes, world.moves);
    ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()))
        << "step " << s << ": " << found.size() << " pairs for " << expected.size();
    world.step();
  }
}

TEST(BoxTree, AgreesWithAllPairsWhileBoxesDrift) {
  for (const double speed : {0.0, 1e-3, 0.03, 0.5, 20.0}) {
    World world(300, 8, speed, 0.2, 1);
    BoxTree tree;
    agrees_for(tree, world, 40);
  }
}

TEST(BoxTree, AgreesWhenFewOfManyMove) {
  World world(400, 9, 0, 0, 2);
  for (std::size_t i = 0; i < 12; ++i) world.velocity[i * 30] = world.vector(-0.3, 0.3);
  BoxTree tree;
  agrees_for(tree, world, 60);
  EXPECT_LT(tree.counters().full_passes, 6) << "most steps must have been done one by one";
  EXPECT_GT(tree.counters().refattened, 100);
}

TEST(BoxTree, CostsNothingForASettledPile) {
  World world(300, 8, 0, 0, 3);
  BoxTree tree;
  agrees_for(tree, world, 5);
  for (int s = 0; s < 50; ++s) {
    for (Aabb& box : world.boxes) {  // solver jitter of a resting pile, m
      const Eigen::Vector3d shake = world.vector(-1e-4, 1e-4);
      box.lower += shake - 0.5 * shake;
      box.upper += shake - 0.5 * shake;
      world.velocity[0].setZero();
    }
    tree.update(world.boxes, world.moves);
  }
  ASSERT_EQ(std::vector<BodyPair>(tree.pairs().begin(), tree.pairs().end()),
            all_pairs(world.boxes, world.moves));
  EXPECT_EQ(tree.counters().full_passes, 1);
  EXPECT_EQ(tree.counters().refattened, 0);
}

TEST(BoxTree, RebuildsWhenBoxesHaveMixed) {
  World world(500, 12, 0.2, 0, 4);
  BoxTree tree;
  agrees_for(tree, world, 150);
  EXPECT_GT(tree.counters().builds, 1);
  EXPECT_LT(tree.counters().builds, 50);
}

TEST(BoxTree, HandlesSizesFromPointsToTheWholeScene) {
  World world(300, 6, 0.05, 0.3, 5);
  for (std::size_t i = 0; i < world.boxes.size(); ++i) {
    const Eigen::Vector3d c = world.boxes[i].centre();
    const double half = i % 7 == 0 ? 0.0 : std::pow(10.0, world.uniform(-12, 1.3));
    world.boxes[i] = {c.array() - half, c.array() + half};
  }
  world.boxes[17] = world.boxes[18];
  world.boxes[7] = world.boxes[14];  // two points in one place, which no margin widens
  world.velocity[7] = world.velocity[14];
  world.moves[7] = world.moves[14] = 1;
  BoxTree tree;
  agrees_for(tree, world, 30);
}

TEST(BoxTree, PairsPlanesAndHalfSpacesWithWhatTheyReach) {
  World world(120, 5, 0.1, 0.2, 6);
  world.boxes[0] = {Eigen::Vector3d::Constant(-inf), Eigen::Vector3d::Constant(inf)};
  world.boxes[50] = {Eigen::Vector3d::Constant(-inf), Eigen::Vector3d(inf, inf, 2.0)};
  world.boxes[90] = {Eigen::Vector3d(1, 1, -inf), Eigen::Vector3d(2, 2, inf)};
  world.boxes[91] = Aabb{};
  world.moves[0] = world.moves[50] = 0;
  world.moves[90] = 1;
  world.velocity[90] = Eigen::Vector3d(0.1, 0, 0);
  BoxTree tree;
  agrees_for(tree, world, 30);
}

TEST(BoxTree, KeepsDistantScenesApart) {
  // Two heaps 1e8 m apart: narrower numbers than doubles would call each heap one point.
  World world(200, 6, 0.03, 0.1, 7);
  for (std::size_t i = 0; i < world.boxes.size(); i += 2) {
    world.boxes[i].lower.array() += 1e8;
    world.boxes[i].upper.array() += 1e8;
  }
  BoxTree tree;
  agrees_for(tree, world, 20);
  EXPECT_LT(tree.counters().candidates, 4 * static_cast<std::int64_t>(tree.pairs().size()) + 40);
}

TEST(BoxTree, FollowsBoxesThatTouchShrinkVanishAndReturn) {
  World world(60, 3, 0, 0, 8);
  BoxTree tree;
  agrees_for(tree, world, 2);
  world.boxes[3] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  world.boxes[4] = {Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(2)};  // share one corner
  agrees_for(tree, world, 2);
  world.boxes[5].upper = world.boxes[5].lower;
  agrees_for(tree, world, 2);
  world.boxes[6] = Aabb{};
  agrees_for(tree, world, 2);
  world.boxes[6] = {Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(4)};
  world.boxes[7].upper = world.boxes[7].lower.array() - 1e-3;  // inside out: empty
  agrees_for(tree, world, 2);
  world.moves.assign(60, 0);
  agrees_for(tree, world, 2);
  world.boxes.resize(9), world.moves.resize(9), world.velocity.resize(9);
  world.moves.assign(9, 1);
  agrees_for(tree, world, 2);
  world.boxes.clear(), world.moves.clear(), world.velocity.clear();
  agrees_for(tree, world, 2);
}

TEST(BoxTree, HoldsAtTheEndsOfTheRangeOfDoubles) {
  World world(80, 4, 0, 0.1, 9);
  for (std::size_t i = 0; i < 80; ++i) {
    const double scale = i % 3 == 0 ? 4e307 : (i % 3 == 1 ? 1e-320 : 1.0);
    world.boxes[i].lower *= scale;
    world.boxes[i].upper *= scale;
  }
  BoxTree tree;
  agrees_for(tree, world, 3);
}

TEST(BoxTree, RefusesNaNAndStaysAsItWas) {
  World world(30, 3, 0, 0, 10);
  BoxTree tree;
  tree.update(world.boxes, world.moves);
  const std::vector<BodyPair> before(tree.pairs().begin(), tree.pairs().end());
  std::vector<Aabb> broken = world.boxes;
  broken[0].lower.array() += 9;
  broken[0].upper.array() += 9;
  broken[11].upper[1] = std::nan("");
  EXPECT_THROW(tree.update(broken, world.moves), InvalidInput);
  EXPECT_THROW(tree.update(world.boxes, Flags(29, 1)), InvalidInput);
  EXPECT_EQ(std::vector<BodyPair>(tree.pairs().begin(), tree.pairs().end()), before);
  agrees_for(tree, world, 2);
}

TEST(BoxTree, AnswersAreThoseOfATreeWithoutHistory) {
  World world(250, 7, 0.1, 0.2, 11);
  BoxTree old;
  for (int s = 0; s < 37; ++s) old.update(world.boxes, world.moves), world.step();
  BoxTree young;
  const auto a = old.update(world.boxes, world.moves), b = young.update(world.boxes, world.moves);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

TEST(BoxTree, FindsBoxesByBoxAndBySegment) {
  World world(300, 8, 0.05, 0.5, 12);
  world.boxes[0] = {Eigen::Vector3d::Constant(-inf), Eigen::Vector3d(inf, inf, 1.0)};
  world.boxes[1] = Aabb{};
  BoxTree tree;
  for (int s = 0; s < 5; ++s) tree.update(world.boxes, world.moves), world.step();
  tree.update(world.boxes, world.moves);
  std::vector<int> rows;
  for (int q = 0; q < 200; ++q) {
    const Eigen::Vector3d a = world.vector(-1, 9), b = world.vector(-1, 9);
    const Aabb box{a.cwiseMin(b), a.cwiseMax(b)};
    std::vector<int> expected;
    for (std::size_t i = 0; i < world.boxes.size(); ++i)
      if (!world.boxes[i].empty() && world.boxes[i].overlaps(box))
        expected.push_back(static_cast<int>(i));
    tree.overlaps(box, rows);
    EXPECT_EQ(rows, expected);
    // Axis-aligned and diagonal alike; in extended precision the test below is exact enough to
    // decide all but ties, which the seed does not produce.
    Eigen::Vector3d end = b;
    if (q % 4 == 0) end = a + Eigen::Vector3d(0, 0, b[2] - a[2]);
    expected.clear();
    for (std::size_t i = 0; i < world.boxes.size(); ++i) {
      long double first = 0, last = 1;
      if (world.boxes[i].empty()) continue;
      for (int k = 0; k < 3; ++k) {
        const long double d = static_cast<long double>(end[k]) - a[k];
        long double t0 = (world.boxes[i].lower[k] - static_cast<long double>(a[k])) / d;
        long double t1 = (world.boxes[i].upper[k] - static_cast<long double>(a[k])) / d;
        if (d == 0) {
          const bool in = world.boxes[i].lower[k] <= a[k] && a[k] <= world.boxes[i].upper[k];
          t0 = in ? 0 : 2, t1 = in ? 1 : -1;
        } else if (d < 0) {
          std::swap(t0, t1);
        }
        first = std::max(first, t0), last = std::min(last, t1);
      }
      if (first <= last) expected.push_back(static_cast<int>(i));
    }
    tree.crossed(a, end, rows);
    EXPECT_EQ(rows, expected);
  }
  EXPECT_THROW(tree.crossed({0, 0, inf}, {0, 0, 0}, rows), InvalidInput);
}

TEST(BoxTree, NamesABoxTheSegmentOnlyGrazes) {
  // The diagonal passes exactly through one corner of each unit cell on the plane x + y = k.
  std::vector<Aabb> boxes;
  for (int i = 0; i < 20; ++i)
    boxes.push_back({Eigen::Vector3d(i, 19 - i, 0), Eigen::Vector3d(i + 1, 20 - i, 0)});
  BoxTree tree;
  tree.update(boxes, Flags(boxes.size(), 1));
  std::vector<int> rows;
  tree.crossed({0, 19, 0}, {19, 0, 0}, rows);  // lower corners only
  EXPECT_EQ(rows.size(), boxes.size());
}

}  // namespace
}  // namespace carom
