// SPDX-License-Identifier: Apache-2.0
// Included once per CPU level, inside that level's namespace. Comparisons only: no rounding, so
// every level gives the same answer.

// Local, so that no function compiled for a newer CPU is shared with the rest of the program.
static inline unsigned overlap_mask(const BoxBlock& block, const double* box) {
#if defined(__AVX2__)
  unsigned mask = 0;
  for (int half = 0; half < 2; ++half) {
    __m256d in = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    for (int axis = 0; axis < 3; ++axis) {
      const __m256d lower = _mm256_load_pd(block.bounds[axis] + 4 * half);
      const __m256d upper = _mm256_load_pd(block.bounds[3 + axis] + 4 * half);
      in = _mm256_and_pd(in, _mm256_cmp_pd(lower, _mm256_broadcast_sd(box + 3 + axis), _CMP_LE_OQ));
      in = _mm256_and_pd(in, _mm256_cmp_pd(upper, _mm256_broadcast_sd(box + axis), _CMP_GE_OQ));
    }
    mask |= static_cast<unsigned>(_mm256_movemask_pd(in)) << (4 * half);
  }
  return mask;
#else
  unsigned mask = 0;
  for (int i = 0; i < block_width; ++i) {
    bool in = true;
    for (int axis = 0; axis < 3; ++axis)
      in = in & (block.bounds[axis][i] <= box[3 + axis]) & (block.bounds[3 + axis][i] >= box[axis]);
    mask |= static_cast<unsigned>(in) << i;
  }
  return mask;
#endif
}

static inline void lane(const BoxBlock& block, int i, double* box) {
  for (int k = 0; k < 6; ++k) box[k] = block.bounds[k][i];
}

static void bounds(const BoxBlock& block, double* box) {
  for (int k = 0; k < 6; ++k) {
    const double* const v = block.bounds[k];
    double best[4];
    for (int i = 0; i < 4; ++i)
      best[i] = k < 3 ? (v[i] < v[i + 4] ? v[i] : v[i + 4]) : (v[i] > v[i + 4] ? v[i] : v[i + 4]);
    const double a =
        k < 3 ? (best[0] < best[1] ? best[0] : best[1]) : (best[0] > best[1] ? best[0] : best[1]);
    const double b =
        k < 3 ? (best[2] < best[3] ? best[2] : best[3]) : (best[2] > best[3] ? best[2] : best[3]);
    box[k] = k < 3 ? (a < b ? a : b) : (a > b ? a : b);
  }
}

// Keys gathered before they are handed over, so that the sink is called rarely.
struct Gathered {
  static constexpr int capacity = 1024;
  std::uint64_t keys[capacity];  // not zeroed: that would cost more than a query
  int count = 0;
  void* sink;
  Emit emit;

  Gathered(void* to, Emit by) : sink(to), emit(by) {}

  void pair(int a, int b) {
    const auto low = static_cast<std::uint64_t>(a < b ? a : b);
    const auto high = static_cast<std::uint64_t>(a < b ? b : a);
    keys[count++] = low << 32 | high;
  }
  void make_room() {
    if (count > capacity - block_width * block_width) flush();
  }
  void flush() {
    if (count > 0) emit(sink, keys, count);
    count = 0;
  }
};

static inline unsigned segment_mask(const BoxBlock& block, const Segment& segment) {
  unsigned mask = 0;
  double box[6];
  for (int i = 0; i < block_width; ++i) {
    lane(block, i, box);
    mask |= static_cast<unsigned>(may_cross(segment, box)) << i;
  }
  return mask;
}

// Visits the leaf blocks from `first` on of which `mask_of` leaves some lanes, with these lanes.
template <class Mask, class Visit>
static inline void descend(const BlockTreeView& tree, int first, Mask mask_of, Visit visit) {
  if (first >= tree.leaves) return;  // a root that is a leaf is not skipped below
  struct Node {
    int level, index;
  };
  Node stack[7 * max_levels + 8];
  int top = 0;
  stack[top++] = {tree.levels - 1, 0};
  while (top > 0) {
    const Node node = stack[--top];
    const BoxBlock& block = tree.blocks[tree.level_offset[node.level] + node.index];
    unsigned mask = mask_of(block);
    if (node.level == 0) {
      if (mask != 0) visit(node.index, block, mask);
      continue;
    }
    const int child = node.index * block_width;
    const int skip = (first >> (3 * (node.level - 1))) - child;
    if (skip > 0) mask &= skip < block_width ? ~0U << skip : 0U;
    while (mask != 0) {
      stack[top++] = {node.level - 1, child + __builtin_ctz(mask)};
      mask &= mask - 1;
    }
  }
}

static inline auto overlapping(const double* box) {
  return [box](const BoxBlock& block) { return overlap_mask(block, box); };
}

static inline void pairs_of_blocks(const BoxBlock& a, const int* rows_a, const BoxBlock& b,
                                   const int* rows_b, unsigned mask_b, Gathered& out) {
  out.make_room();
  double box[6];
  for (; mask_b != 0; mask_b &= mask_b - 1) {
    const int j = __builtin_ctz(mask_b);
    lane(b, j, box);
    for (unsigned hit = overlap_mask(a, box); hit != 0; hit &= hit - 1)
      out.pair(rows_a[__builtin_ctz(hit)], rows_b[j]);
  }
}

static void self_pairs(const BlockTreeView& tree, void* sink, Emit emit) {
  Gathered out(sink, emit);
  double box[6];
  for (int leaf = 0; leaf < tree.leaves; ++leaf) {
    const BoxBlock& own = tree.blocks[leaf];
    const int* const own_rows = tree.rows + leaf * block_width;
    out.make_room();
    for (int i = 0; i + 1 < block_width; ++i) {
      lane(own, i, box);
      for (unsigned hit = overlap_mask(own, box) & (~0U << (i + 1)); hit != 0; hit &= hit - 1)
        out.pair(own_rows[i], own_rows[__builtin_ctz(hit)]);
    }
    bounds(own, box);
    descend(tree, leaf + 1, overlapping(box), [&](int other, const BoxBlock& block, unsigned mask) {
      pairs_of_blocks(own, own_rows, block, tree.rows + other * block_width, mask, out);
    });
  }
  out.flush();
}

static void cross_pairs(const BlockTreeView& few, const BlockTreeView& many, void* sink,
                        Emit emit) {
  Gathered out(sink, emit);
  double box[6];
  for (int leaf = 0; leaf < few.leaves; ++leaf) {
    const BoxBlock& own = few.blocks[leaf];
    bounds(own, box);
    descend(many, 0, overlapping(box), [&](int other, const BoxBlock& block, unsigned mask) {
      pairs_of_blocks(own, few.rows + leaf * block_width, block, many.rows + other * block_width,
                      mask, out);
    });
  }
  out.flush();
}

template <class Mask>
static inline void gather_rows(const BlockTreeView& tree, Mask mask_of, void* sink, Emit emit) {
  Gathered out(sink, emit);
  descend(tree, 0, mask_of, [&](int leaf, const BoxBlock&, unsigned mask) {
    out.make_room();
    for (; mask != 0; mask &= mask - 1)
      out.keys[out.count++] =
          static_cast<std::uint64_t>(tree.rows[leaf * block_width + __builtin_ctz(mask)]);
  });
  out.flush();
}

static void query(const BlockTreeView& tree, const double* box, void* sink, Emit emit) {
  gather_rows(tree, overlapping(box), sink, emit);
}

static void crossed(const BlockTreeView& tree, const Segment& segment, void* sink, Emit emit) {
  gather_rows(
      tree, [&](const BoxBlock& block) { return segment_mask(block, segment); }, sink, emit);
}

extern const BlockKernels block_kernels = {self_pairs, cross_pairs, query, crossed, bounds};
