// SPDX-License-Identifier: Apache-2.0
#include "carom/narrow/sweep.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

SweptBody segment(const Vector3d& from, const Vector3d& to) {
  SweptBody b;
  b.mesh.vertices.resize(2, 3);
  b.mesh.vertices << from.transpose(), to.transpose();
  b.mesh.faces.resize(0, 3);
  b.edges.resize(1, 2);
  b.edges << 0, 1;
  return b;
}

// A rod of half length 1 along x turns about z; a post stands at radius 0.9, at the angle given.
SweepResult rod_past_post(double turn, double post_angle, const SweepOptions& options = {}) {
  SweptBody rod = segment({-1, 0, 0}, {1, 0, 0});
  rod.motion.rotation = {0, 0, turn};
  const Vector3d foot(0.9 * std::cos(post_angle), 0.9 * std::sin(post_angle), 0);
  SweptBody post = segment({0, 0, -1}, {0, 0, 1});
  post.motion.centre = foot;
  return sweep(rod, post, options);
}

// Straight corner paths of half a turn pass through the centre and never come near the post.
TEST(Sweep, ASpinningRodNeverSlipsPastAPost) {
  for (const double turn : {0.3, 100.0 / 60, pi, 2 * pi, 20.0})
    for (double share = 0.05; share < 1; share += 0.1) {
      const double angle = share * std::min(turn, pi - 0.01);
      const SweepResult r = rod_past_post(turn, angle);
      ASSERT_EQ(r.status, SweepStatus::contact) << turn << ' ' << angle;
      EXPECT_EQ(r.kind, SweepResult::Kind::edge_edge);
      // the rod's angle at contact is the post's: never late, and early by the angle under which
      // the allowed gap (1e-6 m) shows at the post, twice for the chord
      EXPECT_LE(r.time, angle / turn);
      EXPECT_GE(r.time, (angle - 2 * tolerance::sweep_gap / 0.9) / turn);
      EXPECT_LT(r.intervals, 100);
    }
}

TEST(Sweep, ARodThatStopsShortOfThePostIsCertifiedClear) {
  for (const double short_of : {1e-1, 1e-3, 1e-5}) {
    const SweepResult r = rod_past_post(0.3, 0.3 + short_of);
    EXPECT_EQ(r.status, SweepStatus::separated) << short_of;
    EXPECT_EQ(r.time, 1);
  }
  // post beyond the rod's end
  SweptBody rod = segment({-1, 0, 0}, {1, 0, 0});
  rod.motion.rotation = {0, 0, 2 * pi};
  SweptBody post = segment({0, 0, -1}, {0, 0, 1});
  post.motion.centre = {0, 1 + 1e-5, 0};
  const SweepResult r = sweep(rod, post);
  EXPECT_EQ(r.status, SweepStatus::separated);
  // gap 1e-5 asks for chords of sqrt(8e-5) rad near the two passages; far from them for few
  EXPECT_LT(r.intervals, 400);
}

TEST(Sweep, TheIntervalLimitIsSaidAndStaysSafe) {
  const double turn = 2, angle = 1.5;
  const SweepResult r = rod_past_post(turn, angle, {.max_intervals = 2});
  EXPECT_EQ(r.status, SweepStatus::interval_limit);
  EXPECT_LE(r.time, angle / turn);
}

TEST(Sweep, ThicknessIsReachedEarlierByItsOwnAngle) {
  const double turn = 1, angle = 0.8, thickness = 0.01;
  const SweepResult r = rod_past_post(turn, angle, {.thickness = thickness});
  ASSERT_EQ(r.status, SweepStatus::contact);
  // distance of the post from the rod's line is 0.9 sin(angle - turn t)
  const double exact = angle - std::asin(thickness / 0.9);
  EXPECT_LE(r.time, exact);
  EXPECT_GE(r.time, exact - 2 * tolerance::sweep_gap / 0.9);
}

TEST(Sweep, AFastBulletMeetsAThinPlateFace) {
  SweptBody plate;
  plate.mesh.vertices.resize(4, 3);
  plate.mesh.vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  plate.mesh.faces.resize(2, 3);
  plate.mesh.faces << 0, 1, 2, 0, 2, 3;
  plate.edges = edges_of(plate.mesh.faces);
  EXPECT_EQ(plate.edges.rows(), 5);
  SweptBody bullet;
  bullet.mesh.vertices.resize(1, 3);
  bullet.mesh.vertices << 0, 0, 0;
  bullet.mesh.faces.resize(0, 3);
  bullet.edges.resize(0, 2);
  bullet.motion.centre = {0.3, 0.2, 600};
  bullet.motion.displacement = {0, 0, -1200};
  const SweepResult r = sweep(bullet, plate);
  ASSERT_EQ(r.status, SweepStatus::contact);
  EXPECT_EQ(r.kind, SweepResult::Kind::vertex_face);
  EXPECT_LE(r.time, 0.5);
  EXPECT_GE(r.time, 0.5 - 1e-9 - tolerance::sweep_gap / 1200);
  const SweepResult other = sweep(plate, bullet);
  EXPECT_EQ(other.kind, SweepResult::Kind::face_vertex);
  EXPECT_EQ(other.time, r.time);
}

TEST(Sweep, SurfacesThatAlreadyCrossAreInContactAtOnce) {
  // A rod through the middle of a face: its ends and the face's edges are 0.2 m apart and more.
  SweptBody face;
  face.mesh.vertices.resize(3, 3);
  face.mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  face.mesh.faces.resize(1, 3);
  face.mesh.faces << 0, 1, 2;
  face.edges = edges_of(face.mesh.faces);
  SweptBody rod = segment({0.3, 0.3, -1}, {0.3, 0.3, 1});
  for (const double turn : {0.0, 2.0}) {
    rod.motion.rotation.z() = turn;
    const SweepResult r = sweep(rod, face), other = sweep(face, rod);
    EXPECT_EQ(r.status, SweepStatus::contact);
    EXPECT_EQ(r.time, 0);
    EXPECT_EQ(r.kind, SweepResult::Kind::edge_face);
    EXPECT_EQ(r.a, 0);
    EXPECT_EQ(r.b, 0);
    EXPECT_EQ(other.status, SweepStatus::contact);
    EXPECT_EQ(other.kind, SweepResult::Kind::face_edge);
  }
  rod.motion.rotation.setZero();
  rod.motion.centre.z() = 1.5;
  EXPECT_EQ(sweep(rod, face).status, SweepStatus::separated);
  rod.motion.displacement.z() = -1.0;
  EXPECT_EQ(sweep(rod, face).kind, SweepResult::Kind::vertex_face) << "met on the way";
}

// |x(t) - chord(t)| <= r angle^2 / 8 for every interval, and no bound ten times smaller would hold
TEST(Sweep, TheChordErrorBoundsTheArcAndIsTight) {
  const Vector3d p(0.7, 0, 0.4);
  for (const double angle : {1e-4, 0.01, 0.1, 0.785}) {
    ScrewMotion m;
    m.displacement = {1, -2, 3};
    m.rotation = {0, 0, angle};
    double worst = 0;
    for (int i = 0; i <= 100; ++i) {
      const double t = i / 100.0;
      const Vector3d chord = (1 - t) * m.position(p, 0) + t * m.position(p, 1);
      worst = std::max(worst, (m.position(p, t) - chord).norm());
    }
    const double rounding = 64 * tolerance::unit_roundoff * 4;  // positions are below 4 m
    EXPECT_LE(worst, chord_error(0.7, angle) + rounding);
    EXPECT_GE(worst, 0.9 * chord_error(0.7, angle) - rounding);
  }
}

TEST(Sweep, RefusesIndicesAndNumbersThatMeanNothing) {
  SweptBody rod = segment({-1, 0, 0}, {1, 0, 0}), post = rod;
  EXPECT_THROW((void)sweep(rod, post, {.tolerance = 0}), InvalidInput);
  EXPECT_THROW((void)sweep(rod, post, {.thickness = -1}), InvalidInput);
  rod.edges(0, 1) = 2;
  EXPECT_THROW((void)sweep(rod, post), InvalidInput);
  post.motion.rotation.x() = NAN;
  EXPECT_THROW((void)sweep(post, post), InvalidInput);
}

}  // namespace
}  // namespace carom
