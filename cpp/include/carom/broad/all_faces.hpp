// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/broad/mesh_index.hpp"

namespace carom {

/// No index at all: every query looks at every face. For a handful of faces the fastest; for tests
/// and studies what trees and grids are held against.
class AllFaces final : public MeshIndex {
 public:
  /// @throws InvalidInput as Bvh
  AllFaces(const Eigen::Ref<const TriangleMesh::Vertices>& vertices,
           const Eigen::Ref<const TriangleMesh::Faces>& faces);

  [[nodiscard]] std::vector<RayHit> raycast(
      Points origins, Points directions,
      double max_distance = std::numeric_limits<double>::infinity()) const override;
  [[nodiscard]] std::vector<std::uint8_t> any_hit(
      Points origins, Points directions,
      double max_distance = std::numeric_limits<double>::infinity()) const override;
  [[nodiscard]] std::vector<SegmentHit> segments(Points starts, Points ends) const override;
  [[nodiscard]] std::vector<std::uint8_t> blocked(Points starts, Points ends) const override;
  [[nodiscard]] Overlaps overlaps(Points lower, Points upper) const override;
  [[nodiscard]] std::vector<ClosestPoint> closest(Points points) const override;
  [[nodiscard]] std::vector<BodyPair> self_pairs() const override;
  [[nodiscard]] int face_count() const override;
  [[nodiscard]] std::size_t memory_bytes() const override;

 private:
  TriangleMesh mesh_;
};

}  // namespace carom
