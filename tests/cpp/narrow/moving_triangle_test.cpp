// SPDX-License-Identifier: Apache-2.0
// The stages against each other on the same queries; the whole against exact rationals is
// tests/python/test_ccd.py.
#include "carom/narrow/moving_triangle.hpp"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "../../../cpp/src/narrow/contact_filter.hpp"
#include "../../../cpp/src/narrow/exact_contact.hpp"

namespace carom {
namespace {

using narrow::ContactFilter;
using Query = std::array<double, 24>;

// Random, near-coplanar and near-border queries: border cases moved by a few ulps are where a bound
// ten times too small shows.
std::vector<Query> hard_queries(int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> eighth(-8, 8);
  std::vector<Query> out(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    Query& q = out[static_cast<std::size_t>(n)];
    for (double& x : q) x = n % 4 == 0 ? unit(random) : eighth(random) / 8.0;
    if (n % 4 == 1)  // a corner or end on a line of the other at the middle of the step
      for (std::size_t k = 0; k < 3; ++k) q[12 + k] = q[6 + k] + q[18 + k] - q[k];
    if (n % 4 == 2)  // one plane
      for (std::size_t j = 0; j < 8; ++j) q[3 * j + 2] = q[3 * j] + q[3 * j + 1];
    if (n % 2 == 1)
      for (double& x : q) x = x * 1.1 + (unit(random) > 0 ? 0 : x * 0x1p-52);
  }
  return out;
}

template <int Corners>
void check_filter(ContactFilter filter, double least_decided) {
  const std::vector<Query> queries = hard_queries(20000, 5);
  std::vector<std::uint8_t> verdict(queries.size());
  std::vector<double> time(queries.size());
  filter(queries[0].data(), queries.size(), verdict.data(), time.data());
  std::size_t decided = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (verdict[i] == narrow::verdict_undecided) continue;
    ++decided;
    const narrow::ExactContact truth = narrow::exact_contact<Corners>(queries[i].data());
    ASSERT_EQ(verdict[i] == narrow::verdict_hit, truth.hit) << i;
    if (!truth.hit) continue;
    // both are lower bounds of one contact, each within its bracket
    ASSERT_LE(std::fabs(time[i] - truth.time), tolerance::contact_time) << i;
  }
  EXPECT_GT(static_cast<double>(decided), least_decided * static_cast<double>(queries.size()));
}

TEST(ContactFilter, IsNeverWrongWhereItDecides) {
  check_filter<3>(narrow::portable::filter_point_triangle, 0.5);
  check_filter<4>(narrow::portable::filter_edge_edge, 0.5);
}

#if defined(__x86_64__)
TEST(ContactFilter, GivesTheSameBitsInWiderLanes) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP();
  const std::vector<Query> queries = hard_queries(20000, 6);
  const std::array<std::array<ContactFilter, 2>, 2> pairs{
      {{narrow::portable::filter_point_triangle, narrow::avx2::filter_point_triangle},
       {narrow::portable::filter_edge_edge, narrow::avx2::filter_edge_edge}}};
  for (const auto& pair : pairs) {
    std::vector<std::uint8_t> verdict[2];
    std::vector<double> time[2];
    for (std::size_t k = 0; k < 2; ++k) {
      verdict[k].resize(queries.size());
      time[k].resize(queries.size());
      pair[k](queries[0].data(), queries.size(), verdict[k].data(), time[k].data());
    }
    EXPECT_EQ(verdict[0], verdict[1]);
    EXPECT_EQ(time[0], time[1]);
  }
}
#endif

MovingFour falling_point(double from, double to) {
  MovingFour q;
  q.start << 0.25, 0, 1, 0, 0.25, 0, 0, 1, from, 0, 0, 0;
  q.end = q.start;
  q.end(2, 0) = to;
  return q;
}

TEST(MovingTriangle, MeetsAFallingPointAtTheClosedFormTime) {
  const CcdHit h = point_triangle(falling_point(0.3, -0.7));
  ASSERT_TRUE(h.hit);
  EXPECT_LE(h.time, 0.3);
  EXPECT_GE(h.time, 0.3 - tolerance::contact_time);
  EXPECT_FALSE(point_triangle(falling_point(1, 1e-300)).hit);
  EXPECT_TRUE(point_triangle(falling_point(1, 0)).hit);    // closed at t = 1
  EXPECT_EQ(point_triangle(falling_point(0, 1)).time, 0);  // and at t = 0, though moving apart
}

TEST(MovingTriangle, AnEdgeOfLengthZeroIsAPoint) {
  MovingFour q;  // columns a0 a1 b0 b1: a point crossing the middle of a resting segment
  q.start << 0, 0, 0, 0, 0.5, 0.5, -1, 1, 0, 0, 0, 0;
  q.end = q.start;
  q.start.row(0).head<2>().setConstant(1);
  q.end.row(0).head<2>().setConstant(-1);
  const CcdHit h = edge_edge(q);
  ASSERT_TRUE(h.hit);
  EXPECT_EQ(h.status, CcdStatus::coplanar);
  EXPECT_LE(h.time, 0.5);
  EXPECT_GE(h.time, 0.5 - tolerance::contact_time);
}

TEST(MovingTriangle, CoordinatesOfEverySizeInOneQueryAreDecided) {
  // 2^-1074 above the face after a fall from 1e308: no contact; below: contact
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_FALSE(point_triangle(falling_point(1e308, least)).hit);
  EXPECT_TRUE(point_triangle(falling_point(1e308, -least)).hit);
  EXPECT_TRUE(point_triangle(falling_point(1e308, -1e308)).hit);
}

TEST(MovingTriangle, RefusesNonFiniteInputAndDisagreeingSizes) {
  EXPECT_THROW((void)point_triangle(falling_point(NAN, 0)), InvalidInput);
  EXPECT_THROW((void)edge_edge(falling_point(0, INFINITY)), InvalidInput);
  EXPECT_THROW((void)edge_edge(falling_point(0, 1), {.thickness = -1}), InvalidInput);
  std::vector<double> queries(48), time(1);
  std::vector<std::uint8_t> hit(2), status(2);
  EXPECT_THROW(point_triangle(queries, {hit, time, status}), InvalidInput);
}

TEST(Thickness, DoesNotCryWolfForASpeckBesideALongEdge) {
  // An edge of 1e-8 m lies 1e-6 m beside one of 200 m: the distance is 5e-9 of the length, so the
  // direction between them, a difference of rounded points, is off by 1e-7 of itself; 100 m along
  // the edge that is ten times the distance.
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d along = any().normalized(), middle = any();
    const Eigen::Vector3d aside = along.cross(any()).normalized();
    MovingFour q;
    q.start.col(0) = middle + 1e-6 * aside + 30 * along;
    q.start.col(1) = q.start.col(0) + 1e-8 * aside;
    q.start.col(2) = middle - 100 * along;
    q.start.col(3) = middle + 100 * along;
    const Eigen::Vector3d moves = 1e-3 * along;
    q.end = q.start;
    q.end.col(0) += moves;
    q.end.col(1) += moves;
    // Coordinates of 100 m round by 1.4e-14 m: the distance stays above 0.99e-6.
    hits += edge_edge(q, {.thickness = 5e-7}).hit;
    EXPECT_TRUE(edge_edge(q, {.thickness = 1.01e-6}).hit);
  }
  EXPECT_EQ(hits, 0);
}

}  // namespace
}  // namespace carom
