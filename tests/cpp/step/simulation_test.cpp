// SPDX-License-Identifier: Apache-2.0
#include "carom/step/simulation.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

Scene ball_over_ground(double height) {
  Scene scene;
  scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
  scene.add({.name = "ball", .shape = Sphere{0.5}, .pose = {.position = {0, 0, height}}});
  scene.effects.emplace_back(UniformGravity{});
  return scene;
}

Simulation lone_box(const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero()) {
  Scene scene;
  scene.add({.name = "box", .shape = Box{{1, 2, 3}}, .mass = 2.0, .velocity = velocity});
  return Simulation(std::move(scene));
}

TEST(Simulation, FreeFallIsExact) {
  Scene scene;
  scene.add({.name = "ball", .shape = Sphere{1}, .velocity = {1, 2, 3}});
  scene.effects.emplace_back(UniformGravity{{0, 0, -9.81}});
  Simulation sim(std::move(scene));
  sim.advance(10);
  const Eigen::Vector3d exact = 10 * Eigen::Vector3d(1, 2, 3) - Eigen::Vector3d(0, 0, 50 * 9.81);
  // 600 steps, each a few roundings of numbers up to 500: 600 * 4 * 500 * 1.1e-16
  EXPECT_LE((sim.states().position[0] - exact).norm(), 1.4e-10);
  EXPECT_NEAR(sim.energy().balance(), 0.5 * 14 * sim.states().mass[0],
              1e-9 * sim.states().mass[0]);  // v * dv + g * dx with the errors above
}

TEST(Simulation, ABallComesToRestOnTheGround) {
  Simulation sim(ball_over_ground(2));
  sim.advance(5);
  EXPECT_NEAR(sim.states().position[1].z(), 0.5,
              1e-3);  // what users may expect: within a millimetre
  EXPECT_LE(sim.states().velocity[1].norm(), 1e-3);
  EXPECT_GT(sim.energy().dissipated, 0);
}

TEST(Simulation, AdvanceLandsExactlyOnTheEnd) {
  Simulation sim = lone_box({1, 0, 0});
  const Report report = sim.advance(0.123);
  EXPECT_EQ(sim.time(), 0.123);
  EXPECT_EQ(report.steps, 8);  // 0.123 * 60 = 7.38
  EXPECT_NEAR(sim.states().position[0].x(), 0.123, 1e-16 * 8);
  EXPECT_EQ(sim.advance(1).steps, 60);
}

TEST(Simulation, ImpulseGivesItsVelocityAtOnceAndOnce) {
  Simulation sim = lone_box();
  sim.apply_impulse(BodyId{0}, {4, 0, 0});
  sim.step();
  EXPECT_EQ(sim.states().velocity[0].x(), 2);  // 4 N s on 2 kg
  EXPECT_NEAR(sim.states().position[0].x(), 2.0 / 60, 1e-17);
  sim.step();
  EXPECT_EQ(sim.states().velocity[0].x(), 2);
  EXPECT_EQ(sim.energy().work, 4);  // m v^2 / 2
}

TEST(Simulation, ForceActsForOneStepAndAWrenchIsHeld) {
  Simulation sim = lone_box();
  sim.apply_force(BodyId{0}, {120, 0, 0});
  sim.advance(1);
  EXPECT_NEAR(sim.states().velocity[0].x(), 1, 1e-15);  // 120 / 60 / 2
  sim.hold_wrench({.body = BodyId{0}, .force = {2, 0, 0}});
  EXPECT_TRUE(sim.plan().runs(StageKind::applied_wrench));
  sim.advance(1);
  EXPECT_NEAR(sim.states().velocity[0].x(), 2, 60 * 1e-15);
  sim.hold_wrench({.body = BodyId{0}});
  EXPECT_FALSE(sim.plan().runs(StageKind::applied_wrench));
}

TEST(Simulation, AHeldWrenchEndsAtItsTime) {
  Simulation sim = lone_box();
  sim.hold_wrench({.body = BodyId{0}, .force = {2, 0, 0}, .until = 0.5});
  sim.advance(1);
  EXPECT_NEAR(sim.states().velocity[0].x(), 0.5, 1e-14);
}

TEST(Simulation, AForceOffTheCentreTurnsTheBody) {
  Simulation sim = lone_box();
  sim.apply_impulse(BodyId{0}, {1, 0, 0}, Eigen::Vector3d(0, 1, 0));
  sim.step();
  EXPECT_EQ(sim.states().angular_momentum[0], Eigen::Vector3d(0, 0, -1));
}

TEST(Simulation, RemovingABodyClosesTheRows) {
  Simulation sim(ball_over_ground(0.5));
  const BodyId box =
      sim.add({.name = "box", .shape = Box{{1, 1, 1}}, .pose = {.position = {5, 0, 0.5}}});
  sim.advance(0.5);
  sim.remove(BodyId{1});
  sim.advance(0.5);
  EXPECT_EQ(sim.size(), 2);
  EXPECT_EQ(sim.scene().row(box), 1);
  EXPECT_NEAR(sim.states().position[1].x(), 5, 1e-6);
  EXPECT_THROW(sim.remove(BodyId{1}), InvalidInput);
}

TEST(Simulation, BadRequestsChangeNothing) {
  Simulation sim = lone_box({1, 2, 3});
  const std::uint64_t before = sim.state_hash();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sim.step(-1), InvalidInput);
  EXPECT_THROW(sim.step(nan), InvalidInput);
  EXPECT_THROW((void)sim.advance(nan), InvalidInput);
  EXPECT_THROW(sim.apply_force(BodyId{0}, {nan, 0, 0}), InvalidInput);
  EXPECT_THROW(sim.apply_force(BodyId{7}, {1, 0, 0}), InvalidInput);
  EXPECT_THROW(sim.add({.name = "box", .shape = Sphere{1}}), InvalidInput);
  EXPECT_THROW(sim.set_state(BodyId{0}, {.position = {0, 0, nan}}, {}, {}), InvalidInput);
  sim.step(0);
  EXPECT_EQ(sim.state_hash(), before);
}

TEST(Simulation, RestoreGivesTheSameBits) {
  Simulation sim(ball_over_ground(1));
  sim.advance(0.6);  // in contact by now
  const std::string saved = sim.save();
  sim.advance(1);
  const std::uint64_t once = sim.state_hash();
  sim.restore(saved);
  sim.advance(1);
  EXPECT_EQ(sim.state_hash(), once);
  EXPECT_THROW(sim.restore(saved.substr(0, saved.size() - 1)), InvalidInput);
  EXPECT_THROW(lone_box().restore(saved), InvalidInput);
  EXPECT_EQ(sim.state_hash(), once);
}

TEST(Simulation, NamesASavedFormatItDoesNotRead) {
  Simulation sim = lone_box();
  const std::string saved = sim.save();
  for (const auto& [format, remedy] :
       {std::pair(3u, "an older carom saved them"), std::pair(99u, "a newer carom saved them")}) {
    std::string other = saved;
    std::memcpy(other.data(), &format, sizeof format);  // it comes first
    try {
      sim.restore(other);
      FAIL() << "format " << format << " was read";
    } catch (const InvalidInput& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("format " + std::to_string(format)), std::string::npos) << said;
      EXPECT_NE(said.find(remedy), std::string::npos) << said;
    }
  }
  EXPECT_EQ(sim.save(), saved);  // and nothing was changed
}

TEST(Simulation, AStateThatOverflowsIsFrozenAndSaid) {
  Simulation sim = lone_box();
  sim.apply_impulse(BodyId{0}, {1e200, 0, 0});
  const Report report = sim.advance(1);
  ASSERT_EQ(report.frozen, std::vector<BodyId>{BodyId{0}});
  EXPECT_FALSE(report.ok());
  EXPECT_TRUE(sim.states().position[0].isZero(0));
  EXPECT_FALSE(sim.plan().runs(StageKind::integrate));
}

}  // namespace
}  // namespace carom
