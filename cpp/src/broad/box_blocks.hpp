// SPDX-License-Identifier: Apache-2.0
#pragma once
// The tree of BoxTree as its kernels see it: raw pointers only, so that one source can be compiled
// for several CPU levels.
#include <cstdint>

namespace carom::broad {

inline constexpr int block_width = 8;

/// Eight boxes, structure of arrays: lower x, y, z then upper x, y, z. Unused lanes hold the empty
/// box, which overlaps nothing.
struct alignas(64) BoxBlock {
  double bounds[6][block_width];
};

/// A complete 8-ary tree without pointers. Blocks of level 0 hold the boxes themselves, in slot
/// order; block k of level l + 1 holds the bounds of blocks 8k .. 8k + 7 of level l.
struct BlockTreeView {
  const BoxBlock* blocks;
  const int* rows;          ///< per slot
  const int* level_offset;  ///< of each level's first block
  int levels;
  int leaves;  ///< blocks of level 0
};

inline constexpr int max_levels = 11;  // 8^11 > 2^31 slots

/// Receives keys (smaller row << 32 | larger row), or rows.
using Emit = void (*)(void* sink, const std::uint64_t* keys, int count);

struct Segment {
  double start[3], step[3];
  double widening;  ///< relative, of the computed parameters
  double tiny;      ///< absolute, where they underflow
};

/// Whether the segment start + t step, t in [0, 1], may cross a box (lower x, y, z, upper x, y, z).
/// The computed intervals of t are widened by their rounding: nothing crossed is left out. Internal
/// linkage: each CPU level has its own.
static inline bool may_cross(const Segment& s, const double* box) {
  double first = 0, last = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double to_lower = box[axis] - s.start[axis], to_upper = box[3 + axis] - s.start[axis];
    if (s.step[axis] == 0) {
      if (!(to_lower <= 0 && to_upper >= 0)) return false;
      continue;
    }
    const double enter = (s.step[axis] > 0 ? to_lower : to_upper) / s.step[axis];
    const double leave = (s.step[axis] > 0 ? to_upper : to_lower) / s.step[axis];
    const double early = enter * (enter > 0 ? 1 - s.widening : 1 + s.widening) - s.tiny;
    const double late = leave * (leave > 0 ? 1 + s.widening : 1 - s.widening) + s.tiny;
    first = early > first ? early : first;
    last = late < last ? late : last;
  }
  return first <= last;
}

struct BlockKernels {
  /// All overlapping pairs within one tree.
  void (*self_pairs)(const BlockTreeView& tree, void* sink, Emit emit);
  /// All overlapping pairs between the boxes of two trees.
  void (*cross_pairs)(const BlockTreeView& few, const BlockTreeView& many, void* sink, Emit emit);
  /// Rows whose box overlaps `box` (lower x, y, z, upper x, y, z).
  void (*query)(const BlockTreeView& tree, const double* box, void* sink, Emit emit);
  /// Rows whose box the segment may cross.
  void (*crossed)(const BlockTreeView& tree, const Segment& segment, void* sink, Emit emit);
  /// Bounds of the eight boxes of a block.
  void (*bounds)(const BoxBlock& block, double* box);
};

namespace portable {
extern const BlockKernels block_kernels;
}
namespace avx2 {
extern const BlockKernels block_kernels;
}

/// The fastest this CPU runs; the answers are the same.
[[nodiscard]] const BlockKernels& block_kernels();

}  // namespace carom::broad
