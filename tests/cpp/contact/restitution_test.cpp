// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

TEST(Bounce, ElasticBallKeepsItsEnergyOverAThousandHits) {
  Scene scene = stage::ground();
  BodyDefinition ball = stage::ball({0, 0, 0.6}, 0.5);
  ball.restitution = 1;
  scene.add(ball);
  Simulation simulation(std::move(scene));
  const Energy start = simulation.energy();
  const double available = start.potential + start.kinetic;
  simulation.advance(60);
  const Energy end = simulation.energy();
  // Each hit may err by 1e-11 of its energy (tolerance::hit_residual); below 1e3 hits happen.
  EXPECT_NEAR(end.kinetic + end.potential, available, 1e-8 * available);
}

TEST(Bounce, ComesToRestByTheClosedFormTime) {
  const double e = 0.5, h = 1, dt = 1.0 / 240;
  Scene scene = stage::ground();
  BodyDefinition ball = stage::ball({0, 0, 0.5 + h}, 0.5);
  ball.restitution = e;
  scene.add(ball);
  Simulation simulation(std::move(scene), {.dt = dt});
  const double v = std::sqrt(2 * stage::g * h), t1 = v / stage::g;
  simulation.advance(t1 + 2 * e * v / (stage::g * (1 - e)) + 12 * dt);  // a step early per bounce
  EXPECT_LT(simulation.states().velocity[1].norm(), 1e-6);
  EXPECT_NEAR(simulation.states().position[1].z(), 0.5, 1e-6);
}

/// Newton's cradle: equal steel balls in a row, touching.
TEST(Cradle, OnlyTheLastBallLeaves) {
  Scene scene;
  const int n = 5;
  for (int i = 0; i < n; ++i) {
    BodyDefinition ball = stage::ball({i * 0.1 + (i == 0 ? -0.01 : 0), 0, 0}, 0.05);
    ball.restitution = 1;
    ball.friction = 0;
    if (i == 0) ball.velocity = {1, 0, 0};
    scene.add(ball);
  }
  Simulation simulation(std::move(scene));
  simulation.advance(0.1);
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(simulation.states().velocity[i].x(), i == n - 1 ? 1 : 0, 1e-9) << i;
}

// Two spheres with friction: impulse J_n = (1 + e) m* u_n; the tangent sticks where
// (2/7) u_t <= mu (1 + e) u_n, else slides with mu J_n. m* = m / 2.
TEST(ObliqueHit, ObeysTheClosedFormStickingAndSliding) {
  for (const double ut : {0.2, 5.0}) {
    const double e = 0.6, mu = 0.3, un = 2, r = 0.1;
    Scene scene;
    BodyDefinition a = stage::ball({0, 0, 0}, r), b = stage::ball({2 * r + 1e-9, 0, 0}, r);
    for (BodyDefinition* body : {&a, &b}) body->friction = mu, body->restitution = e;
    b.velocity = {-un, ut, 0};
    scene.add(a), scene.add(b);
    Simulation simulation(std::move(scene));
    simulation.step(1.0 / 600);
    const double jn = (1 + e) * un / 2;           // per mass
    const double jt = std::min(ut / 7, mu * jn);  // m* (2/7) ut
    const Eigen::Vector3d v = simulation.states().velocity[0];
    EXPECT_NEAR(v.x(), -jn, 1e-9);
    EXPECT_NEAR(v.y(), jt, 1e-8) << ut;  // the point lies half of the gap off: 1e-9 / r
    const Eigen::Vector3d total = v + simulation.states().velocity[1];
    EXPECT_NEAR(total.x(), -un, 1e-14);  // momentum to rounding
    EXPECT_NEAR(total.y(), ut, 1e-14);
  }
}

}  // namespace
}  // namespace carom
