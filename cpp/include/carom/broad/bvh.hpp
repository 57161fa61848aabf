// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>

#include "carom/broad/mesh_index.hpp"

namespace carom {

enum class Volume { box, sphere, oriented_box };

/// low: Morton order, the fastest build, for what is rebuilt every step; medium: binned surface
/// area heuristic; high: the same with more bins and exact sweeps low down.
enum class Quality { low, medium, high };

/// Bounding volume hierarchy over the faces of a mesh.
///
/// Nodes have eight children whose boxes are single precision, rounded outward; the leaves hold the
/// corners in double. Nothing is lost by the narrow boxes: they only ever let more faces be tested.
/// Spheres and oriented boxes lie over the same tree and give the same answers.
/// Source: lecture notes, "Bounding Volume Hierarchy"; Wald 2007 (binned SAH); Woop, Benthin, Wald
/// 2013 (watertight test); Ize 2013 (robust traversal).
class Bvh final : public MeshIndex {
 public:
  /// No faces: every query finds nothing.
  /// @throws InvalidInput for a coordinate that is not finite, an index out of range
  Bvh(const Eigen::Ref<const TriangleMesh::Vertices>& vertices,
      const Eigen::Ref<const TriangleMesh::Faces>& faces, Volume volume = Volume::box,
      Quality quality = Quality::medium);
  ~Bvh() override;
  Bvh(Bvh&&) noexcept;
  Bvh& operator=(Bvh&&) noexcept;

  /// The same faces with moved vertices. The tree keeps its shape where it serves; parts that have
  /// grown far beyond what they were at their build are built anew.
  /// @throws InvalidInput; the tree is then as before
  void refit(const Eigen::Ref<const TriangleMesh::Vertices>& vertices);

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

  [[nodiscard]] Volume volume() const;
  [[nodiscard]] Quality quality() const;
  [[nodiscard]] int depth() const;       ///< levels of nodes on the longest path, leaves included
  [[nodiscard]] int node_count() const;  ///< of eight children each, leaves not counted
  [[nodiscard]] int rebuilt_parts() const;  ///< by refits since construction

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
