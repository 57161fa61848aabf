// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

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

/// Questions to all bodies of a simulation as they stand when this is made; make one for a batch.
/// Takes no part in the simulation, which must outlive it and stay as it is meanwhile.
class SceneQueries {
 public:
  explicit SceneQueries(const Simulation& simulation);

  /// First body the ray meets; the direction may have any length > 0, distances are in metres.
  /// @throws InvalidInput for a direction without length or numbers that are not finite
  [[nodiscard]] BodyHit ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                            double max_distance) const;
  /// First body a shape meets that is carried along the direction without turning.
  [[nodiscard]] BodyHit shape(const Shape& moving, const Pose& start,
                              const Eigen::Vector3d& direction, double max_distance) const;
  /// Rows of the bodies that a shape at a pose touches, ascending.
  [[nodiscard]] std::vector<int> overlaps(const Shape& shape, const Pose& pose) const;
  /// Body nearest to a point, no farther than `reach` m.
  [[nodiscard]] BodyPoint closest(const Eigen::Vector3d& point, double reach) const;

 private:
  const Simulation& simulation_;
  std::vector<Pose> poses_;
  std::vector<Aabb> boxes_;
};

}  // namespace carom
