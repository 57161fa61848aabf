// SPDX-License-Identifier: Apache-2.0
// Binned surface-area builder. Included once per CPU level. Source: Wald 2007, "On fast
// construction of SAH-based bounding volume hierarchies"; children of a wide node as in Embree: the
// child of the largest area is split until there are eight.

using Floats = float __attribute__((vector_size(32)));
using Quad = float __attribute__((vector_size(16)));

static inline Floats least(Floats a, Floats b) {
#if defined(__AVX2__)
  return _mm256_min_ps(a, b);
#else
  return a < b ? a : b;
#endif
}

static inline Floats nothing() {
  constexpr float inf = std::numeric_limits<float>::infinity();
  return Floats{inf, inf, inf, inf, inf, inf, inf, inf};
}

static inline Floats bounds_of(const BuildItem& item) {
  Floats b;
  __builtin_memcpy(&b, item.bounds, sizeof b);
  return b;
}

// Half the surface of (lower, minus upper).
static inline float half_area(Floats b) {
  const float x = -(b[0] + b[4]), y = -(b[1] + b[5]), z = -(b[2] + b[6]);
  return x * (y + z) + y * z;
}

static inline int blocks(int n) {
  return (n + leaf_width - 1) / leaf_width;
}

// Twice the centre and minus it: joins like bounds.
static inline Floats centre_of(Floats b) {
#if defined(__AVX2__)
  const __m128 c = _mm_sub_ps(_mm256_castps256_ps128(b), _mm256_extractf128_ps(b, 1));
  return _mm256_set_m128(_mm_sub_ps(_mm_setzero_ps(), c), c);
#else
  const float x = b[0] - b[4], y = b[1] - b[5], z = b[2] - b[6];
  return Floats{x, y, z, 0, -x, -y, -z, 0};
#endif
}

struct Range {
  int begin, end;
  Floats bounds, centres;
  [[nodiscard]] int size() const { return end - begin; }
};

/// Items with a lower bin along one axis go left.
struct Cut {
  int axis, bin;
  float from, times;

  [[nodiscard]] bool left(const BuildItem& item) const {
    const float centre = item.bounds[axis] - item.bounds[4 + axis];
    return static_cast<int>((centre - from) * times) < bin;
  }
};

// c where it counts, else nothing.
static inline Floats counted(Floats c, bool counts) {
#if defined(__AVX2__)
  const __m256i all = _mm256_set1_epi32(-static_cast<int>(counts));
  return _mm256_blendv_ps(nothing(), c, _mm256_castsi256_ps(all));
#else
  return counts ? c : nothing();
#endif
}

static constexpr int worth_two_sets = 256;  // items

struct Builder {
  BuildTarget& to;
  // Twice: neighbours in the list mostly fall into one bin, whose sum would have to wait for
  // itself.
  Floats bin_bounds[2][3][max_bins];
  int bin_count[3][max_bins];

  // Moves the items to their sides and finds the bounds of the centres of both. Without a branch on
  // the side, which nobody can guess: every item is written to both sides, one of which keeps it.
  void part(const Range& range, const Cut& cut, Range& left, Range& right) {
    BuildItem* const items = to.items;
    BuildItem* const spill = to.spill;
    Floats lc = nothing(), rc = nothing();
    int kept = range.begin, spilled = 0;
    for (int i = range.begin; i < range.end; ++i) {
      const bool goes_left = cut.left(items[i]);
      const Floats item = bounds_of(items[i]), c = centre_of(item);
      __builtin_memcpy(items[kept].bounds, &item, sizeof item);
      __builtin_memcpy(spill[spilled].bounds, &item, sizeof item);
      kept += static_cast<int>(goes_left);
      spilled += static_cast<int>(!goes_left);
      lc = least(lc, counted(c, goes_left));
      rc = least(rc, counted(c, !goes_left));
    }
    __builtin_memcpy(items + kept, spill, static_cast<std::size_t>(spilled) * sizeof(BuildItem));
    left.centres = lc;
    right.centres = rc;
    left.begin = range.begin;
    left.end = right.begin = kept;
    right.end = range.end;
  }

  // The same in place, for more items than there is room to spill.
  void part_in_place(const Range& range, const Cut& cut, Range& left, Range& right) {
    BuildItem* const items = to.items;
    int i = range.begin, j = range.end;
    Floats lc = nothing(), rc = nothing();
    while (true) {
      for (; i < j && cut.left(items[i]); ++i) lc = least(lc, centre_of(bounds_of(items[i])));
      for (; i < j && !cut.left(items[j - 1]); --j)
        rc = least(rc, centre_of(bounds_of(items[j - 1])));
      if (i >= j) break;
      const BuildItem swap = items[i];
      items[i] = items[j - 1];
      items[j - 1] = swap;
    }
    left.centres = lc;
    right.centres = rc;
    left.begin = range.begin;
    left.end = right.begin = i;
    right.end = range.end;
  }

  void gather(Range& side) {
    for (int i = side.begin; i < side.end; ++i) {
      const Floats b = bounds_of(to.items[i]);
      side.bounds = least(side.bounds, b);
      side.centres = least(side.centres, centre_of(b));
    }
  }

  // Halves by order along the widest axis of the centres; equal centres by position.
  void halve(const Range& range, Range& left, Range& right) {
    int axis = 0;
    float widest = -1;
    for (int k = 0; k < 3; ++k) {
      const float extent = -range.centres[4 + k] - range.centres[k];
      if (extent > widest) widest = extent, axis = k;
    }
    BuildItem* const items = to.items;
    const auto key = [&](const BuildItem& item) {
      return item.bounds[axis] - item.bounds[4 + axis];
    };
    // Quickselect for a multiple of the leaf width near the middle.
    const int middle = range.begin + (range.size() / 2 + leaf_width - 1) / leaf_width * leaf_width;
    int low = range.begin, high = range.end - 1;
    while (low < high && widest > 0) {
      const float pivot = key(items[low + (high - low) / 2]);
      int i = low, j = high;
      while (i <= j) {
        while (key(items[i]) < pivot) ++i;
        while (key(items[j]) > pivot) --j;
        if (i <= j) {
          const BuildItem swap = items[i];
          items[i++] = items[j];
          items[j--] = swap;
        }
      }
      if (middle <= j) {
        high = j;
      } else if (middle >= i) {
        low = i;
      } else {
        break;
      }
    }
    left = {range.begin, middle, nothing(), nothing()};
    right = {middle, range.end, nothing(), nothing()};
    gather(left);
    gather(right);
  }

  void split(const Range& range, bool free, Range& left, Range& right) {
    if (!free) return halve(range, left, right);
    const int n = range.size();
    const int bins =
        n < 8 * to.bins ? (to.bins / 2 > 4 + n / 8 ? 4 + n / 8 : to.bins / 2) : to.bins;
    Quad base{}, scale{};
    bool spread = false;
    for (int k = 0; k < 3; ++k) {
      base[k] = range.centres[k];
      const float extent = -range.centres[4 + k] - range.centres[k];
      // Below the smallest normal number the quotient overflows: the axis counts as flat.
      const bool wide_enough = extent > 1e-30F;
      scale[k] = wide_enough ? static_cast<float>(bins) * 0.99999F / extent : 0;
      spread = spread || wide_enough;
    }
    if (!spread) return halve(range, left, right);

    for (int k = 0; k < 3; ++k)
      for (int b = 0; b < bins; ++b) {
        bin_bounds[0][k][b] = nothing();
        bin_count[k][b] = 0;
      }
    const int twice = static_cast<int>(n >= worth_two_sets);
    if (twice != 0) __builtin_memcpy(bin_bounds[1], bin_bounds[0], sizeof bin_bounds[0]);
    for (int i = range.begin; i < range.end; ++i) {
      const Floats b = bounds_of(to.items[i]);
#if defined(__AVX2__)
      const __m128 c = _mm_sub_ps(_mm256_castps256_ps128(b), _mm256_extractf128_ps(b, 1));
      const __m128i at = _mm_cvttps_epi32(_mm_mul_ps(_mm_sub_ps(c, base), scale));
      const int x = _mm_extract_epi32(at, 0), y = _mm_extract_epi32(at, 1),
                z = _mm_extract_epi32(at, 2);
#else
      const Floats c = centre_of(b);
      const int x = static_cast<int>((c[0] - base[0]) * scale[0]);
      const int y = static_cast<int>((c[1] - base[1]) * scale[1]);
      const int z = static_cast<int>((c[2] - base[2]) * scale[2]);
#endif
      Floats(&bounds)[3][max_bins] = bin_bounds[i & twice];
      bounds[0][x] = least(bounds[0][x], b);
      bounds[1][y] = least(bounds[1][y], b);
      bounds[2][z] = least(bounds[2][z], b);
      ++bin_count[0][x];
      ++bin_count[1][y];
      ++bin_count[2][z];
    }

    for (int k = 0; k < 3 && twice != 0; ++k)
      for (int b = 0; b < bins; ++b)
        bin_bounds[0][k][b] = least(bin_bounds[0][k][b], bin_bounds[1][k][b]);

    float best = std::numeric_limits<float>::infinity();
    int best_axis = -1, best_bin = 0;
    for (int k = 0; k < 3; ++k) {
      if (scale[k] == 0) continue;
      float right_cost[max_bins];
      Floats joined = nothing();
      int count = 0;
      for (int b = bins - 1; b > 0; --b) {
        joined = least(joined, bin_bounds[0][k][b]);
        count += bin_count[k][b];
        right_cost[b] = count > 0 ? half_area(joined) * static_cast<float>(blocks(count)) : 0;
      }
      joined = nothing();
      count = 0;
      for (int b = 1; b < bins; ++b) {
        joined = least(joined, bin_bounds[0][k][b - 1]);
        count += bin_count[k][b - 1];
        if (count == 0 || count == n) continue;
        const float cost = half_area(joined) * static_cast<float>(blocks(count)) + right_cost[b];
        if (cost < best) best = cost, best_axis = k, best_bin = b;
      }
    }
    if (best_axis < 0) return halve(range, left, right);
    left.bounds = right.bounds = nothing();
    for (int b = 0; b < bins; ++b) {
      Range& side = b < best_bin ? left : right;
      side.bounds = least(side.bounds, bin_bounds[0][best_axis][b]);
    }
    const Cut cut{best_axis, best_bin, base[best_axis], scale[best_axis]};
    if (n <= to.spill_count)
      part(range, cut, left, right);
    else
      part_in_place(range, cut, left, right);
  }

  std::uint32_t build(const Range& range, int depth) {
    if (range.size() <= leaf_width) {
      to.leaf_begin[to.leaf_count] = range.begin;
      return leaf_flag | static_cast<std::uint32_t>(to.leaf_count++);
    }
    if (to.node_count == to.node_capacity) {
      to.full = true;
      return no_child;
    }
    const int index = to.node_count++;
    Range child[wide];
    float area[wide];
    int count = 1;
    child[0] = range;
    area[0] = half_area(range.bounds);
    while (count < wide) {
      int largest = -1;
      for (int k = 0; k < count; ++k)
        if (child[k].size() > leaf_width && (largest < 0 || area[k] > area[largest])) largest = k;
      if (largest < 0) break;
      Range left, right;
      split(child[largest], depth < depth_of_free_splits, left, right);
      child[largest] = left;
      area[largest] = half_area(left.bounds);
      child[count] = right;
      area[count++] = half_area(right.bounds);
    }
    // In the order of the items, so that leaves are numbered as their items lie.
    for (int k = 1; k < count; ++k)
      for (int j = k; j > 0 && child[j].begin < child[j - 1].begin; --j) {
        const Range swap = child[j];
        child[j] = child[j - 1];
        child[j - 1] = swap;
      }
    for (int k = 0; k < wide; ++k)
      for (int b = 0; b < 6; ++b)
        to.nodes[index].bounds[b][k] =
            k >= count ? (b < 3 ? 1.0F : -1.0F) * std::numeric_limits<float>::infinity()
                       : (b < 3 ? child[k].bounds[b] : -child[k].bounds[b + 1]);
    for (int k = 0; k < wide; ++k) {
      const std::uint32_t ref = k < count && !to.full ? build(child[k], depth + 1) : no_child;
      to.nodes[index].child[k] = ref;
    }
    return static_cast<std::uint32_t>(index);
  }
};

static void build(BuildTarget& target) {
  Range all{0, target.count, nothing(), nothing()};
  for (int i = 0; i < target.count; ++i) {
    const Floats b = bounds_of(target.items[i]);
    all.bounds = least(all.bounds, b);
    all.centres = least(all.centres, centre_of(b));
  }
  target.node_count = target.leaf_count = 0;
  target.full = false;
  Builder builder{target, {}, {}};
  target.root = builder.build(all, 0);
  target.leaf_begin[target.leaf_count] = target.count;
}
