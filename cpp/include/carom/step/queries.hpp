// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "carom/broad/box_tree.hpp"
#include "carom/narrow/contacts.hpp"
#include "carom/narrow/queries.hpp"
#include "carom/step/simulation.hpp"

namespace carom {

struct BodyHit {
  int row = -1;  ///< -1: nothing
  CastHit cast;
};

struct BodyPoint {
  int row = -1;                                     ///< -1: nothing within reach
  double distance = 0;                              ///< m; negative inside
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m, world, on the body
};

struct NearestBody {
  int row = -1;          ///< -1: nothing within reach
  ClosestPoints points;  ///< a is the body, b the shape asked with
};

struct BodyContact {
  int row = -1;
  Manifold manifold;  ///< normal from the body to the shape asked with
};

/// Questions to all bodies of a simulation as they stand when this is made; make one for a batch.
/// Takes no part in the simulation, which must outlive it and stay as it is meanwhile. A tree finds
/// the bodies worth asking. One object serves one thread.
class SceneQueries {
 public:
  /// Bodies asked: those that belong to one of these groups.
  explicit SceneQueries(const Simulation& simulation, std::uint32_t groups = 0xffffffff);

  /// First body the ray meets; the direction may have any length > 0, distances are in metres.
  /// @throws InvalidInput for a direction without length or numbers that are not finite
  [[nodiscard]] BodyHit ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                            double max_distance) const;
  /// First body the segment meets; the distance is the share of the way, 0 to 1. Start and end may
  /// be one point, which then hits at 0 what it lies in.
  [[nodiscard]] BodyHit segment(const Eigen::Vector3d& start, const Eigen::Vector3d& end) const;
  /// First body a shape meets that is carried along the direction without turning.
  [[nodiscard]] BodyHit shape(const Shape& moving, const Pose& start,
                              const Eigen::Vector3d& direction, double max_distance) const;
  /// Rows of the bodies that a shape at a pose touches, ascending.
  [[nodiscard]] std::vector<int> overlaps(const Shape& shape, const Pose& pose) const;
  /// Body nearest to a point, no farther than `reach` m.
  [[nodiscard]] BodyPoint closest(const Eigen::Vector3d& point, double reach) const;
  /// Body nearest to a shape at a pose, no farther than `reach` m; the lowest row of equal ones.
  [[nodiscard]] NearestBody closest(const Shape& shape, const Pose& pose, double reach) const;
  /// Contacts the shape would have with the bodies, rows ascending, points up to `margin` m apart.
  [[nodiscard]] std::vector<BodyContact> contacts(const Shape& shape, const Pose& pose,
                                                  double margin) const;

 private:
  /// Bodies whose boxes meet `box`, ascending, of the groups asked.
  [[nodiscard]] const std::vector<int>& near(const Aabb& box) const;
  /// @param d  unit
  [[nodiscard]] BodyHit along(const Eigen::Vector3d& origin, const Eigen::Vector3d& d,
                              double length) const;
  [[nodiscard]] NearestBody nearest(const Shape& shape, const Pose& pose, double reach) const;
  [[nodiscard]] const Shape& shape_of(int row) const;

  const Simulation& simulation_;
  std::vector<Pose> poses_;
  std::vector<Aabb> boxes_;  ///< empty for bodies that are not asked
  BoxTree tree_;
  mutable std::vector<int> rows_;
};

}  // namespace carom
