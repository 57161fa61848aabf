// SPDX-License-Identifier: Apache-2.0
#include "broad/size_classes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom::broad {
namespace {

constexpr int span_of_exponents = 4;
constexpr int lowest = std::numeric_limits<double>::min_exponent - 55;  // 0 and the denormals
constexpr int bins = std::numeric_limits<double>::max_exponent - lowest + 2;

int bin_of(const Aabb& box) {
  const double size = (box.upper - box.lower).maxCoeff();
  if (!(size > 0)) return 0;
  if (!std::isfinite(size)) return bins - 1;
  return std::max(std::ilogb(size) - lowest, 1);
}

}  // namespace

std::span<const std::span<const int>> SizeClasses::split(std::span<const int> rows,
                                                         std::span<const Aabb> boxes) {
  count_.assign(bins + 1, 0);
  exponent_.clear();
  for (const int row : rows) {
    exponent_.push_back(bin_of(boxes[static_cast<std::size_t>(row)]));
    ++count_[static_cast<std::size_t>(exponent_.back()) + 1];
  }
  // Bin -> class: a class opens at the first used bin that the last one does not reach.
  std::vector<int>& group_of_bin = count_;
  int group = -1, opened = 0;
  for (int bin = 0; bin < bins; ++bin) {
    const bool used = count_[static_cast<std::size_t>(bin) + 1] > 0;
    if (used && (group < 0 || opened == 0 || bin - opened >= span_of_exponents)) {
      ++group;
      opened = bin;
    }
    group_of_bin[static_cast<std::size_t>(bin)] = group;
  }
  ordered_.clear();
  groups_.clear();
  ordered_.reserve(rows.size());
  for (int g = 0; g <= group; ++g) {
    const std::size_t begin = ordered_.size();
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (group_of_bin[static_cast<std::size_t>(exponent_[i])] == g) ordered_.push_back(rows[i]);
    groups_.emplace_back(ordered_.data() + begin, ordered_.size() - begin);
  }
  return groups_;
}

}  // namespace carom::broad
