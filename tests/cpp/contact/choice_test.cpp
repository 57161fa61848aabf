// SPDX-License-Identifier: Apache-2.0
// Who is solved how must not depend on the order of bodies.
#include "contact/choice.hpp"

#include <random>

#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

TEST(MostEasyCost, TakesAllOfOnePriceOrNone) {
  const auto most = [](std::vector<double> costs, double budget) {
    return contact::most_easy_cost(costs, budget);
  };
  EXPECT_EQ(most({}, 1), 0);
  EXPECT_EQ(most({3, 1, 2}, 6), 3);
  EXPECT_EQ(most({3, 1, 2}, 5.5), 2);
  EXPECT_EQ(most({2, 1, 2, 2}, 6.5), 1);  // three of the second price would cost 7
  EXPECT_EQ(most({2, 2}, 3), 0);
}

/// Balls heaped up in mirror symmetry. x -> -x is exact in binary arithmetic, so what keeps to
/// equal turns for equal islands stays symmetric to the last bit, until an island reaches across.
TEST(Mirror, IsKeptToTheLastBitByIslandsApart) {
  std::mt19937 random(52);
  std::uniform_real_distribution<double> x(0.35, 1.6), y(-1, 1), z(0.1, 2);
  Scene scene = stage::ground(0.3);
  std::vector<Eigen::Vector3d> half;
  while (half.size() < 60) {
    const Eigen::Vector3d p(x(random), y(random), z(random));
    if (std::ranges::all_of(half, [&](const auto& o) { return (p - o).norm() > 0.21; }))
      half.push_back(p);
  }
  for (const Eigen::Vector3d& p : half)
    for (const double side : {1.0, -1.0}) scene.add(stage::ball({side * p.x(), p.y(), p.z()}, 0.1));
  // A wall between the halves, so that none does reach across.
  scene.add({.name = "wall", .shape = Box{{0.1, 20, 20}}, .is_static = true});
  Simulation simulation(std::move(scene));
  bool direct = false, small = false;
  for (int k = 0; k < 60; ++k) {
    simulation.step(1.0 / 60);
    const ContactReport& report = simulation.report().contact;
    direct |= report.direct_islands > 0;
    small |= report.direct_islands < report.islands;
    const BodyStates& s = simulation.states();
    for (int i = 1; i + 1 < s.size(); i += 2) {
      const Eigen::Vector3d other = s.position[i + 1].cwiseProduct(Eigen::Vector3d(-1, 1, 1));
      ASSERT_EQ(s.position[i], other) << "body " << i << ", step " << k;
    }
  }
  EXPECT_TRUE(direct && small);  // both kinds of islands were there
}

}  // namespace
}  // namespace carom
