// SPDX-License-Identifier: Apache-2.0
#include "broad/block_tree.hpp"

#include <algorithm>
#include <limits>

namespace carom::broad {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

int blocks_for(int count) {
  return (count + block_width - 1) / block_width;
}

}  // namespace

void BlockTree::build(std::span<const int> rows, std::span<const Aabb> boxes) {
  const int n = static_cast<int>(rows.size());
  items_.clear();
  for (const int row : rows) {
    const Aabb& box = boxes[static_cast<std::size_t>(row)];
    Item item{.centre = {}, .row = row};
    // Halves first: the sum of two large finite bounds may overflow.
    for (int k = 0; k < 3; ++k) item.centre[k] = 0.5 * box.lower[k] + 0.5 * box.upper[k];
    items_.push_back(item);
  }
  int unit = block_width;
  while (unit < n) unit *= block_width;
  order(0, n, unit);

  level_offset_.clear();
  level_size_.clear();
  int total = 0;
  for (int size = blocks_for(n);; size = blocks_for(size)) {
    level_offset_.push_back(total);
    level_size_.push_back(size);
    total += size;
    if (size <= 1) break;
  }
  BoxBlock none;
  for (int k = 0; k < 6; ++k) std::fill_n(none.bounds[k], block_width, k < 3 ? inf : -inf);
  blocks_.assign(static_cast<std::size_t>(total), none);
  rows_.assign(static_cast<std::size_t>(blocks_for(n)) * block_width, -1);
  for (int slot = 0; slot < n; ++slot) {
    const int row = items_[static_cast<std::size_t>(slot)].row;
    rows_[static_cast<std::size_t>(slot)] = row;
    set(slot, boxes[static_cast<std::size_t>(row)]);
  }
  rows_.resize(static_cast<std::size_t>(n));
  refit();
}

// Splits [begin, end) into runs of `unit` slots, then each of these into runs of unit / 8.
void BlockTree::order(int begin, int end, int unit) {
  while (end - begin <= unit) {
    if (unit <= block_width) return;
    unit /= block_width;
  }
  Item* const items = items_.data();
  double lower[3] = {inf, inf, inf}, upper[3] = {-inf, -inf, -inf};
  for (int i = begin; i < end; ++i)
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], items[i].centre[k]);
      upper[k] = std::max(upper[k], items[i].centre[k]);
    }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (upper[k] - lower[k] > upper[axis] - lower[axis]) axis = k;
  const int runs = (end - begin + unit - 1) / unit;
  const int middle = begin + (runs + 1) / 2 * unit;
  std::nth_element(items + begin, items + middle, items + end,
                   [axis](const Item& a, const Item& b) {
                     return a.centre[axis] < b.centre[axis] ||
                            (a.centre[axis] == b.centre[axis] && a.row < b.row);
                   });
  order(begin, middle, unit);
  order(middle, end, unit);
}

void BlockTree::set(int slot, const Aabb& box) {
  BoxBlock& block = blocks_[static_cast<std::size_t>(slot / block_width)];
  for (int k = 0; k < 3; ++k) {
    block.bounds[k][slot % block_width] = box.lower[k];
    block.bounds[3 + k][slot % block_width] = box.upper[k];
  }
}

void BlockTree::refit(int slot) {
  int index = slot / block_width;
  for (std::size_t level = 0; level + 1 < level_size_.size(); ++level, index /= block_width) {
    const auto at = static_cast<std::size_t>(level_offset_[level] + index);
    double box[6];
    block_kernels().bounds(blocks_[at], box);
    BoxBlock& parent =
        blocks_[static_cast<std::size_t>(level_offset_[level + 1] + index / block_width)];
    bool changed = false;
    for (int k = 0; k < 6; ++k) {
      double& bound = parent.bounds[k][index % block_width];
      changed = changed || bound != box[k];
      bound = box[k];
    }
    if (!changed) return;
  }
}

void BlockTree::refit() {
  const auto bounds = block_kernels().bounds;
  double sum = 0;
  for (std::size_t level = 0; level + 1 < level_size_.size(); ++level)
    for (int index = 0; index < level_size_[level]; ++index) {
      double box[6];
      bounds(blocks_[static_cast<std::size_t>(level_offset_[level] + index)], box);
      BoxBlock& parent =
          blocks_[static_cast<std::size_t>(level_offset_[level + 1] + index / block_width)];
      for (int k = 0; k < 6; ++k) parent.bounds[k][index % block_width] = box[k];
      // Quarters: the extent of a box as wide as the range of doubles overflows, its quarter not.
      for (int k = 0; k < 3; ++k) sum += 0.25 * box[3 + k] - 0.25 * box[k];
    }
  cost_ = sum / static_cast<double>(blocks_.size());
}

BlockTreeView BlockTree::view() const {
  return {.blocks = blocks_.data(),
          .rows = rows_.data(),
          .level_offset = level_offset_.data(),
          .levels = static_cast<int>(level_size_.size()),
          .leaves = level_size_.empty() ? 0 : level_size_.front()};
}

}  // namespace carom::broad
