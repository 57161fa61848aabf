// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "carom/broad/pairs.hpp"
#include "carom/geometry/aabb.hpp"
#include "carom/geometry/mesh.hpp"

namespace carom {

struct RayHit {
  double distance = std::numeric_limits<double>::infinity();  ///< m, along the direction
  int face = -1;                                              ///< -1: nothing hit
};

struct SegmentHit {
  double fraction = 1.0;  ///< of the way from start to end, in [0, 1]; 1 where nothing is hit
  int face = -1;
};

struct ClosestPoint {
  double distance = std::numeric_limits<double>::infinity();  ///< m
  int face = -1;                                              ///< -1: no face at all
  Eigen::Vector3d point = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// Faces of many boxes: those of box i are faces[offsets[i]] .. faces[offsets[i + 1] - 1],
/// ascending.
struct Overlaps {
  std::vector<int> offsets{0};
  std::vector<int> faces;
};

using Points = Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>;

/// What can be asked of a triangle mesh, whatever stands behind it: a tree or a grid. All answer
/// alike, to the last bit: what a loop over all faces with the same tests in double would.
///
/// Rays and segments hit both sides of a face, its edges and corners included; two faces that share
/// an edge leave no gap there. A face seen exactly edge-on is not hit, its neighbours are. Of
/// several faces at one distance the lowest index is named.
/// Thread-safe while nobody refits. @throws InvalidInput for NaN, zero directions, mismatched rows
class MeshIndex {
 public:
  virtual ~MeshIndex() = default;

  /// First hit of each ray. Directions of any length; distances in m.
  /// @param max_distance  m, >= 0, inclusive, may be infinite
  [[nodiscard]] virtual std::vector<RayHit> raycast(
      Points origins, Points directions,
      double max_distance = std::numeric_limits<double>::infinity()) const = 0;
  /// Whether each ray hits anything (vector of 0 and 1).
  [[nodiscard]] virtual std::vector<std::uint8_t> any_hit(
      Points origins, Points directions,
      double max_distance = std::numeric_limits<double>::infinity()) const = 0;
  /// First hit of each closed segment. A segment of no length hits nothing.
  [[nodiscard]] virtual std::vector<SegmentHit> segments(Points starts, Points ends) const = 0;
  /// Whether anything lies between start and end of each closed segment (vector of 0 and 1).
  [[nodiscard]] virtual std::vector<std::uint8_t> blocked(Points starts, Points ends) const = 0;
  /// Faces whose bounding boxes overlap each closed box. Infinite bounds are allowed.
  [[nodiscard]] virtual Overlaps overlaps(Points lower, Points upper) const = 0;
  /// Nearest point of the mesh to each point.
  [[nodiscard]] virtual std::vector<ClosestPoint> closest(Points points) const = 0;
  /// Pairs of faces a < b whose bounding boxes overlap, ascending; neighbours included.
  [[nodiscard]] virtual std::vector<BodyPair> self_pairs() const = 0;

  [[nodiscard]] virtual int face_count() const = 0;
  [[nodiscard]] virtual std::size_t memory_bytes() const = 0;
};

}  // namespace carom
