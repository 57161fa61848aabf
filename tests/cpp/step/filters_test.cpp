// SPDX-License-Identifier: Apache-2.0
// Who meets whom: groups, masks and named pairs.
#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/step/simulation.hpp"

#include "step/pair_filter.hpp"

using namespace carom;

namespace {

BodyDefinition ball(std::string name, double z, std::uint32_t groups = 1,
                    std::uint32_t meets = 0xffffffff) {
  return {.name = std::move(name),
          .shape = Sphere{0.1},
          .pose = {.position = {0, 0, z}},
          .groups = groups,
          .meets = meets};
}

Scene ground() {
  Scene scene;
  scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
  scene.effects.emplace_back(UniformGravity{{0, 0, -9.81}});
  return scene;
}

double height(const Simulation& s, int row) {
  return s.states().position[row].z();
}

// The solver lets a soft contact sink by tolerance::soft_sink, 0.4 mm; 0.1 more for the settling.
constexpr double at_rest = 5e-4;
// From 0.5 m above the plane, 1 s of free fall: 0.5 - g/2 = -4.4 m. Nothing that is held is there.
constexpr double fallen = -4.0;

}  // namespace

TEST(Filters, MeetWhereEachBelongsToAGroupTheOtherMeets) {
  Scene scene = ground();                       // of group 1, meets all
  scene.add(ball("held", 0.5));                 // rests on the ground
  scene.add(ball("other_group", 0.8, 2));       // the ground meets group 2: rests on "held"
  scene.add(ball("one_sided", 1.1, 4, 2 | 4));  // does not meet group 1: falls through
  scene.bodies[2].pose.position.x() = 3;
  scene.bodies[3].pose.position.x() = 6;
  Simulation simulation(scene);
  simulation.advance(1.0);
  EXPECT_NEAR(height(simulation, 1), 0.1, at_rest);
  EXPECT_NEAR(height(simulation, 2), 0.1, at_rest);
  EXPECT_NEAR(height(simulation, 3), 1.1 - 9.81 / 2, 1e-9);  // exact fall; 60 steps of rounding
}

TEST(Filters, AGhostMeetsNothing) {
  Scene scene = ground();
  scene.add(ball("ghost", 0.5, 1, 0));
  Simulation simulation(scene);
  simulation.advance(1.0);
  EXPECT_LT(height(simulation, 1), fallen);
}

TEST(Filters, ANamedPairPassesThroughWhileBothMeetTheRest) {
  Scene scene = ground();
  const BodyId lower = scene.add(ball("lower", 0.1)), upper = scene.add(ball("upper", 0.5));
  const BodyId third = scene.add(ball("third", 0.9));
  scene.never_meet(upper, lower);
  scene.never_meet(lower, upper);  // saying it twice is once
  EXPECT_EQ(scene.never.size(), 1u);
  (void)third;
  Simulation simulation(scene);
  simulation.advance(2.0);
  EXPECT_NEAR(height(simulation, 1), 0.1, at_rest);
  EXPECT_NEAR(height(simulation, 2), 0.1, at_rest);  // in the same place
  EXPECT_GT(height(simulation, 3), 0.1 + at_rest);   // on top of, or beside, what it meets
  for (const Contact& c : simulation.contacts()) EXPECT_FALSE(c.a == 1 && c.b == 2);
}

TEST(Filters, HoldForFastBodiesToo) {
  Scene scene;
  scene.add({.name = "wall", .shape = Box{{0.02, 4, 4}}, .is_static = true});
  const BodyId bullet = scene.add({.name = "bullet",
                                   .shape = Sphere{0.05},
                                   .pose = {.position = {-1, 0, 0}},
                                   .velocity = {300, 0, 0}});
  Simulation stopped(scene);
  stopped.advance(0.1);
  EXPECT_LT(stopped.states().position[1].x(), 0);  // the sweep finds the wall
  scene.never_meet(bullet, *scene.find("wall"));
  Simulation through(scene);
  through.advance(0.1);
  EXPECT_NEAR(through.states().position[1].x(), 29, 1e-9);  // 30 m in a straight line
}

TEST(Filters, FollowTheRowsWhenABodyIsRemoved) {
  Scene scene = ground();
  const BodyId first = scene.add(ball("first", 2.0));
  const BodyId a = scene.add(ball("a", 0.1)), b = scene.add(ball("b", 0.5));
  scene.never_meet(a, b);
  Simulation simulation(scene);
  simulation.remove(first);
  simulation.advance(1.0);
  EXPECT_NEAR(height(simulation, 1), 0.1, at_rest);
  EXPECT_NEAR(height(simulation, 2), 0.1, at_rest);
  simulation.remove(b);
  EXPECT_TRUE(simulation.scene().never.empty());
  simulation.step();
}

TEST(Filters, CostNothingWhereNobodyAsks) {
  Scene plain = ground();
  plain.add(ball("a", 0.1)), plain.add(ball("b", 0.35));
  PairFilter filter;
  filter.build(plain);
  EXPECT_FALSE(filter.on());
  const std::vector<BodyPair> pairs{{0, 1}, {0, 2}, {1, 2}};
  EXPECT_EQ(filter(pairs).data(), pairs.data());  // the very same memory: not copied, not read
  EXPECT_EQ(compile(plain).to_string().find("filters"), std::string::npos);

  // A filter that keeps nobody apart changes no bit.
  Scene asked = plain;
  asked.bodies[1].groups = asked.bodies[2].groups = 3;
  Simulation without(plain), with(asked);
  without.advance(1.0), with.advance(1.0);
  EXPECT_EQ(without.state_hash(), with.state_hash());
  EXPECT_NE(compile(asked).to_string().find("filters on: groups of 2 bodies"), std::string::npos);
}

TEST(Filters, RefuseNonsense) {
  Scene scene = ground();
  const BodyId a = scene.add(ball("a", 1));
  const BodyId wall = scene.add({.name = "wall", .shape = Box{}, .is_static = true});
  EXPECT_THROW(scene.add(ball("none", 1, 0)), InvalidInput);
  EXPECT_THROW(scene.never_meet(a, a), InvalidInput);
  EXPECT_THROW(scene.never_meet(a, BodyId{99}), InvalidInput);
  EXPECT_THROW(scene.never_meet(wall, *scene.find("ground")), InvalidInput);
  EXPECT_TRUE(scene.never.empty());
  EXPECT_EQ(scene.bodies.size(), 3u);
}
