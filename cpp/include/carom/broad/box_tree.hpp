// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "carom/broad/pairs.hpp"
#include "carom/geometry/aabb.hpp"

namespace carom {

/// Overlapping pairs among boxes that move a little from step to step.
///
/// Keeps trees of fattened boxes and the pairs whose fat boxes overlap. A box that stays inside its
/// fat one costs a comparison, so a settled pile costs next to nothing; when many leave at once all
/// are fattened afresh and one pass over the trees finds the pairs. The answer never depends on
/// that history: it is exactly the pairs of closed boxes that overlap, ascending, so a restored
/// simulation sees the same ones. Allocates only to grow.
class BoxTree {
 public:
  BoxTree();
  ~BoxTree();
  BoxTree(BoxTree&&) noexcept;
  BoxTree& operator=(BoxTree&&) noexcept;

  /// Takes the boxes of this step and finds the pairs. A changed number of boxes, or a changed
  /// `moves`, starts afresh.
  /// @param boxes  m; infinite bounds are allowed (planes); an empty box overlaps nothing
  /// @param moves  per box, 0 = static; two static boxes are never a pair
  /// @returns ascending pairs a < b; valid until the next update
  /// @throws InvalidInput for a NaN bound, or sizes that differ; the tree is then as before
  std::span<const BodyPair> update(std::span<const Aabb> boxes,
                                   std::span<const std::uint8_t> moves);

  [[nodiscard]] std::span<const BodyPair> pairs() const;
  [[nodiscard]] int size() const;  ///< boxes of the last update

  /// Rows of the boxes that overlap `box`, ascending; static ones too. @throws InvalidInput for NaN
  void overlaps(const Aabb& box, std::vector<int>& rows) const;

  /// Rows of the boxes that the segment may touch, ascending. Never leaves one out; a box missed by
  /// less than rounding (a few units of roundoff of the coordinates) may be named.
  /// @param start, end  m, finite  @throws InvalidInput
  void crossed(const Eigen::Vector3d& start, const Eigen::Vector3d& end,
               std::vector<int>& rows) const;

  /// What the updates since construction did; for benches and for those who tune.
  struct Counters {
    std::int64_t updates = 0, builds = 0, full_passes = 0;
    std::int64_t refattened = 0;  ///< boxes that left their fat box, one by one
    std::int64_t candidates = 0;  ///< fat pairs now kept
  };
  [[nodiscard]] const Counters& counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
