// SPDX-License-Identifier: Apache-2.0
// Traversal of the wide tree. Included once per CPU level, inside that level's namespace.
//
// Why nothing is lost: a box of a node holds its triangles (rounded outward); the ray's start is
// rounded away from the plane it is compared with, by more than the error of its transform and of
// the test in double; the parameter where the ray enters is scaled down by more than the rounding
// of its two operations, where it leaves up; comparisons are closed. Hits never lie before the
// entry into their own triangle's box (within_box), so the nearest is never culled by a farther
// one.

static constexpr float float_max = std::numeric_limits<float>::max();
static constexpr float float_step = std::numeric_limits<float>::epsilon();  // 2 units of roundoff

// Rounded down and up by at least one unit in the last place, whatever x.
static inline float below(double x) {
  constexpr double rel = 2.0 * std::numeric_limits<float>::epsilon();
  constexpr double tiny = 2.0 * std::numeric_limits<float>::denorm_min();
  if (x > static_cast<double>(float_max)) return float_max;
  const double y = (x - (x < 0 ? -x : x) * rel) - tiny;
  return y < -static_cast<double>(float_max) ? -std::numeric_limits<float>::infinity()
                                             : static_cast<float>(y);
}
static inline float above(double x) {
  return -below(-x);
}

struct NarrowRay {
  // Planes at which the ray enters and leaves each slab: rows of WideNode::bounds.
  int near_row[3], far_row[3];
  float near_start[3], far_start[3], near_rate[3], far_rate[3];
  double entry;  ///< parameter of the shifted start, tree space
  double scale;  ///< tree space per metre

  // Upper bound in tree space of a parameter in metres.
  [[nodiscard]] float limit(double t) const {
    const auto x = static_cast<float>(t * scale - entry);
    return x + (__builtin_fabsf(x) * (2 * float_step) + std::numeric_limits<float>::min());
  }
};

static inline NarrowRay narrow(const Ray& ray, const Frame& frame) {
  NarrowRay out;
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  double start[3], largest = 1;
  for (int k = 0; k < 3; ++k) {
    start[k] = ray.start[k] * frame.scale - frame.shift[k];
    largest = larger(largest, larger(__builtin_fabs(start[k]), __builtin_fabs(frame.shift[k])));
  }
  out.scale = frame.scale;
  out.entry = 0;
  double reach = 0;
  if (largest > 4) {
    // From far away: begin where the ray enters the tree (all of it lies within [-2, 2]).
    for (int k = 0; k < 3; ++k) {
      if (ray.step[k] == 0) continue;
      const double plane = ray.step[k] > 0 ? -2 : 2;
      out.entry = larger(out.entry, (plane - start[k]) / ray.step[k]);
    }
    out.entry = out.entry * (1 - 16 * u);
    if (!(out.entry < std::numeric_limits<double>::max())) out.entry = 0;
    for (int k = 0; k < 3; ++k) {
      start[k] += out.entry * ray.step[k];
    }
    reach = out.entry;
  }
  // Twice the roundings of transform and shift, and those of hit_time in units of the tree.
  const double error = 32 * u * (largest + reach);
  for (int k = 0; k < 3; ++k) {
    const auto back = static_cast<int>(ray.step[k] < 0);  // arithmetic: nothing to guess wrongly
    const auto sign = static_cast<float>(1 - 2 * back);
    out.near_row[k] = k + 3 * back;
    out.far_row[k] = k + 3 * (1 - back);
    // Two units in the last place and more: conversion and this sum lose less than one.
    const auto middle = static_cast<float>(start[k]);
    const float away = sign * (__builtin_fabsf(middle) * (2 * float_step) +
                               (static_cast<float>(error) + std::numeric_limits<float>::min()));
    out.near_start[k] = middle + away;
    out.far_start[k] = middle - away;
    const auto rate = static_cast<float>(__builtin_fabs(1 / ray.step[k]));  // inf for 0 and -0
    float slow = rate * (1 - 4 * float_step);
    slow = slow < float_max ? slow : float_max;
    out.near_rate[k] = sign * slow;
    out.far_rate[k] = sign * (rate * (1 + 4 * float_step));
  }
  return out;
}

// Children entered before `limit`, and where.
static inline unsigned enter(const WideNode& node, const NarrowRay& ray, float limit,
                             float* entries) {
#if defined(__AVX2__)
  __m256 near = _mm256_setzero_ps(), far = _mm256_set1_ps(limit);
  for (int k = 0; k < 3; ++k) {
    const __m256 in = _mm256_load_ps(node.bounds[ray.near_row[k]]);
    const __m256 out = _mm256_load_ps(node.bounds[ray.far_row[k]]);
    // The second operand wins where the first is NaN: 0 times infinity decides nothing.
    near = _mm256_max_ps(_mm256_mul_ps(_mm256_sub_ps(in, _mm256_broadcast_ss(ray.near_start + k)),
                                       _mm256_broadcast_ss(ray.near_rate + k)),
                         near);
    far = _mm256_min_ps(_mm256_mul_ps(_mm256_sub_ps(out, _mm256_broadcast_ss(ray.far_start + k)),
                                      _mm256_broadcast_ss(ray.far_rate + k)),
                        far);
  }
  _mm256_store_ps(entries, near);
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(near, far, _CMP_LE_OQ)));
#else
  unsigned mask = 0;
  for (int i = 0; i < wide; ++i) {
    float near = 0, far = limit;
    for (int k = 0; k < 3; ++k) {
      const float in = (node.bounds[ray.near_row[k]][i] - ray.near_start[k]) * ray.near_rate[k];
      const float out = (node.bounds[ray.far_row[k]][i] - ray.far_start[k]) * ray.far_rate[k];
      near = in > near ? in : near;
      far = out < far ? out : far;
    }
    entries[i] = near;
    mask |= static_cast<unsigned>(near <= far) << i;
  }
  return mask;
#endif
}

static inline void corners(const Leaf& leaf, int i, double (*abc)[3]) {
  for (int v = 0; v < 3; ++v)
    for (int k = 0; k < 3; ++k) abc[v][k] = leaf.corner[v][k][i];
}

// hit_time for the four triangles of a leaf, the same operations in the same order.
static inline unsigned hit_times(const Leaf& leaf, const Ray& ray, double* t) {
#if defined(__AVX2__)
  const __m256d sx = _mm256_broadcast_sd(ray.shear), sy = _mm256_broadcast_sd(ray.shear + 1);
  const __m256d ox = _mm256_broadcast_sd(ray.start + ray.kx);
  const __m256d oy = _mm256_broadcast_sd(ray.start + ray.ky);
  const __m256d oz = _mm256_broadcast_sd(ray.start + ray.kz);
  __m256d x[3], y[3], z[3];
  for (int v = 0; v < 3; ++v) {
    z[v] = _mm256_sub_pd(_mm256_load_pd(leaf.corner[v][ray.kz]), oz);
    x[v] = _mm256_sub_pd(_mm256_sub_pd(_mm256_load_pd(leaf.corner[v][ray.kx]), ox),
                         _mm256_mul_pd(sx, z[v]));
    y[v] = _mm256_sub_pd(_mm256_sub_pd(_mm256_load_pd(leaf.corner[v][ray.ky]), oy),
                         _mm256_mul_pd(sy, z[v]));
  }
  const auto edge = [&](int a, int b) {
    return _mm256_sub_pd(_mm256_mul_pd(x[a], y[b]), _mm256_mul_pd(y[a], x[b]));
  };
  const __m256d u = edge(2, 1), v = edge(0, 2), w = edge(1, 0);
  const __m256d zero = _mm256_setzero_pd();
  const __m256d some_below = _mm256_cmp_pd(_mm256_min_pd(_mm256_min_pd(u, v), w), zero, _CMP_LT_OQ);
  const __m256d some_above = _mm256_cmp_pd(_mm256_max_pd(_mm256_max_pd(u, v), w), zero, _CMP_GT_OQ);
  const __m256d det = _mm256_add_pd(_mm256_add_pd(u, v), w);
  const __m256d in = _mm256_andnot_pd(_mm256_and_pd(some_below, some_above),
                                      _mm256_cmp_pd(det, zero, _CMP_NEQ_OQ));
  const unsigned inside = static_cast<unsigned>(_mm256_movemask_pd(in));
  if (inside == 0) return 0;
  const __m256d depth = _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(u, z[0]), _mm256_mul_pd(v, z[1])),
                                      _mm256_mul_pd(w, z[2]));
  const __m256d time = _mm256_mul_pd(_mm256_div_pd(depth, det), _mm256_broadcast_sd(ray.shear + 2));
  _mm256_store_pd(t, time);
  return inside & static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(time, zero, _CMP_GE_OQ)));
#else
  unsigned mask = 0;
  for (int i = 0; i < leaf_width; ++i) {
    double abc[3][3];
    corners(leaf, i, abc);
    t[i] = hit_time(ray, abc[0], abc[1], abc[2]);
    mask |= static_cast<unsigned>(t[i] >= 0) << i;
  }
  return mask;
#endif
}

static inline void nearest_of_leaf(const Leaf& leaf, const Ray& ray, Nearest& best) {
  alignas(32) double t[leaf_width];
  for (unsigned mask = hit_times(leaf, ray, t); mask != 0; mask &= mask - 1) {
    const int i = __builtin_ctz(mask);
    double abc[3][3];
    corners(leaf, i, abc);
    const double time = within_box(ray, t[i], abc[0], abc[1], abc[2]);
    if (time <= best.t) keep_nearer(best, time, leaf.face[i]);
  }
}

struct Waiting {
  std::uint32_t ref;
  float entry;
};

static inline void prefetch(const WideTreeView& tree, std::uint32_t ref) {
  const char* const at = (ref & leaf_flag) != 0
                             ? reinterpret_cast<const char*>(tree.leaves + (ref & ~leaf_flag))
                             : reinterpret_cast<const char*>(tree.nodes + ref);
  for (int line = 0; line < 4; ++line) __builtin_prefetch(at + 64 * line);
}

static inline Nearest first_hit(const WideTreeView& tree, const Ray& ray) {
  Nearest best{ray.t_max, -1};
  if (tree.root == no_child) return best;
  const NarrowRay fast = narrow(ray, tree.frame);
  float limit = fast.limit(best.t);
  Waiting stack[stack_size];
  int top = 0;
  std::uint32_t ref = tree.root;
  while (true) {
    if ((ref & leaf_flag) != 0) {
      nearest_of_leaf(tree.leaves[ref & ~leaf_flag], ray, best);
      limit = fast.limit(best.t);
    } else {
      const WideNode& node = tree.nodes[ref];
      alignas(32) float entry[wide];
      unsigned mask = enter(node, fast, limit, entry);
      if (mask != 0) {
        int i = __builtin_ctz(mask);
        mask &= mask - 1;
        if (mask == 0) {
          ref = node.child[i];
          continue;
        }
        // The nearest goes on, the others wait, farther ones deeper.
        Waiting next{node.child[i], entry[i]};
        const int floor = top;
        do {
          i = __builtin_ctz(mask);
          mask &= mask - 1;
          Waiting other{node.child[i], entry[i]};
          if (other.entry < next.entry) {
            const Waiting swap = other;
            other = next;
            next = swap;
          }
          int at = top++;
          for (; at > floor && stack[at - 1].entry < other.entry; --at) stack[at] = stack[at - 1];
          stack[at] = other;
          prefetch(tree, other.ref);
        } while (mask != 0);
        ref = next.ref;
        continue;
      }
    }
    do {
      if (top == 0) return best;
      --top;
    } while (stack[top].entry > limit);
    ref = stack[top].ref;
  }
}

static inline bool hits_any(const WideTreeView& tree, const Ray& ray) {
  if (tree.root == no_child) return false;
  const NarrowRay fast = narrow(ray, tree.frame);
  const float limit = fast.limit(ray.t_max);
  std::uint32_t stack[stack_size];
  int top = 0;
  std::uint32_t ref = tree.root;
  while (true) {
    if ((ref & leaf_flag) != 0) {
      Nearest best{ray.t_max, -1};
      nearest_of_leaf(tree.leaves[ref & ~leaf_flag], ray, best);
      if (best.face >= 0) return true;
    } else {
      const WideNode& node = tree.nodes[ref];
      alignas(32) float entry[wide];
      unsigned mask = enter(node, fast, limit, entry);
      if (mask != 0) {
        for (; (mask & (mask - 1)) != 0; mask &= mask - 1) {
          stack[top++] = node.child[__builtin_ctz(mask)];
          prefetch(tree, stack[top - 1]);
        }
        ref = node.child[__builtin_ctz(mask)];
        continue;
      }
    }
    if (top == 0) return false;
    ref = stack[--top];
  }
}

#if defined(__AVX2__)
#include "broad/ray_stream.inl"

// Two rays alone are sooner done than the walkers are set up.
static void raycast(const WideTreeView& tree, const Ray* rays, int count, Nearest* out) {
  if (count <= 2 || tree.root == no_child)
    for (int i = 0; i < count; ++i) out[i] = first_hit(tree, rays[i]);
  else
    walk<false>(tree, rays, count, [&](int i, const Nearest& best) { out[i] = best; });
}

static void any_hit(const WideTreeView& tree, const Ray* rays, int count, std::uint8_t* out) {
  if (count <= 2 || tree.root == no_child)
    for (int i = 0; i < count; ++i) out[i] = static_cast<std::uint8_t>(hits_any(tree, rays[i]));
  else
    walk<true>(tree, rays, count, [&](int i, const Nearest& best) { out[i] = best.face >= 0; });
}
#else
static void raycast(const WideTreeView& tree, const Ray* rays, int count, Nearest* out) {
  for (int i = 0; i < count; ++i) out[i] = first_hit(tree, rays[i]);
}

static void any_hit(const WideTreeView& tree, const Ray* rays, int count, std::uint8_t* out) {
  for (int i = 0; i < count; ++i) out[i] = static_cast<std::uint8_t>(hits_any(tree, rays[i]));
}
#endif

// Lower x, y, z and upper x, y, z of each triangle of a leaf; unused lanes are empty boxes.
static inline void leaf_boxes(const Leaf& leaf, double (*box)[leaf_width]) {
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < leaf_width; ++i) {
      const double a = leaf.corner[0][k][i], b = leaf.corner[1][k][i], c = leaf.corner[2][k][i];
      constexpr double inf = std::numeric_limits<double>::infinity();
      const bool used = leaf.face[i] >= 0;
      box[k][i] = used ? smaller(smaller(a, b), c) : inf;
      box[3 + k][i] = used ? larger(larger(a, b), c) : -inf;
    }
}

static inline unsigned boxes_overlap(const double (*box)[leaf_width], const double* query) {
  unsigned mask = 0;
  for (int i = 0; i < leaf_width; ++i) {
    bool in = true;
    for (int k = 0; k < 3; ++k) in = in & (box[k][i] <= query[3 + k]) & (box[3 + k][i] >= query[k]);
    mask |= static_cast<unsigned>(in) << i;
  }
  return mask;
}

static inline void to_tree(const Frame& frame, const double* box, float* out) {
  for (int k = 0; k < 3; ++k) {
    const double shift = frame.shift[k] < 0 ? -frame.shift[k] : frame.shift[k];
    const double error = 2 * std::numeric_limits<double>::epsilon() * shift;
    out[k] = below(box[k] * frame.scale - frame.shift[k] - error);
    out[3 + k] = above(box[3 + k] * frame.scale - frame.shift[k] + error);
  }
}

static inline unsigned children_overlap(const WideNode& node, const float* box) {
#if defined(__AVX2__)
  __m256 in =
      _mm256_cmp_ps(_mm256_load_ps(node.bounds[0]), _mm256_broadcast_ss(box + 3), _CMP_LE_OQ);
  in = _mm256_and_ps(
      in, _mm256_cmp_ps(_mm256_load_ps(node.bounds[3]), _mm256_broadcast_ss(box), _CMP_GE_OQ));
  for (int k = 1; k < 3; ++k) {
    in = _mm256_and_ps(in, _mm256_cmp_ps(_mm256_load_ps(node.bounds[k]),
                                         _mm256_broadcast_ss(box + 3 + k), _CMP_LE_OQ));
    in = _mm256_and_ps(in, _mm256_cmp_ps(_mm256_load_ps(node.bounds[3 + k]),
                                         _mm256_broadcast_ss(box + k), _CMP_GE_OQ));
  }
  return static_cast<unsigned>(_mm256_movemask_ps(in));
#else
  unsigned mask = 0;
  for (int i = 0; i < wide; ++i) {
    bool in = true;
    for (int k = 0; k < 3; ++k)
      in = in & (node.bounds[k][i] <= box[3 + k]) & (node.bounds[3 + k][i] >= box[k]);
    mask |= static_cast<unsigned>(in) << i;
  }
  return mask;
#endif
}

// Calls visit(index of leaf) for every leaf whose box in some node overlaps `box` (tree space).
template <class Visit>
static inline void leaves_overlapping(const WideTreeView& tree, const float* box, Visit visit) {
  if (tree.root == no_child) return;
  std::uint32_t stack[stack_size];
  int top = 0;
  stack[top++] = tree.root;
  while (top > 0) {
    const std::uint32_t ref = stack[--top];
    if ((ref & leaf_flag) != 0) {
      visit(static_cast<int>(ref & ~leaf_flag));
      continue;
    }
    const WideNode& node = tree.nodes[ref];
    for (unsigned mask = children_overlap(node, box); mask != 0; mask &= mask - 1)
      stack[top++] = node.child[__builtin_ctz(mask)];
  }
}

static void overlaps(const WideTreeView& tree, const double* box, void* sink, Emit emit) {
  float query[6];
  to_tree(tree.frame, box, query);
  std::uint64_t found[256];
  int count = 0;
  leaves_overlapping(tree, query, [&](int index) {
    const Leaf& leaf = tree.leaves[index];
    double boxes[6][leaf_width];
    leaf_boxes(leaf, boxes);
    for (unsigned mask = boxes_overlap(boxes, box); mask != 0; mask &= mask - 1)
      found[count++] = static_cast<std::uint64_t>(leaf.face[__builtin_ctz(mask)]);
    if (count > 256 - leaf_width) emit(sink, found, count), count = 0;
  });
  if (count > 0) emit(sink, found, count);
}

static void self_pairs(const WideTreeView& tree, void* sink, Emit emit) {
  std::uint64_t found[256];
  int count = 0;
  const auto keep = [&](int a, int b) {
    const auto low = static_cast<std::uint64_t>(a < b ? a : b);
    const auto high = static_cast<std::uint64_t>(a < b ? b : a);
    found[count++] = low << 32 | high;
  };
  for (int own = 0; own < tree.leaf_count; ++own) {
    const Leaf& leaf = tree.leaves[own];
    double boxes[6][leaf_width], all[6];
    leaf_boxes(leaf, boxes);
    for (int k = 0; k < 3; ++k) {
      all[k] = smaller(smaller(boxes[k][0], boxes[k][1]), smaller(boxes[k][2], boxes[k][3]));
      all[3 + k] = larger(larger(boxes[3 + k][0], boxes[3 + k][1]),
                          larger(boxes[3 + k][2], boxes[3 + k][3]));
    }
    if (!(all[0] <= all[3])) continue;
    float query[6];
    to_tree(tree.frame, all, query);
    leaves_overlapping(tree, query, [&](int other) {
      if (other < own) return;
      const Leaf& theirs = tree.leaves[other];
      double their_boxes[6][leaf_width];
      leaf_boxes(theirs, their_boxes);
      for (unsigned mask = boxes_overlap(their_boxes, all); mask != 0; mask &= mask - 1) {
        const int j = __builtin_ctz(mask);
        double box[6];
        for (int k = 0; k < 6; ++k) box[k] = their_boxes[k][j];
        unsigned hit = boxes_overlap(boxes, box);
        if (other == own) hit &= ~(~0U << j);
        for (; hit != 0; hit &= hit - 1) keep(leaf.face[__builtin_ctz(hit)], theirs.face[j]);
      }
      if (count > 256 - leaf_width * leaf_width) emit(sink, found, count), count = 0;
    });
  }
  if (count > 0) emit(sink, found, count);
}

// Lower bounds of the distance to each child, tree space.
static inline void distances(const WideNode& node, const float* low, const float* high,
                             float* out) {
  for (int i = 0; i < wide; ++i) {
    float sum = 0;
    for (int k = 0; k < 3; ++k) {
      const float under = node.bounds[k][i] - high[k], over = low[k] - node.bounds[3 + k][i];
      float gap = under > over ? under : over;
      gap = gap > 0 ? gap : 0;
      sum += gap * gap;
    }
    out[i] = sum * (1 - 8 * float_step);
  }
}

static void closest(const WideTreeView& tree, const double* point, Nearest& best, double* at) {
  if (tree.root == no_child) return;
  const double box[6] = {point[0], point[1], point[2], point[0], point[1], point[2]};
  float range[6];
  to_tree(tree.frame, box, range);
  // The error of the computed distance itself: a few roundings of the coordinates' differences.
  double largest = 1;
  for (int k = 0; k < 3; ++k) {
    const double x = point[k] * tree.frame.scale - tree.frame.shift[k];
    const double shift = tree.frame.shift[k] < 0 ? -tree.frame.shift[k] : tree.frame.shift[k];
    largest = larger(largest, larger(x < 0 ? -x : x, shift));
  }
  const double error = 32 * std::numeric_limits<double>::epsilon() * largest;
  for (int k = 0; k < 3; ++k) {
    range[k] = below(static_cast<double>(range[k]) - error);
    range[3 + k] = above(static_cast<double>(range[3 + k]) + error);
  }
  const double scale2 = tree.frame.scale * tree.frame.scale;
  float limit = above(best.t * scale2);
  Waiting stack[stack_size];
  int top = 0;
  std::uint32_t ref = tree.root;
  while (true) {
    if ((ref & leaf_flag) != 0) {
      const Leaf& leaf = tree.leaves[ref & ~leaf_flag];
      for (int i = 0; i < leaf_width && leaf.face[i] >= 0; ++i) {
        double abc[3][3], q[3];
        corners(leaf, i, abc);
        const double d2 = closest_on_triangle(point, abc[0], abc[1], abc[2], q);
        if (d2 < best.t || (d2 == best.t && (best.face < 0 || leaf.face[i] < best.face))) {
          best = {d2, leaf.face[i]};
          for (int k = 0; k < 3; ++k) at[k] = q[k];
        }
      }
      limit = above(best.t * scale2);
    } else {
      const WideNode& node = tree.nodes[ref];
      alignas(32) float distance[wide];
      distances(node, range, range + 3, distance);
      const int floor = top;
      for (int i = 0; i < wide; ++i) {
        if (!(distance[i] <= limit) || node.child[i] == no_child) continue;
        const Waiting other{node.child[i], distance[i]};
        int to = top++;
        for (; to > floor && stack[to - 1].entry < other.entry; --to) stack[to] = stack[to - 1];
        stack[to] = other;
      }
    }
    do {
      if (top == 0) return;
      --top;
    } while (stack[top].entry > limit);
    ref = stack[top].ref;
  }
}

#include "broad/refit.inl"

extern const WideKernels wide_kernels = {build,   refit,    surfaces, extent,    raycast,
                                         any_hit, overlaps, closest,  self_pairs};
