// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "carom/geometry/aabb.hpp"

#include "broad/box_blocks.hpp"

namespace carom::broad {

/// Owns one complete 8-ary tree over some rows of an array of boxes.
class BlockTree {
 public:
  /// Orders the rows by repeated median splits along the widest axis of their centres, so that
  /// every block but the last is full; any input, equal boxes too, gives the same depth.
  void build(std::span<const int> rows, std::span<const Aabb> boxes);
  void set(int slot, const Aabb& box);  ///< the bounds above it are then stale
  void refit(int slot);                 ///< bounds above one slot, as far up as they change
  void refit();                         ///< all bounds; updates cost()

  [[nodiscard]] std::span<const int> rows() const { return rows_; }  ///< row of each slot
  /// Mean over the blocks of the surface a query can strike (sum of extents), m. It grows as the
  /// boxes mix.
  [[nodiscard]] double cost() const { return cost_; }
  [[nodiscard]] BlockTreeView view() const;

 private:
  struct Item {
    double centre[3];
    int row;
  };
  void order(int begin, int end, int unit);

  std::vector<Item> items_;
  std::vector<int> rows_;
  std::vector<int> level_offset_, level_size_;
  std::vector<BoxBlock> blocks_;
  double cost_ = 0;
};

}  // namespace carom::broad
