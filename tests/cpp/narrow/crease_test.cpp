// SPDX-License-Identifier: Apache-2.0
// A corner of a body at a crease of a surface: each face holds it, also past its own end.
#include <cmath>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "carom/narrow/contacts.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

constexpr double slope = 0.35;  // rad, of both sides: the valley opens by pi - 0.7, an obtuse angle

/// Two sides of 2 m x 4 m that meet along the x axis.
Mesh valley() {
  const double y = 2 * std::cos(slope), z = 2 * std::sin(slope);
  TriangleMesh m;
  m.vertices.resize(6, 3);
  m.vertices << -2, 0, 0, 2, 0, 0, 2, y, z, -2, y, z, -2, -y, z, 2, -y, z;
  m.faces.resize(4, 3);
  m.faces << 0, 1, 2, 0, 2, 3, 1, 0, 4, 1, 4, 5;
  return Mesh(std::move(m));
}

/// Unit normal of the side at y > 0 (side 1) or y < 0 (-1).
Vector3d normal(int side) {
  return {0, -side * std::sin(slope), std::cos(slope)};
}

/// Separation of the contact of a cube of 0.2 m, which stands on its corner at `tip`, along n.
std::optional<double> gap(const Vector3d& tip, const Vector3d& n, double margin) {
  const Eigen::Quaterniond q =
      Eigen::Quaterniond::FromTwoVectors(Vector3d(-1, -1, -1), -Vector3d::UnitZ());
  const Pose cube{.position = tip + Vector3d(0, 0, 0.1 * std::sqrt(3.0)), .orientation = q};
  std::vector<Manifold> out;
  collide(valley(),
          Pose{.position = Vector3d::Zero(), .orientation = Eigen::Quaterniond::Identity()},
          Box{Vector3d::Constant(0.2)}, cube, margin, out);
  std::optional<double> found;
  for (const Manifold& m : out)
    if ((m.normal - n).norm() < 1e-9)
      for (int k = 0; k < m.count; ++k)
        if (!found || m.points[k].separation < *found) found = m.points[k].separation;
  return found;
}

// The corner is 2 mm over one side and 5 mm from the crease: its foot on the plane of the other
// side is not on that side, and yet 10 mm of way would carry it through. Rounding of coordinates of
// 0.2 m: 1e-15 m.
TEST(Crease, AFaceHoldsPastItsEnd) {
  for (const int side : {1, -1}) {
    const Vector3d along(0, side * std::cos(slope), std::sin(slope));
    const Vector3d tip = Vector3d(0.3, 0, 0) + 0.005 * along + 0.002 * normal(side);
    for (const int face : {side, -side}) {
      const std::optional<double> found = gap(tip, normal(face), 0.02);
      ASSERT_TRUE(found) << side << ' ' << face;
      EXPECT_NEAR(*found, normal(face).dot(tip), 1e-14);
    }
  }
}

// Through the crease by 0.3 mm, 0.1 mm aside: behind both, and nearest to the crease itself.
TEST(Crease, BothFacesHoldWhatIsBehindIt) {
  const Vector3d tip(0.3, 1e-4, -3e-4);
  for (const int face : {1, -1}) {
    const std::optional<double> found = gap(tip, normal(face), 0.001);
    ASSERT_TRUE(found) << face;
    EXPECT_NEAR(*found, normal(face).dot(tip), 1e-14);
  }
}

}  // namespace
}  // namespace carom
