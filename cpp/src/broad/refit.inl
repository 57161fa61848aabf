// SPDX-License-Identifier: Apache-2.0
// Corners and boxes of a tree whose vertices have moved, in one pass. Included once per CPU level.
//
// Nodes lie before their children, so one walk backwards sees every child before its parent; leaves
// are numbered as the nodes name them, so it runs backwards through the leaves too and touches each
// line of memory once. What it moves is the floor of its time: per leaf 304 bytes written and 48 of
// indices read, per node 256 of each, and the vertices.

// Bounds of a child as BuildItem has them: lower x, y, z, -, minus upper x, y, z, -.
// Rounding outward: see Outward in bvh_build.cpp, of which this makes the same bits.
#if defined(__AVX2__)
static inline __m128 down(__m256d x) {
  const __m128 f = _mm256_cvtpd_ps(x);
  const __m128 size = _mm_andnot_ps(_mm_set1_ps(-0.0F), f);
  return _mm_sub_ps(f, _mm_add_ps(_mm_mul_ps(size, _mm_set1_ps(float_step)),
                                  _mm_set1_ps(std::numeric_limits<float>::min())));
}

struct Refit {
  RefitTarget to;
  __m256d scale, shift;
  __m256i xyz;

  explicit Refit(const RefitTarget& target)
      : to(target),
        scale(_mm256_set1_pd(target.frame.scale)),
        shift(
            _mm256_set_pd(0, target.frame.shift[2], target.frame.shift[1], target.frame.shift[0])),
        xyz(_mm256_set_epi64x(0, -1, -1, -1)) {}

  Floats leaf(std::uint32_t index) const {
    Leaf& out = to.leaves[index];
    const int* const ids = to.corner_ids + std::size_t{corners_of_leaf} * index;
    // Unused lanes name the corners of the first, which leaves the bounds alone, and are set to 0.
    const __m256d used = _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm_cmpgt_epi32(
        _mm_load_si128(reinterpret_cast<const __m128i*>(out.face)), _mm_set1_epi32(-1))));
    __m256d low = _mm256_set1_pd(std::numeric_limits<double>::infinity());
    __m256d high = _mm256_set1_pd(-std::numeric_limits<double>::infinity());
    for (int v = 0; v < 3; ++v) {
      __m256d p[leaf_width];
      for (int i = 0; i < leaf_width; ++i) {
        p[i] = _mm256_maskload_pd(to.vertices + std::ptrdiff_t{3} * ids[leaf_width * v + i], xyz);
        low = _mm256_min_pd(p[i], low);
        high = _mm256_max_pd(p[i], high);
      }
      const __m256d xz01 = _mm256_unpacklo_pd(p[0], p[1]), xz23 = _mm256_unpacklo_pd(p[2], p[3]);
      const __m256d y01 = _mm256_unpackhi_pd(p[0], p[1]), y23 = _mm256_unpackhi_pd(p[2], p[3]);
      double(*const corner)[leaf_width] = out.corner[v];
      _mm256_store_pd(corner[0], _mm256_and_pd(used, _mm256_permute2f128_pd(xz01, xz23, 0x20)));
      _mm256_store_pd(corner[1], _mm256_and_pd(used, _mm256_permute2f128_pd(y01, y23, 0x20)));
      _mm256_store_pd(corner[2], _mm256_and_pd(used, _mm256_permute2f128_pd(xz01, xz23, 0x31)));
    }
    const __m128 f = down(_mm256_sub_pd(_mm256_mul_pd(low, scale), shift));
    const __m128 g = down(_mm256_sub_pd(shift, _mm256_mul_pd(high, scale)));
    return _mm256_set_m128(g, f);
  }

  // The least of each row of lower and of minus upper bounds.
  static Floats all_of(const WideNode& node) {
    const __m256 sign = _mm256_set1_ps(-0.0F);
    const auto row = [&](int b) {
      const __m256 r = _mm256_load_ps(node.bounds[b]);
      return b < 3 ? r : _mm256_xor_ps(r, sign);
    };
    // Pairs of rows, then of pairs: each step halves the lanes of a row and joins two.
    const auto join = [](__m256 a, __m256 b) {
      return _mm256_min_ps(_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
    };
    const __m256 low = join(join(row(0), row(2)), join(row(1), row(1)));
    const __m256 high = join(join(row(3), row(5)), join(row(4), row(4)));
    return _mm256_min_ps(_mm256_permute2f128_ps(low, high, 0x20),
                         _mm256_permute2f128_ps(low, high, 0x31));
  }

  static void store(const Floats (&box)[wide], WideNode& node) {
    __m256 a[wide], b[wide];
    for (int i = 0; i < wide; i += 2) {
      a[i] = _mm256_unpacklo_ps(box[i], box[i + 1]);
      a[i + 1] = _mm256_unpackhi_ps(box[i], box[i + 1]);
    }
    for (int i = 0; i < wide; i += 4)
      for (int k = 0; k < 2; ++k) {
        const __m256d from = _mm256_castps_pd(a[i + k]), with = _mm256_castps_pd(a[i + 2 + k]);
        b[i + 2 * k] = _mm256_castpd_ps(_mm256_unpacklo_pd(from, with));
        b[i + 2 * k + 1] = _mm256_castpd_ps(_mm256_unpackhi_pd(from, with));
      }
    const __m256 sign = _mm256_set1_ps(-0.0F);
    for (int k = 0; k < 3; ++k) {
      _mm256_store_ps(node.bounds[k], _mm256_permute2f128_ps(b[k], b[4 + k], 0x20));
      _mm256_store_ps(node.bounds[3 + k],
                      _mm256_xor_ps(_mm256_permute2f128_ps(b[k], b[4 + k], 0x31), sign));
    }
  }
#else
struct Refit {
  RefitTarget to;

  explicit Refit(const RefitTarget& target) : to(target) {}

  static float down(double x) {
    const auto f = static_cast<float>(x);
    return f - (__builtin_fabsf(f) * float_step + std::numeric_limits<float>::min());
  }

  Floats leaf(std::uint32_t index) const {
    Leaf& out = to.leaves[index];
    const int* const ids = to.corner_ids + std::size_t{corners_of_leaf} * index;
    Floats box{};
    for (int k = 0; k < 3; ++k) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (int v = 0; v < 3; ++v)
        for (int i = 0; i < leaf_width; ++i) {
          const double x = to.vertices[std::ptrdiff_t{3} * ids[leaf_width * v + i] + k];
          low = smaller(x, low);
          high = larger(x, high);
          out.corner[v][k][i] = out.face[i] < 0 ? 0.0 : x;
        }
      box[k] = down(low * to.frame.scale - to.frame.shift[k]);
      box[4 + k] = down(to.frame.shift[k] - high * to.frame.scale);
    }
    return box;
  }

  static Floats all_of(const WideNode& node) {
    Floats box = nothing();
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < wide; ++i) {
        if (node.bounds[k][i] < box[k]) box[k] = node.bounds[k][i];
        if (-node.bounds[3 + k][i] < box[4 + k]) box[4 + k] = -node.bounds[3 + k][i];
      }
    return box;
  }

  static void store(const Floats (&box)[wide], WideNode& node) {
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < wide; ++i) {
        node.bounds[k][i] = box[i][k];
        node.bounds[3 + k][i] = -box[i][4 + k];
      }
  }
#endif

  void node(WideNode& node) const {
    Floats box[wide];
    for (int i = 0; i < wide; ++i) {
      const std::uint32_t ref = node.child[i];
      if (ref == no_child)
        box[i] = nothing();
      else if ((ref & leaf_flag) != 0)
        box[i] = leaf(ref & ~leaf_flag);
      else
        box[i] = all_of(to.nodes[ref]);
    }
    store(box, node);
  }
};

static void refit(const RefitTarget& target) {
  const Refit work(target);
  if (target.root != no_child && (target.root & leaf_flag) != 0)
    (void)work.leaf(target.root & ~leaf_flag);
  for (int index = target.node_count; index-- > 0;) work.node(target.nodes[index]);
}

// Half the surface of each node's children together, for nodes [first, last).
static void surfaces(const WideNode* nodes, int first, int last, double* out) {
  for (int index = first; index < last; ++index) {
    const WideNode& node = nodes[index];
    double sum[wide];
    for (int i = 0; i < wide; ++i) {
      double size[3];
      for (int k = 0; k < 3; ++k)
        size[k] =
            static_cast<double>(node.bounds[3 + k][i]) - static_cast<double>(node.bounds[k][i]);
      const double area = size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
      sum[i] = node.child[i] == no_child ? 0.0 : area;
    }
    out[index] = ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
  }
}

// Least and largest coordinates of `rows` rows; false when one is not finite.
static bool extent(const double* vertices, std::size_t rows, double* low, double* high) {
  // Twelve running extremes, four rows at a time: x, y, z repeat every three of them.
  double least12[12], most12[12], poison[12] = {};
  for (int k = 0; k < 12; ++k) least12[k] = most12[k] = vertices[k % 3];
  std::size_t i = 0;
  for (; i + 4 <= rows; i += 4)
    for (int k = 0; k < 12; ++k) {
      const double x = vertices[3 * i + static_cast<std::size_t>(k)];
      least12[k] = x < least12[k] ? x : least12[k];
      most12[k] = x > most12[k] ? x : most12[k];
      poison[k] += x - x;  // 0 for what is finite, NaN else
    }
  for (; i < rows; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = vertices[3 * i + k];
      least12[k] = x < least12[k] ? x : least12[k];
      most12[k] = x > most12[k] ? x : most12[k];
      poison[k] += x - x;
    }
  bool finite = true;
  for (int k = 0; k < 3; ++k) {
    low[k] = least12[k];
    high[k] = most12[k];
    for (int j = k; j < 12; j += 3) {
      low[k] = smaller(least12[j], low[k]);
      high[k] = larger(most12[j], high[k]);
      finite = finite & (poison[j] == 0);
    }
  }
  return finite;
}
