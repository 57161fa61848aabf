// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "carom/geometry/aabb.hpp"

namespace carom::broad {

/// Groups boxes whose sizes are alike, so that one large box does not swell the bounds of the many
/// small ones that would share its block.
class SizeClasses {
 public:
  /// Groups of rows, each ascending, of boxes whose largest extents lie within a factor of 8 to 16;
  /// points by themselves. Valid until the next call.
  std::span<const std::span<const int>> split(std::span<const int> rows,
                                              std::span<const Aabb> boxes);

 private:
  std::vector<int> count_, ordered_, exponent_;
  std::vector<std::span<const int>> groups_;
};

}  // namespace carom::broad
