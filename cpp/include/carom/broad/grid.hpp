// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>

#include "carom/broad/mesh_index.hpp"

namespace carom {

/// Uniform grid over the faces of a mesh: cells hashed on (i, j, k), a list of faces per cell, no
/// memory for empty ones. A segment visits only the cells it crosses.
///
/// Builds faster than a tree and answers as fast for faces of one size; faces of mixed sizes, long
/// rays through empty space and distant points cost it more. The studies show where.
/// Source: lecture notes, "Acceleration: grids"; Amanatides and Woo 1987 (the walk).
class HashGrid final : public MeshIndex {
 public:
  /// @param cell_size  m, > 0; by default about the size of a face, larger where that would list
  ///   faces too often
  /// @throws InvalidInput for bad meshes, and for a cell size that needs more than 2^31 entries or
  ///   2^20 cells along an axis
  HashGrid(const Eigen::Ref<const TriangleMesh::Vertices>& vertices,
           const Eigen::Ref<const TriangleMesh::Faces>& faces,
           std::optional<double> cell_size = std::nullopt);
  ~HashGrid() override;
  HashGrid(HashGrid&&) noexcept;
  HashGrid& operator=(HashGrid&&) noexcept;

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

  [[nodiscard]] double cell_size() const;         ///< m
  [[nodiscard]] std::size_t cell_count() const;   ///< cells that hold a face
  [[nodiscard]] std::size_t entry_count() const;  ///< faces listed, each once per cell

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
