// SPDX-License-Identifier: Apache-2.0
// What a report says of the contacts is what the contacts themselves say.
#include <algorithm>

#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

Eigen::Vector3d slip(const BodyStates& s, const Contact& c) {
  return s.velocity_at(c.b, c.position) - s.velocity_at(c.a, c.position);
}

/// The change, m/s, that Coulomb's law asks for at this point: how far the impulse is from the one
/// that its own slip would make of it, over the mobility of the point. Written from the law, with
/// nothing of the solver's. Holds at the end of a step in which bodies did not turn.
double law_residual(const BodyStates& s, const Contact& c, double dt) {
  double mobility = 0;
  for (const int row : {c.a, c.b}) {
    const Eigen::Vector3d arm = c.position - s.position[row];
    Eigen::Matrix3d cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    mobility += s.inverse_mass[row] - (cross * s.world_inverse_inertia(row) * cross).trace() / 3;
  }
  const Eigen::Vector3d u = slip(s, c), n = c.normal;
  const double gap_speed = u.dot(n) + std::max(c.separation, 0.0) / dt;
  const Eigen::Vector3d wanted = c.impulse - (gap_speed * n + (u - u.dot(n) * n)) / mobility;
  const double normal = std::max(wanted.dot(n), 0.0);
  Eigen::Vector3d tangent = wanted - wanted.dot(n) * n;
  if (tangent.norm() > c.friction * normal) tangent *= c.friction * normal / tangent.norm();
  return mobility * (c.impulse - normal * n - tangent).norm();
}

/// Two islands: a tower that asks for the direct solver, and a crate that slides. `choice` for
/// both.
Simulation two_islands(SolverChoice choice) {
  Scene scene = stage::tower(8, [](int) { return 1000; });
  BodyDefinition crate = stage::box({5, 0, 0.25}, 0.5);
  crate.velocity = {1, 0, 0};
  scene.add(crate);
  SimulationOptions options;
  options.contact.choice = choice;
  return Simulation(std::move(scene), options);
}

TEST(ContactReport, SaysWhatTheContactsSay) {
  for (const SolverChoice choice : {SolverChoice::direct, SolverChoice::small_steps}) {
    Simulation simulation = two_islands(choice);
    simulation.advance(0.1);
    const double dt = 1.0 / 60;
    const Array3 position = simulation.states().position;
    const Report one = simulation.advance(dt);  // exactly one step: extremes are of this step
    ASSERT_EQ(one.steps, 1);
    EXPECT_EQ(one.contact.points, static_cast<std::int64_t>(simulation.contacts().size()));
    double deepest = 0, residual = 0;
    BodyStates start = simulation.states();  // arms as the solver had them
    start.position = position;
    for (const Contact& c : simulation.contacts()) {
      deepest = std::max(deepest, -c.separation);
      residual = std::max(residual, law_residual(start, c, dt));
    }
    EXPECT_DOUBLE_EQ(one.contact.deepest_overlap, deepest);
    // The direct solver's own measure is of its last round and of every point alike; ours is of the
    // velocities it left. Both are below what it promises, 1e-7 m/s, or 1e-5 where something
    // slides.
    if (choice == SolverChoice::direct) {
      EXPECT_LE(residual, std::max(3 * one.contact.residual, 1e-12));
      EXPECT_LE(one.contact.residual, 1e-5);
      EXPECT_EQ(one.contact.gave_up, 0);
    }
    EXPECT_EQ(one.contact.islands, 2);
    EXPECT_EQ(one.contact.direct_islands, choice == SolverChoice::direct ? 2 : 0);
    EXPECT_EQ(one.contact.direct_bodies, choice == SolverChoice::direct ? 9 : 0);
    if (choice == SolverChoice::small_steps) {
      EXPECT_GE(one.contact.iterations, 8);
    }
  }
}

// A residual must be able to be large: one small step where thirty are called for.
TEST(ContactReport, TellsOfAStepThatIsNotSettled) {
  SimulationOptions options;
  options.contact.choice = SolverChoice::small_steps;
  options.contact.substeps = 1;
  Scene scene = stage::tower(20, [](int) { return 1000; });
  scene.bodies.back().velocity.z() = -3;  // a hit from above
  Simulation rough(scene, options);
  rough.step();
  options.contact.choice = SolverChoice::direct;
  Simulation settled(scene, options);
  settled.step();
  EXPECT_GT(rough.report().contact.residual, 1e-2);
  EXPECT_LT(settled.report().contact.residual, 1e-4);
}

// Islands are counted apart, and each by the solver that took it.
TEST(ContactReport, CountsIslandsByTheirSolver) {
  Scene scene = stage::tower(20, [](int) { return 1000; });
  for (int i = 0; i < 5; ++i) scene.add(stage::box({3.0 + 2 * i, 0, 0.25}, 0.5));
  Simulation simulation(std::move(scene));
  simulation.advance(0.5);
  EXPECT_EQ(simulation.report().contact.islands, 6);
  EXPECT_EQ(simulation.report().contact.points, 25 * 4);
  EXPECT_EQ(simulation.report().contact.gave_up, 0);
}

}  // namespace
}  // namespace carom
