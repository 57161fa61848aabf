// SPDX-License-Identifier: Apache-2.0
// Two edges along one another, as of leaning cards: between the normals of the faces beside them no
// direction is better than another, and rounding must not choose.
#include <cmath>

#include <gtest/gtest.h>

#include "carom/geometry/hull.hpp"
#include "carom/narrow/contacts.hpp"

#include "../box_mesh.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

constexpr double lean = 0.4;  // rad, of both, about y
const Vector3d extents(0.02, 0.6, 1);

/// A card whose upper inner edge lies at `edge`; side -1 stands at x < 0, 1 at x > 0.
Pose leaning(int side, const Vector3d& edge) {
  Pose pose;
  pose.orientation = Eigen::AngleAxisd(-side * lean, Vector3d::UnitY());
  pose.position = edge - pose.orientation * Vector3d(-0.5 * side * extents.x(), 0, 0.5);
  return pose;
}

std::vector<Shape> cards() {
  TriangleMesh::Vertices corners(8, 3);
  for (int i = 0; i < 8; ++i)
    corners.row(i) = 0.5 * Eigen::RowVector3d(i & 1 ? extents.x() : -extents.x(),
                                              i & 2 ? extents.y() : -extents.y(),
                                              i & 4 ? extents.z() : -extents.z());
  return {Box{extents}, ConvexHull(corners)};
}

std::vector<Manifold> meet(const Shape& shape, const Vector3d& gap, double along = 0) {
  std::vector<Manifold> out;
  collide(shape, leaning(-1, -0.5 * gap), shape, leaning(1, 0.5 * gap + along * Vector3d::UnitY()),
          0.01, out);
  return out;
}

TEST(EdgeOnEdge, PartsMidwayBetweenTheFacesWhateverTheRounding) {
  for (const Shape& shape : cards())
    for (const double gap : {0.0, 1e-16, -1e-16, 1e-12, -1e-12, 1e-9, -1e-9}) {
      const auto found = meet(shape, {gap, 0, 0});
      ASSERT_EQ(found.size(), 1u) << gap;
      // The direction turns by the angle between the two faces, 2 lean, over 2e-4 of 2.3 m.
      EXPECT_NEAR(found[0].normal.x(), 1, 1e-9);
      EXPECT_LT(std::abs(found[0].normal.z()), 1e-4) << gap;
      ASSERT_EQ(found[0].count, 2);
      EXPECT_NEAR(std::abs(found[0].points[0].position.y() - found[0].points[1].position.y()), 0.6,
                  1e-12);
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(found[0].points[k].separation, gap, 1e-12);
    }
}

TEST(EdgeOnEdge, ReachesOverWhatBothShare) {
  for (const Shape& shape : cards()) {
    const auto found = meet(shape, {-1e-9, 0, 0}, 0.25);
    ASSERT_EQ(found.size(), 1u);
    ASSERT_EQ(found[0].count, 2);
    const double y0 = found[0].points[0].position.y(), y1 = found[0].points[1].position.y();
    EXPECT_NEAR(std::min(y0, y1), -0.05, 1e-9);
    EXPECT_NEAR(std::max(y0, y1), 0.3, 1e-9);
    EXPECT_NE(found[0].points[0].feature, found[0].points[1].feature);
  }
}

TEST(EdgeOnEdge, TurnsLittleByLittle) {
  // Round the place where the edges meet: nowhere does the direction jump by more than the motion
  // allows, 2 lean over the width of 2.3e-4 m, six times for the slope of a normalised sum.
  for (const Shape& shape : cards())
    for (const double radius : {2e-5, 1e-4}) {
      Vector3d before = Vector3d::Zero();
      const double step = 1e-4;
      for (double angle = -0.3; angle < 0.3; angle += step) {  // overlapping, within the wedge
        const auto found = meet(shape, {-radius * std::cos(angle), 0, radius * std::sin(angle)});
        ASSERT_EQ(found.size(), 1u);
        if (!before.isZero()) {
          EXPECT_LT((found[0].normal - before).norm(), 6 * 2 * lean / 2.3e-4 * radius * step)
              << radius << ' ' << angle;
        }
        before = found[0].normal;
      }
    }
}

TEST(EdgeOnEdge, LeavesFacesAndCrossingEdgesAlone) {
  const Shape box = Box{{1, 1, 1}};
  std::vector<Manifold> out;
  collide(box, Pose{}, box, Pose{.position = {0.3, 0.2, 0.999}}, 0.01, out);  // face on face
  ASSERT_EQ(out.size(), 1u);
  EXPECT_NEAR(out[0].normal.z(), 1, 1e-12);
  EXPECT_EQ(out[0].count, 4);
  out.clear();
  // An edge in the middle of a face.
  const Pose tilted{
      .position = {0, 0, 0.5 + std::sqrt(0.5) - 1e-3},
      .orientation = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitY()))};
  collide(box, Pose{}, box, tilted, 0.01, out);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_NEAR(out[0].normal.z(), 1, 1e-12);
  EXPECT_NEAR(out[0].points[0].separation, -1e-3, 1e-12);
}

}  // namespace
}  // namespace carom
