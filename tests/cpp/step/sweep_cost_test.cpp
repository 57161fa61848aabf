// SPDX-License-Identifier: Apache-2.0
// What the sweep costs, in instructions counted by callgrind: nothing where nothing is fast, less
// than the step itself where bullets fly. The test runs itself under valgrind, once to warm up and
// once for twice as many steps; the difference is that of warm steps.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "carom/step/simulation.hpp"

namespace carom {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool countable = false;  // valgrind cannot run what is sanitized
#else
constexpr bool countable = true;
#endif

constexpr int few = 50;

/// 40 boxes in stacks of four that stand, and 60 balls that roll by slowly: 100 bodies.
Scene slow(Ccd ccd) {
  Scene scene;
  scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
  for (int i = 0; i < 40; ++i)
    scene.add({.shape = Box{{0.4, 0.4, 0.4}},
               .pose = {.position = {1.0 * (i / 4), 0, 0.2 + 0.4 * (i % 4)}},
               .ccd = ccd});
  for (int i = 0; i < 60; ++i)
    scene.add({.shape = Sphere{0.2},
               .pose = {.position = {0.5 * i, 2, 0.2}},
               .velocity = {0, 0.5, 0},
               .ccd = ccd});
  scene.effects.emplace_back(UniformGravity{{0, 0, -9.81}});
  return scene;
}

/// 20 times the bullet of cpp/bench/peers: 5 cm, 300 m/s, 5 m a step; the wall of 1 cm it flies to
/// is far.
Scene bullets(Ccd ccd) {
  Scene scene;
  scene.add({.name = "wall",
             .shape = Box{{0.01, 40, 40}},
             .is_static = true,
             .pose = {.position = {1e5, 0, 0}}});
  for (int i = 0; i < 20; ++i)
    scene.add({.shape = Sphere{0.05},
               .pose = {.position = {0, 1.0 * i, 0}},
               .velocity = {300, 0, 0},
               .ccd = ccd});
  return scene;
}

/// Instructions of this program for one of the flights below, for `steps` steps.
long long counted(const std::string& flight, int steps) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  setenv("CAROM_COUNTED_STEPS", std::to_string(steps).c_str(), 1);
  const std::string command =
      "valgrind --tool=callgrind --callgrind-out-file=/dev/null '" + self +
      "' --gtest_also_run_disabled_tests --gtest_filter=SweepCost.DISABLED_" + flight + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 512> line{};
  long long found = -1;
  while (pipe && std::fgets(line.data(), line.size(), pipe)) {
    const std::string text = line.data();
    if (const auto at = text.find("Collected : "); at != std::string::npos)
      found = std::atoll(text.c_str() + at + 12);
  }
  if (pipe) pclose(pipe);
  return found;
}

double per_step(const std::string& flight) {
  const long long one = counted(flight, few), two = counted(flight, 2 * few);
  EXPECT_GT(one, 0) << "valgrind did not run: is it installed?";
  return static_cast<double>(two - one) / few;
}

void fly(const Scene& scene) {
  Simulation s(scene);
  const char* steps = std::getenv("CAROM_COUNTED_STEPS");
  for (int k = 0; k < (steps ? std::atoi(steps) : few); ++k) s.step();
}

}  // namespace

// What is counted; run by the tests below alone.
TEST(SweepCost, DISABLED_SlowFollowed) {
  fly(slow(Ccd::automatic));
}
TEST(SweepCost, DISABLED_SlowNever) {
  fly(slow(Ccd::never));
}
TEST(SweepCost, DISABLED_BulletsFollowed) {
  fly(bullets(Ccd::automatic));
}
TEST(SweepCost, DISABLED_BulletsNever) {
  fly(bullets(Ccd::never));
}

// Where nothing is fast the stage copies seven numbers a body before the step, and looks once at
// the way and the turn of each after it: 88 instructions each were counted, of 13 400.
TEST(SweepCost, IsAHandfulWhereNothingIsFast) {
  if (!countable) GTEST_SKIP() << "sanitized";
  const double on = per_step("SlowFollowed"), off = per_step("SlowNever");
  RecordProperty("instructions_on", std::to_string(on));
  RecordProperty("instructions_off", std::to_string(off));
  EXPECT_LT(on - off, 100 * 100) << on << " against " << off;
  EXPECT_LT(on, 1.01 * off);
}

TEST(SweepCost, IsLessThanTheStepItselfWhereBulletsFly) {
  if (!countable) GTEST_SKIP() << "sanitized";
  const double on = per_step("BulletsFollowed"), off = per_step("BulletsNever");
  EXPECT_LT(on, 2 * off) << on << " against " << off;
  EXPECT_GT(on, 1.01 * off);  // it was on
}

}  // namespace carom
