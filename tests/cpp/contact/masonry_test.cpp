// SPDX-License-Identifier: Apache-2.0
// Structures that stand or fall by a closed form: on one side of the bound nothing moves, a little
// on the other side they come down.
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

double farthest_moved(Simulation& simulation, double seconds) {
  const Array3 start = simulation.states().position;
  for (int k = 0; k < static_cast<int>(std::lround(60 * seconds)); ++k) simulation.step(1.0 / 60);
  double most = 0;
  for (int i = 0; i < simulation.size(); ++i)
    most = std::max(most, (simulation.states().position[i] - start[i]).norm());
  return most;
}

constexpr double stands = 1e-6;  // m: ten steps at the residual of 1e-7 m/s add up to less

/// A half circle of equal voussoirs, no sliding. Heyman: it stands iff thickness / radius > 0.1075.
Scene arch(double thickness_over_radius) {
  const int n = 15;
  const double inner = 1 - thickness_over_radius / 2, outer = 1 + thickness_over_radius / 2;
  Scene scene = stage::ground(2);
  for (int k = 0; k < n; ++k) {
    const double middle = M_PI * (k + 0.5) / n;
    const Eigen::Vector3d centre(std::cos(middle), 0, std::sin(middle));
    TriangleMesh::Vertices corners(8, 3);
    for (int i = 0; i < 8; ++i) {
      const double angle = M_PI * (k + (i & 1)) / n, radius = i & 2 ? outer : inner;
      corners.row(i) = Eigen::RowVector3d(radius * std::cos(angle), i & 4 ? 0.15 : -0.15,
                                          radius * std::sin(angle)) -
                       centre.transpose();
    }
    BodyDefinition stone;
    stone.shape = ConvexHull(corners);
    stone.density = 2000;
    stone.friction = 2;
    stone.pose.position = centre;
    scene.add(stone);
  }
  return scene;
}

TEST(Arch, StandsAboveHeymansThickness) {
  Simulation thick(arch(0.12));
  EXPECT_LT(farthest_moved(thick, 10), stands);
  Simulation thin(arch(0.10));
  EXPECT_GT(farthest_moved(thin, 3), 0.5);  // m: half of its radius
}

/// Books of length l over the edge of a table, each by `share` of the most the ones above allow:
/// the pile reaches out by share (l/2) (1 + 1/2 + ... + 1/n).
Scene books(int n, double share) {
  const double length = 0.2, height = 0.03;
  Scene scene = stage::ground();
  BodyDefinition table = stage::box({-1, 0, 0.5}, 1);
  table.shape = Box{{2, 2, 1}};
  table.is_static = true;
  scene.add(table);
  double end = 0;
  for (int i = 0; i < n; ++i) {
    end += share * length / 2 / (n - i);
    BodyDefinition book = stage::box({end - length / 2, 0, 1 + height * (i + 0.5)}, 1, 600);
    book.shape = Box{{length, 0.15, height}};
    scene.add(book);
  }
  return scene;
}

TEST(Books, ReachOutAsFarAsTheHarmonicSum) {
  for (const int n : {1, 4, 8}) {
    Simulation inside(books(n, 0.999)), outside(books(n, 1.001));
    EXPECT_LT(farthest_moved(inside, 5), stands) << n;
    EXPECT_GT(farthest_moved(outside, 10), 0.5) << n;  // m: on the floor
  }
}

/// Two cards of length l and thickness t that lean on one another, `angle` from upright. About its
/// lower edge each one's weight acts at (l sin - t cos) / 2 and the other's push at l cos, so the
/// ground must hold mu >= tan/2 - t/(2 l). The upper edges do not slip: their friction is 2.
Scene cards(double angle, double share) {
  const double length = 0.1, thickness = 1e-3;
  const double least = std::tan(angle) / 2 - thickness / (2 * length);
  Scene scene = stage::ground(std::pow(share * least, 2) / 2);  // with 2: share * least
  for (const int side : {-1, 1}) {
    BodyDefinition card;
    card.shape = Box{{thickness, 0.06, length}};
    card.friction = 2;
    card.density = 800;
    card.pose.position = {side * 0.5 * (length * std::sin(angle) + thickness * std::cos(angle)), 0,
                          0.5 * (length * std::cos(angle) + thickness * std::sin(angle))};
    card.pose.orientation = Eigen::AngleAxisd(-side * angle, Eigen::Vector3d::UnitY());
    scene.add(card);
  }
  return scene;
}

TEST(CardHouse, StandsByTheFrictionOfItsClosedForm) {
  for (const double degrees : {15.0, 25.0}) {
    Simulation rough(cards(degrees * M_PI / 180, 1.01));
    EXPECT_LT(farthest_moved(rough, 5), stands) << degrees;
    Simulation smooth(cards(degrees * M_PI / 180, 0.99));
    EXPECT_GT(farthest_moved(smooth, 5), 0.03) << degrees;  // m: lies flat, from 0.045 up
  }
}

/// Twenty dominoes, the first given a push; `gap` between their faces.
struct Row {
  static constexpr int n = 20;
  static constexpr double height = 0.05, thickness = 0.0075;
  Simulation simulation;

  explicit Row(double gap) : simulation(scene(gap)) {}
  static Scene scene(double gap) {
    Scene scene = stage::ground(0.4);
    for (int i = 0; i < n; ++i) {
      BodyDefinition piece = stage::box({i * (gap + thickness), 0, height / 2}, 1, 600);
      piece.shape = Box{{thickness, 0.025, height}};
      piece.friction = 0.4;
      if (i == 0)
        piece.angular_velocity.y() = 6, piece.velocity.x() = 6 * height / 2;  // about its foot
      scene.add(piece);
    }
    return scene;
  }
  [[nodiscard]] bool has_fallen(int i) const {  // more than half way over
    return (simulation.states().pose(i + 1).orientation * Eigen::Vector3d::UnitZ()).z() < 0.7;
  }
};

// No closed form: they fall one after the other, without leaving the row, and lose energy only.
TEST(Dominoes, FallInOrder) {
  Row row(0.02);
  double before = stage::mechanical(row.simulation);
  int fallen = 0;
  for (int k = 0; k < 480; ++k) {
    row.simulation.step(1.0 / 240);
    const double now = stage::mechanical(row.simulation);
    ASSERT_LE(now - before, stage::energy_of_a_step(row.simulation, 1.0 / 240)) << k;
    before = now;
    while (fallen < Row::n && row.has_fallen(fallen)) ++fallen;
    for (int i = fallen + 1; i < Row::n; ++i) ASSERT_FALSE(row.has_fallen(i)) << i << " at " << k;
  }
  EXPECT_EQ(fallen, Row::n);
  for (int i = 1; i <= Row::n; ++i)  // none is pushed aside by as much as half of its width
    EXPECT_LT(std::abs(row.simulation.states().position[i].y()), 0.0125);
}

TEST(Dominoes, StopWhereTheGapIsWiderThanTheyAreHigh) {
  Row row(0.06);
  for (int k = 0; k < 480; ++k) row.simulation.step(1.0 / 240);
  EXPECT_TRUE(row.has_fallen(0));
  EXPECT_FALSE(row.has_fallen(1));
}

}  // namespace
}  // namespace carom
