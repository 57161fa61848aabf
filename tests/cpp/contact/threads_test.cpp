// SPDX-License-Identifier: Apache-2.0
// Threads change the time a step takes and nothing else.
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

#include "contact/stage.hpp"

namespace carom {
namespace {

/// Each kind of work that threads share: a heap too dear for the direct solver (lanes of boxes
/// and of balls, colours, the ground that all stand on, rolling resistance) and towers that are
/// solved directly, several at once.
Scene heap_and_towers() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  Scene scene = stage::ground();
  for (int i = 0; i < 180; ++i) {
    const Eigen::Vector3d at(0.6 * (i % 6) + 0.02 * any(random), 0.6 * (i / 6 % 6),
                             0.4 + 0.55 * (i / 36));
    BodyDefinition body = i % 3 == 0 ? stage::ball(at, 0.25) : stage::box(at, 0.5);
    body.rolling_resistance = i % 5 == 0 ? 0.01 : 0;
    body.pose.orientation =
        Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
    scene.add(body);
  }
  for (int tower = 0; tower < 6; ++tower)
    for (int i = 0; i < 5; ++i)
      scene.add(stage::box({20.0 + 3 * tower, 0, 0.25 + 0.5 * i}, 0.5, 1000 * (1 + 20 * i)));
  return scene;
}

Simulation with(int threads) {
  SimulationOptions options;
  options.threads = threads;
  return Simulation(heap_and_towers(), options);
}

// From the fall to the first heap, on one thread; then some steps of each kind, on all.
TEST(Threads, GiveTheSameBits) {
  Simulation one = with(1);
  std::vector<Simulation> others;
  for (const int threads : {2, 3, 4}) others.push_back(with(threads));
  bool bulk = false, direct = false;
  for (int round = 0; round < 3; ++round) {
    for (int k = 0; k < 20; ++k) one.step();
    const std::string start = one.save();
    for (Simulation& s : others) s.restore(start);
    for (int k = 0; k < 2; ++k) {
      one.step();
      const ContactReport& report = one.report().contact;
      bulk |= report.islands > report.direct_islands;
      direct |= report.direct_islands > 1;
      for (Simulation& s : others) {
        s.step();
        ASSERT_EQ(s.state_hash(), one.state_hash()) << round << ' ' << k;
        ASSERT_EQ(s.contacts().size(), one.contacts().size());
        for (std::size_t c = 0; c < one.contacts().size(); ++c)
          ASSERT_EQ(s.contacts()[c].impulse, one.contacts()[c].impulse);
      }
    }
  }
  EXPECT_TRUE(bulk);  // both kinds of solver were at work
  EXPECT_TRUE(direct);
}

// More threads than parts of the work, and fewer contacts than threads.
TEST(Threads, MayBeMoreThanThereIsWork) {
  SimulationOptions options;
  options.threads = 8;
  Scene scene = stage::ground();
  scene.add(stage::box({0, 0, 1}, 0.5));
  Simulation simulation(std::move(scene), options);
  simulation.advance(2);
  EXPECT_NEAR(simulation.states().position[1].z(), 0.25, 1e-3);  // m: lies on the ground
}

}  // namespace
}  // namespace carom
