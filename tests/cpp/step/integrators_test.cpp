// SPDX-License-Identifier: Apache-2.0
// What each scheme promises: its order, what it conserves, and what it is known to get wrong. The
// judge is the closed form, itself judged by 60 digits in exact_top_test.
#include "carom/step/integrators.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"
#include "carom/step/exact_top.hpp"
#include "carom/step/free_flight.hpp"

namespace carom {
namespace {
using Eigen::Quaterniond;
using Eigen::Vector3d;

MassProperties body(const Vector3d& moments) {
  MassProperties m;
  m.mass = 1;
  m.inertia = moments.asDiagonal();
  return m;
}
const Vector3d asymmetric(1, 2, 3), spin(1, 1, 1);

FreeFlight fly(const Vector3d& moments, const Vector3d& w, double seconds, std::int64_t steps,
               Integrator method) {
  return integrate_free(body(moments), Quaterniond::Identity(), w, seconds, steps, method);
}
Quaterniond truth(const Vector3d& moments, const Vector3d& w, double seconds) {
  return exact_flight(Quaterniond::Identity(), moments.cwiseProduct(w), moments.cwiseInverse(),
                      seconds)
      .orientation;
}
double energy(const Vector3d& moments, const FreeFlight& f) {
  const Vector3d w = f.orientation.conjugate() * f.angular_velocity;
  return 0.5 * w.dot(moments.cwiseProduct(w));
}
Vector3d momentum(const Vector3d& moments, const FreeFlight& f) {
  return f.orientation * moments.cwiseProduct(f.orientation.conjugate() * f.angular_velocity);
}

class Method : public testing::TestWithParam<Integrator> {};

TEST_P(Method, ConvergesWithItsOrder) {
  const int order = order_of(GetParam());
  const double seconds = 2;  // short: before a first-order error has grown out of its law
  const int steps = order == 4 ? 40 : 400;
  const Quaterniond q = truth(asymmetric, spin, seconds);
  double error[3];
  for (int i = 0; i < 3; ++i)
    error[i] =
        rotation_angle(fly(asymmetric, spin, seconds, steps << i, GetParam()).orientation, q);
  EXPECT_NEAR(std::log2(error[0] / error[2]) / 2, order, 0.15);  // the bound
}

TEST_P(Method, KeepsAngularMomentumToRounding) {
  const FreeFlight f = fly(asymmetric, spin, 57.7, 1000, GetParam());
  const Vector3d l0 = asymmetric.cwiseProduct(spin);
  // It is carried, not integrated: only the way in and out of the body frame rounds.
  EXPECT_LE((momentum(asymmetric, f) - l0).norm(), 16 * tolerance::unit_roundoff * l0.norm());
  EXPECT_NEAR(f.orientation.norm(), 1, 8 * tolerance::unit_roundoff);
}

TEST_P(Method, BodyFrameElsewhereMovesAlike) {
  // The same body, its frame turned and its centre of mass off the origin.
  const Quaterniond frame = rotation_exponential(Vector3d(0.4, -1.1, 0.7));
  MassProperties other = body(asymmetric);
  other.inertia = frame * other.inertia * frame.conjugate();
  other.com = {3, -2, 1};
  const FreeFlight a = fly(asymmetric, spin, 2, 200, GetParam());
  const FreeFlight b = integrate_free(other, frame.conjugate(), spin, 2, 200, GetParam());
  const double apart = rotation_angle(a.orientation, b.orientation * frame);
  if (GetParam() == Integrator::lecture_gram_schmidt)
    EXPECT_GE(apart, 1e-4);  // its bias is the point: the first axis is another one
  else
    EXPECT_LE(apart, 1e-12);  // 200 steps of a few roundings each
}

INSTANTIATE_TEST_SUITE_P(Fixed, Method,
                         testing::Values(Integrator::lecture_gram_schmidt,
                                         Integrator::lecture_polar, Integrator::lecture_exponential,
                                         Integrator::lecture_quaternion,
                                         Integrator::lecture_quaternion_sqrt, Integrator::midpoint,
                                         Integrator::implicit_midpoint, Integrator::cayley,
                                         Integrator::symmetric_top, Integrator::symmetric_top_4),
                         [](const auto& test) { return std::string(name_of(test.param)); });

class Reversible : public testing::TestWithParam<Integrator> {};

TEST_P(Reversible, ThereAndBackIsNowhere) {
  const FreeFlight there = fly(asymmetric, spin, 30, 1000, GetParam());
  const FreeFlight back = integrate_free(body(asymmetric), there.orientation,
                                         there.angular_velocity, -30, 1000, GetParam());
  EXPECT_LE(rotation_angle(back.orientation, Quaterniond::Identity()), 1e-10);  // R9
}

TEST_P(Reversible, EnergyHasNoDrift) {
  // 1e5 steps at h |w| = 0.1, seen at four times: bounded, and no larger at the end.
  const double h = 0.1 / spin.norm(), e0 = 0.5 * spin.dot(asymmetric.cwiseProduct(spin));
  double first = 0, last = 0;
  for (const int steps : {997, 1993, 2999, 99991, 100003, 100019}) {
    const double e =
        std::abs(energy(asymmetric, fly(asymmetric, spin, h * steps, steps, GetParam())) / e0 - 1);
    EXPECT_LE(e, 2e-4);  // the bound
    (steps < 10000 ? first : last) = std::max(steps < 10000 ? first : last, e);
  }
  EXPECT_LE(last, 3 * first + 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Methods, Reversible,
                         testing::Values(Integrator::implicit_midpoint, Integrator::cayley,
                                         Integrator::symmetric_top, Integrator::symmetric_top_4),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(Lecture, EveryRowDriftsUntilTheBodySpinsAboutAnExtremeAxis) {
  // The known failure of all of them (and of the explicit midpoint): order 1e-3 of energy per turn.
  const double h = 0.1 / spin.norm(), e0 = 0.5 * spin.dot(asymmetric.cwiseProduct(spin));
  for (const Integrator method : {Integrator::lecture_gram_schmidt, Integrator::lecture_polar,
                                  Integrator::lecture_exponential, Integrator::lecture_quaternion,
                                  Integrator::lecture_quaternion_sqrt}) {
    const double e = energy(asymmetric, fly(asymmetric, spin, h * 1e5, 100000, method)) / e0 - 1;
    EXPECT_GT(std::abs(e), 0.1) << name_of(method);
    EXPECT_LT(e, 14.0 / 6 - 1 + 1e-9);  // |L|^2 / (2 I1): all momentum about the lightest axis
  }
}

TEST(Splitting, TheCheapOneBeatsTheLecturesEnergyAThousandfold) {
  const double h = 0.1 / spin.norm(), e0 = 0.5 * spin.dot(asymmetric.cwiseProduct(spin));
  const auto error = [&](Integrator method) {
    return std::abs(energy(asymmetric, fly(asymmetric, spin, h * 1e5, 100000, method)) / e0 - 1);
  };
  EXPECT_LT(1000 * error(Integrator::cayley), error(Integrator::lecture_exponential));
}

TEST(SymmetricTop, IsExactForSymmetricBodiesInOneStep) {
  const Vector3d w(0.5, 0.3, 3);
  for (const Vector3d& moments : {Vector3d(2, 2, 1), Vector3d(1, 2, 2), Vector3d(2, 1, 2),
                                  Vector3d(2, 2, 3), Vector3d(2, 2, 2)}) {
    const FreeFlight f = fly(moments, w, 1000, 1, Integrator::symmetric_top);
    // precession and spin angles of up to 6000 rad, each rounded a few times
    EXPECT_LE(rotation_angle(f.orientation, truth(moments, w, 1000)),
              16 * tolerance::unit_roundoff * 6000);
  }
}

TEST(SquareRoot, IsClampedAndSaysSoBeyondHalfATurn) {
  // R7. The vector part is h w / 2: real while |h w| <= 2, and an angle of 2 asin(|h w| / 2).
  for (const double turn : {1.9, 2.0, 2.1, 3.3}) {
    const FreeFlight f = fly({2, 2, 2}, {0, 0, turn}, 1, 1, Integrator::lecture_quaternion_sqrt);
    EXPECT_EQ(f.status, turn > 2 ? FlightStatus::clamped : FlightStatus::ok) << turn;
    const double angle = 2 * std::asin(std::min(turn / 2, 1.0));
    // asin is steep at 1: half the digits
    EXPECT_LE(rotation_angle(f.orientation, rotation_exponential(Vector3d(0, 0, angle))), 3e-8);
  }
}

TEST(FreeFlight, ToleranceChoosesTheSteps) {
  for (const Integrator method : {Integrator::cayley, Integrator::symmetric_top,
                                  Integrator::symmetric_top_4, Integrator::implicit_midpoint}) {
    const double allowed = 1e-6;
    const FreeFlight f =
        integrate_free(body(asymmetric), Quaterniond::Identity(), spin, 5, 1, method, allowed);
    EXPECT_EQ(f.status, FlightStatus::ok);
    const double error = rotation_angle(f.orientation, truth(asymmetric, spin, 5));
    EXPECT_LE(error, allowed);
    EXPECT_GE(error, 1e-3 * allowed) << "far more steps than needed: " << f.steps;
  }
}

TEST(FreeFlight, ToleranceBelowRoundingIsSaid) {
  for (const Integrator method :
       {Integrator::symmetric_top_4, Integrator::taylor, Integrator::exact}) {
    const FreeFlight f =
        integrate_free(body(asymmetric), Quaterniond::Identity(), spin, 5, 1, method, 1e-17);
    EXPECT_EQ(f.status, FlightStatus::below_rounding) << name_of(method);
    EXPECT_LE(rotation_angle(f.orientation, truth(asymmetric, spin, 5)), 1e-11);
  }
}

TEST(FreeFlight, RefusesWhatItCannotFly) {
  const auto go = [](double seconds, std::int64_t steps, std::optional<double> allowed,
                     const Quaterniond& q, const Vector3d& w) {
    (void)integrate_free(body(asymmetric), q, w, seconds, steps, Integrator::cayley, allowed);
  };
  const Quaterniond one = Quaterniond::Identity();
  EXPECT_THROW(go(std::nan(""), 1, {}, one, spin), InvalidInput);
  EXPECT_THROW(go(1, 0, {}, one, spin), InvalidInput);
  EXPECT_THROW(go(1, 1, 0.0, one, spin), InvalidInput);
  EXPECT_THROW(go(1, 1, {}, Quaterniond(2, 0, 0, 0), spin), InvalidInput);
  EXPECT_THROW(go(1, 1, {}, one, {0, std::nan(""), 0}), InvalidInput);
  EXPECT_THROW((void)integrator_named("rk4"), InvalidInput);
  for (const std::string_view name : METHODS) EXPECT_EQ(name_of(integrator_named(name)), name);
}

}  // namespace
}  // namespace carom
