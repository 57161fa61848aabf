// SPDX-License-Identifier: Apache-2.0
// Distance grids: the two searches of a pair are joined, whichever body comes first, and the sweep
// follows a grid that touches without asking at every gap.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "carom/geometry/sdf.hpp"
#include "carom/narrow/first_contact.hpp"
#include "carom/numerics/tolerance.hpp"

#include "shapes_for_tests.hpp"

namespace carom::testing {
namespace {

using Eigen::Vector3d;
using Status = FirstContact::Status;
constexpr double spacing = 0.02;

Shape grid_of(const SdfGrid::Distance& distance, const Vector3d& half) {
  return Sdf{
      std::make_shared<const SdfGrid>(SdfGrid::from_function(distance, {-half, half}, spacing))};
}

Shape ball_grid(double radius) {
  return grid_of([=](const Vector3d& p) { return p.norm() - radius; }, Vector3d::Constant(radius));
}

Shape block_grid(const Vector3d& half) {
  const auto distance = [=](const Vector3d& p) {
    const Vector3d q = p.cwiseAbs() - half;
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  };
  return grid_of(distance, half);
}

struct Deepest {
  double gap = std::numeric_limits<double>::infinity();
  Vector3d normal = Vector3d::Zero();
};

Deepest deepest_of(const Shape& a, const Pose& pa, const Shape& b, const Pose& pb) {
  Deepest out;
  for (const Manifold& m : contacts(a, pa, b, pb, 0.02))
    for (int k = 0; k < m.count; ++k)
      if (m.points[k].separation < out.gap) out = {m.points[k].separation, m.normal};
  return out;
}

BodyPath path_of(const Vector3d& at, const Vector3d& v, const Vector3d& w = Vector3d::Zero()) {
  BodyPath path;
  path.centre = at;
  path.velocity = v;
  path.arcs = {{0, Eigen::Quaterniond::Identity(), w}};
  return path;
}

TEST(TwoGrids, OfBallsOverlapAsTheBallsDo) {
  std::mt19937_64 random(3);
  const Shape big = ball_grid(0.4), small = ball_grid(0.3);
  for (int i = 0; i < 50; ++i) {
    const Pose at = random_pose(random, 0.2);
    Pose there = random_pose(random);
    const double gap = std::uniform_real_distribution<double>(-0.05, 0.015)(random);
    const Vector3d n = random_vector(random).normalized();
    there.position = at.position + (0.7 + gap) * n;
    const Deepest one = deepest_of(big, at, small, there), two = deepest_of(small, there, big, at);
    // h^4/384 |d4 phi|, which is at most 9 / r^3 of a sphere: 1.4e-7 of the small one along each
    // of three axes, and 0.6e-7 of the other.
    EXPECT_NEAR(one.gap, gap, 6e-7);
    // The same two searches, joined by no order of the two. The splines leave bumps of a tenth of
    // that on a level, and rounding decides in which of them a search ends.
    EXPECT_NEAR(one.gap, two.gap, 6e-8);
    // Slopes are off by sqrt(3)/216 h^3 |d4 phi|, 3.7e-5 along an axis at 0.25 m from the middle of
    // the small ball.
    EXPECT_LT((one.normal + two.normal).norm(), 7e-5);
    EXPECT_LT((one.normal - n).norm(), 7e-5);
  }
}

TEST(ABlockGrid, PokesIntoABoxByItsCorner) {
  // Down its diagonal onto the middle of a face: the corner of the field is the deepest point, and
  // the box face reaches less far into the field. The corner of the field by halving along the
  // diagonal, on which it lies by symmetry.
  const Shape block = block_grid(Vector3d::Constant(0.25)), box = Box{{2, 2, 1}};
  const SdfGrid& grid = *std::get<Sdf>(block).grid;
  const Vector3d diagonal = Vector3d::Ones().normalized();
  double low = 0.3, high = 0.5;
  Vector3d unused;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (grid.sample(middle * diagonal, unused) > 0 ? high : low) = middle;
  }
  Pose pose;
  pose.orientation = Eigen::Quaterniond::FromTwoVectors(diagonal, -Vector3d::UnitZ());
  for (const double gap : {-0.05, -0.01, 0.01}) {
    pose.position = {0.1, 0.2, 0.5 + low + gap};
    const Deepest one = deepest_of(box, {}, block, pose), two = deepest_of(block, pose, box, {});
    EXPECT_NEAR(one.gap, gap, 1e-6);  // what is promised of grids
    EXPECT_NEAR(one.gap, two.gap, 1e-12);
    EXPECT_NEAR(one.normal.z(), 1, 1e-9);
  }
}

// Three balls on a disc: a body that stands on the deepest of its feet alone would rock for ever.
TEST(AGrid, StandsOnAllItsFeet) {
  const auto distance = [](const Vector3d& p) {
    double least = std::hypot(std::max(std::hypot(p.x(), p.y()) - 0.2, 0.0),
                              std::max(std::abs(p.z() - 0.02) - 0.02, 0.0));
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * M_PI * k / 3;
      least = std::min(
          least, (p - Vector3d(0.15 * std::cos(angle), 0.15 * std::sin(angle), 0)).norm() - 0.1);
    }
    return least;
  };
  const Shape tripod = grid_of(distance, {0.3, 0.3, 0.12});
  TriangleMesh::Vertices corners(4, 3);
  corners << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  TriangleMesh::Faces faces(2, 3);
  faces << 0, 1, 2, 0, 2, 3;
  const Shape sheet = Mesh(TriangleMesh{corners, faces});
  const Pose up{.position = {0, 0, 0.099}};
  for (const Shape& floor : {sheet, Shape{Box{{2, 2, 1}}}}) {
    const Pose at{.position = {0, 0, std::holds_alternative<Box>(floor) ? -0.5 : 0}};
    bool found[3] = {false, false, false};
    for (const Manifold& m : contacts(floor, at, tripod, up, 0.02)) {
      EXPECT_GT(m.normal.z(), 0.99);
      for (int i = 0; i < m.count; ++i)
        for (int k = 0; k < 3; ++k) {
          const double angle = 2 * M_PI * k / 3;
          const Vector3d foot(0.15 * std::cos(angle), 0.15 * std::sin(angle), 0);
          // A foot is round: within a cell of its middle it is as deep as there, but for the error
          // of the grid, h^4/384 9 / 0.1^3 along each axis.
          found[k] |= (m.points[i].position - foot).norm() < spacing &&
                      std::abs(m.points[i].separation + 0.001) < 1.2e-5;
        }
    }
    for (const bool foot : found) EXPECT_TRUE(foot);
  }
}

/// The level over a point of a plane, up to a cell along its normal, by halving; far off where
/// there is none.
Vector3d level_over(const SdfGrid& grid, const Vector3d& at, const Vector3d& n) {
  double low = -grid.spacing, high = grid.spacing;
  Vector3d unused;
  if (grid.sample(at + low * n, unused) > 0 || grid.sample(at + high * n, unused) < 0)
    return Vector3d::Constant(1e9);
  while (high - low > 1e-13) {
    const double middle = 0.5 * (low + high);
    (grid.sample(at + middle * n, unused) > 0 ? high : low) = middle;
  }
  return at + low * n;
}

/// Distance of the zero level to a point: over every triangle of its mesh, then by a compass search
/// over the tangent plane of the nearest. No gradient, no projection.
double distance_to_level(const SdfGrid& grid, const Vector3d& p) {
  const MeshSurface& s = *grid.surface;
  double best = std::numeric_limits<double>::infinity();
  Vector3d at = Vector3d::Zero(), n = Vector3d::UnitZ();
  for (int f = 0; f < s.mesh.faces.rows(); ++f) {
    const Vector3d a = s.corner(f, 0), b = s.corner(f, 1), c = s.corner(f, 2);
    const Vector3d middle = (a + b + c) / 3, cross = (b - a).cross(c - a);
    if ((middle - p).norm() < best && cross.norm() > 1e-9)
      best = (middle - p).norm(), at = middle, n = cross.normalized();
  }
  const auto far = [&](const Vector3d& x) { return (level_over(grid, x, n) - p).norm(); };
  const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  best = far(at);
  for (double step = grid.spacing; step > 1e-9;) {
    bool better = false;
    for (const Vector3d& way : {u, v, Vector3d(-u), Vector3d(-v), Vector3d(u + v), Vector3d(u - v),
                                Vector3d(v - u), Vector3d(-u - v)})
      if (const double d = far(at + step * way); d < best)
        best = d, at += step * way, better = true;
    if (!better) step *= 0.5;
  }
  return best;
}

// Faces, edges and corners alike: what the pair reports is the distance of the level that the grid
// has, whatever that level is off the block it was made of.
TEST(ABlockGrid, IsAsFarFromABallAsItsLevelIs) {
  std::mt19937_64 random(17);
  const Shape block = block_grid({0.2, 0.25, 0.3}), ball = Sphere{0.1};
  const SdfGrid& grid = *std::get<Sdf>(block).grid;
  int seen[3] = {0, 0, 0};
  for (int i = 0; i < 150; ++i) {
    const Vector3d half(0.2, 0.25, 0.3);
    Vector3d x = random_vector(random).normalized();
    for (int k = 0; k < 3; ++k)  // over a face, an edge, a corner in turn
      x[k] = k <= i % 3 ? std::copysign(half[k] + 0.06, x[k]) : 0.8 * half[k] * x[k];
    const double true_gap = distance_to_level(grid, x) - 0.1;
    if (true_gap > 0.018) continue;
    const Deepest got = deepest_of(block, {}, ball, {.position = x});
    // The compass ends at 1e-9 m along the level; beside a crease, where the level bends over a
    // cell, its eight ways may stop a little above the least.
    EXPECT_NEAR(got.gap, true_gap, 1e-7) << x.transpose();
    ++seen[i % 3];
  }
  for (const int n : seen) EXPECT_GT(n, 20);
}

TEST(ABlockGrid, IsFollowedByFewLooksOnceItRests) {
  const Shape block = block_grid({0.25, 0.25, 0.25}), floor = Box{{10, 10, 1}};
  // Sliding 5 mm while it lies on the floor: half a cell takes one look, and one is for the start.
  const FirstContact r = first_contact(floor, path_of({0, 0, -0.5}, {0, 0, 0}), block,
                                       path_of({0, 0, 0.25}, {0.3, 0, 0}), 0, 1.0 / 60);
  EXPECT_EQ(r.status, Status::clear);
  EXPECT_LE(r.queries, 2);
}

TEST(ABlockGrid, IsHeldByAPlateItTouchesHoweverFast) {
  // A plate of ten cells, touched, then run through at 300 m/s: 5 m in a step. Its faces are five
  // cells off the crease in its middle, so that they lie where they should.
  const Shape plate = block_grid({0.6, 0.6, 0.1}), ball = Sphere{0.1};
  const FirstContact r = first_contact(plate, path_of({0, 0, 0}, {0, 0, 0}), ball,
                                       path_of({0.1, 0.2, 0.2}, {0, 0, -300}), 0, 1.0 / 60);
  ASSERT_EQ(r.status, Status::contact);
  // No deeper than a touching pair may come nearer, and the last halving of a look of 0.01 m.
  EXPECT_LE(300 * r.time, tolerance::sweep_slop + 0.01 / 65536 + 1e-9);
  EXPECT_NEAR(r.normal.z(), 1, 1e-6);
}

}  // namespace
}  // namespace carom::testing
