// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/step/simulation.hpp"

namespace carom {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

struct Wrong {
  const char* field;
  SimulationOptions options;
};

class OptionsThatNoSimulationFollows : public testing::TestWithParam<Wrong> {};

TEST_P(OptionsThatNoSimulationFollows, AreRefusedByName) {
  try {
    const Simulation simulation(Scene{}, GetParam().options);
    FAIL() << GetParam().field;
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, GetParam().field);
    EXPECT_FALSE(error.rule.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, OptionsThatNoSimulationFollows,
    testing::Values(Wrong{"dt", {.dt = 0}}, Wrong{"dt", {.dt = nan}}, Wrong{"dt", {.dt = inf}},
                    Wrong{"substeps", {.contact = {.substeps = -1}}},
                    Wrong{"substeps", {.contact = {.substeps = 1001}}},
                    Wrong{"contact_tolerance", {.contact = {.tolerance = 0}}},
                    Wrong{"contact_tolerance", {.contact = {.tolerance = nan}}},
                    Wrong{"direct_budget", {.contact = {.direct_budget = -1}}},
                    Wrong{"sleep_after", {.sleep_after = -1}},
                    Wrong{"sleep_after", {.sleep_after = nan}},
                    Wrong{"sleep_speed", {.sleep_speed = nan}}, Wrong{"threads", {.threads = 0}},
                    Wrong{"threads", {.threads = -1}}, Wrong{"threads", {.threads = 100000}}));

TEST(Options, AtTheirEndsAreTaken) {
  EXPECT_NO_THROW(Simulation(Scene{}, {.contact = {.substeps = 1000}}));
  EXPECT_NO_THROW(Simulation(Scene{}, {.sleep_after = 0}));
  EXPECT_NO_THROW(Simulation(Scene{}, {.sleep_after = inf}));
}

}  // namespace
}  // namespace carom
