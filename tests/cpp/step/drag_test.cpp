// SPDX-License-Identifier: Apache-2.0
// LinearDrag and TorsionSpring against their closed forms, from soft to absurdly stiff, and the
// energy ledger they keep.
#include <cmath>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"
#include "carom/step/simulation.hpp"

namespace carom {
namespace {
using Eigen::Vector3d;
constexpr double u = tolerance::unit_roundoff;

Scene ball(const Vector3d& velocity, const Vector3d& spin = Vector3d::Zero()) {
  Scene scene;
  scene.add({.shape = Sphere{0.1}, .mass = 2, .velocity = velocity, .angular_velocity = spin});
  return scene;
}

class AnyStiffness : public testing::TestWithParam<double> {};  // k dt / m, as T4 asks

TEST_P(AnyStiffness, FallThroughWindIsTheClosedForm) {
  const double dt = 1.0 / 60, c = GetParam() * 2 / dt, rate = c / 2;
  const Vector3d v0(3, -1, 2), wind(-4, 5, 0), g(0, 0, -9.81);
  Scene scene = ball(v0);
  scene.effects.emplace_back(UniformGravity{g});
  scene.effects.emplace_back(LinearDrag{.coefficient = c, .wind = wind});
  Simulation simulation(scene, {.dt = dt});
  const int steps = 30;
  for (int i = 0; i < steps; ++i) simulation.step();
  const double t = steps * dt;
  // v = v_end + (v0 - v_end) exp(-rate t); the path is its integral
  const Vector3d end = wind + g / rate;
  const Vector3d v = end + (v0 - end) * std::exp(-rate * t);
  const Vector3d x = end * t + (v0 - end) * (-std::expm1(-rate * t) / rate);
  const double scale = end.norm() + v0.norm();
  EXPECT_LE((simulation.states().velocity[0] - v).norm(), steps * 8 * u * scale);
  EXPECT_LE((simulation.states().position[0] - x).norm(), steps * 16 * u * scale * t);
  EXPECT_NEAR(simulation.energy().balance(), 0.5 * 2 * v0.squaredNorm(),
              steps * 64 * u * scale * scale * (1 + 1 / GetParam()));
  EXPECT_GE(simulation.energy().dissipated, 0);
}

TEST_P(AnyStiffness, SpinDiesByTheClosedFormAndNeverTurnsBack) {
  const double dt = 1.0 / 60, inertia = 0.4 * 2 * 0.01, c = GetParam() * inertia / dt;
  Scene scene = ball(Vector3d::Zero(), {1, 2, -3});
  scene.effects.emplace_back(LinearDrag{.angular_coefficient = c});
  Simulation simulation(scene, {.dt = dt});
  const double before = simulation.energy().balance();
  for (int i = 0; i < 30; ++i) simulation.step();
  const double rate = c / inertia, t = 30 * dt;
  const Vector3d w = Vector3d(1, 2, -3) * std::exp(-rate * t);
  EXPECT_LE((simulation.states().angular_velocity(0) - w).norm(), 30 * 16 * u * 4);
  // A sphere turns by the integral of omega, about one axis.
  const Vector3d angle = Vector3d(1, 2, -3) * (-std::expm1(-rate * t) / rate);
  EXPECT_LE(rotation_angle(simulation.states().pose(0).orientation, rotation_exponential(angle)),
            30 * 16 * u * 4);
  EXPECT_NEAR(simulation.energy().balance(), before, 30 * 16 * u * before);
}

TEST_P(AnyStiffness, SpringAboutOneAxisIsTheClosedForm) {
  // stiffness dt^2 / inertia from 1e-3 to 1e8: the explicit limit is 4.
  const double dt = 1.0 / 60, inertia = 0.4 * 2 * 0.01, k = GetParam() * inertia / (dt * dt);
  for (const double damping : {0.0, 0.1 * std::sqrt(k * inertia), 10 * std::sqrt(k * inertia)}) {
    Scene scene = ball(Vector3d::Zero(), {0, 0, 2});
    scene.bodies[0].pose.orientation = rotation_exponential(Vector3d(0, 0, 0.5));
    scene.effects.emplace_back(
        TorsionSpring{.body = scene.bodies[0].id, .stiffness = k, .damping = damping});
    Simulation simulation(scene, {.dt = dt});
    const double energy = simulation.energy().balance();
    const double natural = std::sqrt(k / inertia), beta = damping / (2 * inertia);
    double reach = 0;
    for (int i = 1; i <= 20; ++i) {
      simulation.step();
      const double t = i * dt, d = natural * natural - beta * beta;
      double theta, omega;
      if (d > 0) {
        const double w = std::sqrt(d);
        const double a = 0.5, b = (2 + beta * 0.5) / w, e = std::exp(-beta * t);
        theta = e * (a * std::cos(w * t) + b * std::sin(w * t));
        omega = -beta * theta + e * w * (b * std::cos(w * t) - a * std::sin(w * t));
        reach = std::hypot(a, b);
      } else {
        const double fast = beta + std::sqrt(-d), slow = natural * natural / fast;
        const double a = (2 + fast * 0.5) / (fast - slow), b = 0.5 - a;
        theta = a * std::exp(-slow * t) + b * std::exp(-fast * t);
        omega = -slow * a * std::exp(-slow * t) - fast * b * std::exp(-fast * t);
        reach = std::abs(a) + std::abs(b);
      }
      const Vector3d at = rotation_logarithm(simulation.states().pose(0).orientation);
      // each step rounds the phase w dt and the speed, which is natural * reach
      const double slack = i * 64 * u * (1 + natural * dt) * std::max(reach, 0.5);
      EXPECT_NEAR(at.z(), theta, slack) << k << ' ' << damping << ' ' << i;
      EXPECT_NEAR(simulation.states().angular_velocity(0).z(), omega, slack * (1 + natural));
    }
    EXPECT_NEAR(simulation.energy().balance(), energy, 1e-11 * (1 + natural * dt) * energy);
  }
}

INSTANTIATE_TEST_SUITE_P(FromSoftToAbsurd, AnyStiffness,
                         testing::Values(1e-3, 0.1, 1.0, 2.1, 10.0, 1e4, 1e8));

/// Classical fourth order on (q, w) with Euler's equations in body axes: shares nothing with what
/// it judges. At 4000 steps of 5e-4 rad it errs by less than 1e-13.
Eigen::Quaterniond runge_kutta(const Vector3d& inertia, const Vector3d& w0, double drag,
                               double seconds, int steps) {
  using State = Eigen::Matrix<double, 7, 1>;  // q x y z w, then w in body axes
  State y;
  y << 0, 0, 0, 1, w0;
  const auto slope = [&](const State& at) -> State {
    const Eigen::Quaterniond q(at[3], at[0], at[1], at[2]);
    const Vector3d w = at.tail<3>();
    State d;
    d.head<4>() = 0.5 * (q * Eigen::Quaterniond(0, w[0], w[1], w[2])).coeffs();
    d.tail<3>() = (inertia.cwiseProduct(w).cross(w) - drag * w).cwiseQuotient(inertia);
    return d;
  };
  const double h = seconds / steps;
  for (int i = 0; i < steps; ++i) {
    const State k1 = slope(y), k2 = slope(y + 0.5 * h * k1), k3 = slope(y + 0.5 * h * k2);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + slope(y + h * k3));
  }
  return Eigen::Quaterniond(y[3], y[0], y[1], y[2]).normalized();
}

TEST(Drag, ATumblingBrickLosesSpinAtSecondOrder) {
  const auto end = [](int steps) {
    Scene scene;
    scene.add({.shape = Box{{0.1, 0.4, 0.9}}, .mass = 10, .angular_velocity = {1, 2, 0.5}});
    scene.effects.emplace_back(LinearDrag{.angular_coefficient = 0.3});
    Simulation simulation(scene, {.dt = 1.0 / steps});
    for (int i = 0; i < steps; ++i) simulation.step();
    return simulation.states().pose(0).orientation;
  };
  const Eigen::Quaterniond truth = runge_kutta(
      Vector3d(10.0 / 12 * (0.16 + 0.81), 10.0 / 12 * (0.01 + 0.81), 10.0 / 12 * (0.01 + 0.16)),
      {1, 2, 0.5}, 0.3, 1, 4000);
  const double coarse = rotation_angle(end(50), truth), half = rotation_angle(end(100), truth);
  EXPECT_NEAR(std::log2(coarse / half), 2, 0.15);
}

TEST(Drag, SpeedNeverGrowsAndALedgerIsKeptForATumblingBrick) {
  for (const double c : {1e-3, 1.0, 1e4}) {
    Scene scene;
    scene.add({.shape = Box{{0.1, 0.4, 0.9}}, .mass = 10, .angular_velocity = {1, 2, 0.5}});
    scene.effects.emplace_back(LinearDrag{.angular_coefficient = c});
    Simulation simulation(scene, {.dt = 0.01});
    const double start = simulation.energy().kinetic;
    double last = start;
    for (int i = 0; i < 300; ++i) {
      simulation.step();
      // the splitting lets the energy breathe by 8e-3 (h w)^2 = 4e-6 of itself
      EXPECT_LE(simulation.energy().kinetic, last * (1 + 1e-5));
      last = simulation.energy().kinetic;
    }
    EXPECT_NEAR(simulation.energy().balance(), start, 2e-3 * start) << c;
  }
}

TEST(Drag, ActsOnTheBodyItNamesAndLeavesTheOthersTheirBits) {
  const auto run = [](bool drag) {
    Scene scene = ball({1, 2, 3}, {4, 5, 6});
    scene.add({.shape = Box{{0.1, 0.2, 0.3}},
               .pose = {{50, 0, 0}, Eigen::Quaterniond::Identity()},
               .velocity = {1, 0, 0},
               .angular_velocity = {3, 1, 2}});
    if (drag)
      scene.effects.emplace_back(
          LinearDrag{.coefficient = 1, .angular_coefficient = 1, .body = scene.bodies[0].id});
    Simulation simulation(scene, {.dt = 0.01});
    for (int i = 0; i < 50; ++i) simulation.step();
    return std::pair(simulation.states().position[1],
                     simulation.states().orientation[1].coeffs().eval());
  };
  EXPECT_EQ(run(true).first, run(false).first);
  EXPECT_EQ(run(true).second, run(false).second);
}

TEST(Drag, RodsKeepFinite) {
  MassProperties rod;
  rod.mass = 1;
  rod.inertia = Vector3d(1, 1, 0).asDiagonal();
  Scene scene;
  scene.add({.shape = Sphere{0.1}, .mass_properties = rod, .angular_velocity = {1, 2, 3}});
  scene.effects.emplace_back(LinearDrag{.coefficient = 1, .angular_coefficient = 1e6});
  scene.effects.emplace_back(TorsionSpring{.body = scene.bodies[0].id, .stiffness = 1e9});
  Simulation simulation(scene, {.dt = 0.01});
  for (int i = 0; i < 100; ++i) simulation.step();
  EXPECT_TRUE(simulation.report().frozen.empty());
  EXPECT_TRUE(simulation.states().pose(0).orientation.coeffs().allFinite());
}

TEST(Drag, RefusesWhatIsNoResistance) {
  EXPECT_THROW(require_valid(LinearDrag{.coefficient = -1}, "d"), InvalidInput);
  EXPECT_THROW(require_valid(LinearDrag{.wind = {0, std::nan(""), 0}}, "d"), InvalidInput);
  EXPECT_THROW(require_valid(TorsionSpring{.stiffness = 0}, "s"), InvalidInput);
  EXPECT_THROW(require_valid(TorsionSpring{.stiffness = 1, .damping = -1}, "s"), InvalidInput);
  Scene scene = ball(Vector3d::Zero());
  scene.effects.emplace_back(LinearDrag{.coefficient = 1, .body = BodyId{7}});
  EXPECT_THROW(Simulation{scene}, InvalidInput);
}

TEST(Wrench, AConstantTorqueAboutAnAxisIsExact) {
  // Drift between two half kicks: theta = T t^2 / (2 I).
  Scene scene = ball(Vector3d::Zero());
  scene.effects.emplace_back(AppliedWrench{.body = scene.bodies[0].id, .torque = {0, 0, 0.004}});
  Simulation simulation(scene, {.dt = 0.01});
  for (int i = 0; i < 100; ++i) simulation.step();
  const double inertia = 0.4 * 2 * 0.01;
  EXPECT_NEAR(rotation_logarithm(simulation.states().pose(0).orientation).z(),
              0.5 * 0.004 / inertia, 1e-14);
}

}  // namespace
}  // namespace carom
