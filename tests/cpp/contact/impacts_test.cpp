// SPDX-License-Identifier: Apache-2.0
// Hits: a ball and a plane in closed form, what an isolated pair keeps, and what no hit may add.
#include <random>

#include <gtest/gtest.h>

#include "carom/numerics/tolerance.hpp"

#include "contact/stage.hpp"

namespace carom {
namespace {

struct Hit {
  double restitution, friction;
  Eigen::Vector3d velocity, spin;
};
class BallOnPlane : public testing::TestWithParam<Hit> {};

// J_n = (1 + e) m u_n. The slip u_t at the point takes m (2/7) u_t to stop; friction has mu J_n.
// Then v' = v + J/m and I w' = I w + r x J with I = (2/5) m R^2 and r = -R n.
TEST_P(BallOnPlane, LeavesByTheClosedForm) {
  const Hit& hit = GetParam();
  const double radius = 0.1;
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  Scene scene;
  BodyDefinition plane;
  plane.shape = Plane{n, 0};
  plane.is_static = true;
  plane.friction = hit.friction;
  scene.add(plane);
  const double gap = 1e-9;  // m: near enough for the point to be where the closed form has it
  BodyDefinition ball = stage::ball((radius + gap) * n, radius);
  ball.restitution = hit.restitution, ball.friction = hit.friction;
  ball.velocity = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), n) * hit.velocity;
  ball.angular_velocity = hit.spin;
  scene.add(ball);

  const Eigen::Vector3d v = ball.velocity, w = hit.spin, arm = -radius * n;
  const double jn = -(1 + hit.restitution) * v.dot(n);  // per mass
  const Eigen::Vector3d at_point = v + w.cross(arm), slip = at_point - at_point.dot(n) * n;
  const double stops = 2.0 / 7 * slip.norm();
  Eigen::Vector3d j = jn * n;
  if (slip.norm() > 0) j -= std::min(stops, hit.friction * jn) * slip.normalized();
  const Eigen::Vector3d v_after = v + j, w_after = w + arm.cross(j) / (0.4 * radius * radius);

  Simulation simulation(std::move(scene));
  simulation.step(1.0 / 600);
  // A hit that sticks is solved to 1e-11 of its speed (hit_residual), one that slips may settle for
  // direct_residual_slow once its rounds gain little, one without restitution for the tolerance of
  // resting points, 1e-7 m/s, and the gap it may still close, 1e-9 m in 1/600 s.
  const bool slips = hit.friction * jn < stops;
  const double allowed = slips                 ? 2 * tolerance::direct_residual_slow
                         : hit.restitution > 0 ? 1e-9 * v.norm()
                                               : 1e-6;
  EXPECT_LT((simulation.states().velocity[1] - v_after).norm(), allowed);
  EXPECT_LT((simulation.states().angular_velocity(1) - w_after).norm() * radius, 4 * allowed);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, BallOnPlane,
    testing::Values(Hit{0.6, 0.3, {0.1, 0, -2}, {0, 0, 0}},    // stops slipping
                    Hit{0.6, 0.3, {5, 0, -2}, {0, 0, 0}},      // slips on
                    Hit{0.6, 0.3, {3, 4, -2}, {0, 0, 0}},      // along a diagonal
                    Hit{1.0, 0.0, {3, 4, -2}, {9, 8, 7}},      // mirror
                    Hit{1.0, 0.5, {0, 0, -2}, {0, 300, 0}},    // back spin slips on
                    Hit{1.0, 0.5, {1, 0, -2}, {0, 20, 5}},     // spin about the normal stays
                    Hit{0.0, 0.4, {1, -1, -3}, {0, 0, 0}},     // no bounce
                    Hit{0.9, 2.0, {20, 0, -1}, {0, 0, -4}}));  // grazes, sticks or slips

// Speeds after each bounce are e^k times the first. A hit that falls within a step is taken at its
// start, up to g dt slower than at the ground; errors of earlier hits shrink with the ball's speed.
TEST(Bounce, FollowsTheGeometricSequence) {
  for (const double dt : {1.0 / 60, 1.0 / 600}) {
    const double e = 0.8, height = 2;
    Scene scene = stage::ground();
    BodyDefinition ball = stage::ball({0, 0, 0.1 + height}, 0.1);
    ball.restitution = e;
    scene.add(ball);
    Simulation simulation(std::move(scene), {.dt = dt});
    double expected = std::sqrt(2 * stage::g * height), before = 0;
    int bounces = 0;
    while (bounces < 6 && simulation.time() < 10) {
      simulation.step();
      const double now = simulation.states().velocity[1].z();
      if (before < 0 && now > 0) {
        expected *= e, ++bounces;
        const double at_ground = std::sqrt(
            now * now + 2 * stage::g * std::max(simulation.states().position[1].z() - 0.1, 0.0));
        EXPECT_NEAR(at_ground, expected, stage::g * dt / (1 - e)) << bounces << ' ' << dt;
      }
      before = now;
    }
    EXPECT_EQ(bounces, 6);
  }
}

/// A ball in a hollow box that floats freely: a pair that meets again and again.
TEST(IsolatedPair, KeepsItsMomentumOverTenThousandHits) {
  Scene scene;
  std::vector<CompoundPart> walls;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      Eigen::Vector3d extents = Eigen::Vector3d::Constant(1.2), centre = Eigen::Vector3d::Zero();
      extents[axis] = 0.1, centre[axis] = side * 0.55;
      walls.push_back({Box{extents}, {.position = centre}});
    }
  BodyDefinition hollow;
  hollow.shape = Compound(walls);
  hollow.density = 100;
  hollow.restitution = 1, hollow.friction = 0.3;
  scene.add(hollow);
  BodyDefinition ball = stage::ball({0.1, 0.05, -0.2}, 0.1);
  ball.restitution = 1, ball.friction = 0.3;
  ball.velocity = {7, 3, -5};
  scene.add(ball);
  Simulation simulation(std::move(scene));
  const Eigen::Vector3d momentum = simulation.momentum();
  double energy = simulation.energy().kinetic;
  const double start = energy;
  int hits = 0;
  Eigen::Vector3d before = simulation.states().velocity[1];
  for (int k = 0; k < 400000 && hits < 10000; ++k) {
    simulation.step();
    const Eigen::Vector3d now = simulation.states().velocity[1];
    hits += now != before;
    before = now;
    // Friction takes, restitution 1 keeps; a hit is solved to 1e-11 of its speed.
    ASSERT_LE(simulation.energy().kinetic, energy * (1 + 1e-10)) << k;
    energy = simulation.energy().kinetic;
  }
  EXPECT_GE(hits, 10000);
  EXPECT_GT(energy, 0.01 * start);  // it still moves, or there was nothing to keep
  EXPECT_LT((simulation.momentum() - momentum).norm(), 1e-12 * momentum.norm());
}

// Elastic, rough, irregular, many at a time: the sum of kinetic and potential energy only falls.
TEST(Restitution, NeverGainsEnergy) {
  for (const double e : {0.5, 1.0}) {
    Scene scene = stage::ground();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 40; ++i) {
      BodyDefinition body = stage::box({u(random), u(random), 1 + 0.4 * i}, 0.3);
      body.shape = Box{{0.2 + 0.1 * u(random), 0.3, 0.4 + 0.2 * u(random)}};
      body.pose.orientation = Eigen::Quaterniond(1, u(random), u(random), u(random)).normalized();
      body.angular_velocity = 3 * Eigen::Vector3d(u(random), u(random), u(random));
      body.restitution = e;
      scene.add(body);
    }
    Simulation simulation(std::move(scene));
    double before = stage::mechanical(simulation);
    for (int k = 0; k < 600; ++k) {
      simulation.step();
      const double now = stage::mechanical(simulation);
      ASSERT_LE(now - before, stage::energy_of_a_step(simulation, 1.0 / 60)) << e << " at " << k;
      before = now;
    }
  }
}

}  // namespace
}  // namespace carom
