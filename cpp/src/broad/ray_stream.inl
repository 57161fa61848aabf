// SPDX-License-Identifier: Apache-2.0
// Many rays through one tree at a time. Included by wide_tree.inl where AVX2 is there.
//
// A ray alone waits: for its next node (from a farther cache) and, at every node, for the
// processor's wrong guess of how many children are entered and in which order. So `walkers` rays go
// in turns. One turn pops a child of every ray and sorts the rays by what it is (node, leaf, end);
// each kind is then worked off in a loop of its own. Nothing but the length of these loops has to
// be guessed: children are ordered by a sorting network, culled by one comparison of eight waiting
// entries, and fetched a whole round before they are needed. The answers are those of a ray alone,
// since no test of a triangle depends on the order.

static constexpr int walkers = 16;
static constexpr int below_stack = 8;  // room for eight keys to be read below the lowest
static constexpr int end_of_stack = below_stack - 1;

/// Waiting children. A key is the bits of the (positive) entry, the lowest three of which hold the
/// child's lane: as an integer without them it is a lower bound that orders like the float.
struct WaitingList {
  int keys[below_stack + stack_size + wide];
  std::uint32_t refs[below_stack + stack_size + wide];
};

struct Walker {
  NarrowRay fast;
  const Ray* ray;
  Nearest best;
  int limit;  ///< bits of the float, negative before the start
  int top;    ///< one past the next child
  int id;
};

struct RayStream {
  Walker walker[walkers];
  WaitingList waiting[walkers];
};

enum Turn : unsigned { node_turn, leaf_turn, end_turn, turns };

struct Round {
  int of[turns][walkers];
  int count[turns] = {0, 0, 0};
  std::uint32_t ref[walkers];
};

// Larger keys first, by the bitonic network.
static inline __m256i descending(__m256i v) {
  const auto order = [](__m256i x, __m256i partner, auto larger_there) {
    constexpr int mask = decltype(larger_there)::value;
    return _mm256_blend_epi32(_mm256_min_epi32(x, partner), _mm256_max_epi32(x, partner), mask);
  };
  using In = std::integral_constant<int, 0x55>;   // lanes whose partner is one further
  using Two = std::integral_constant<int, 0x33>;  // two further
  v = order(v, _mm256_shuffle_epi32(v, 0xB1), In{});
  v = order(v, _mm256_shuffle_epi32(v, 0x1B), Two{});
  v = order(v, _mm256_shuffle_epi32(v, 0xB1), In{});
  v = order(v, _mm256_shuffle_epi32(_mm256_permute2x128_si256(v, v, 1), 0x1B),
            std::integral_constant<int, 0x0F>{});
  v = order(v, _mm256_shuffle_epi32(v, 0x4E), Two{});
  return order(v, _mm256_shuffle_epi32(v, 0xB1), In{});
}

static inline void prefetch_next(const WideTreeView& tree, std::uint32_t ref) {
  const std::uintptr_t leaf = ref >> 31;
  const std::uintptr_t from = leaf != 0 ? reinterpret_cast<std::uintptr_t>(tree.leaves)
                                        : reinterpret_cast<std::uintptr_t>(tree.nodes);
  const std::uintptr_t size = leaf != 0 ? sizeof(Leaf) : sizeof(WideNode);
  const char* const at = reinterpret_cast<const char*>(from + (ref & ~leaf_flag) * size);
  for (int line = 0; line < 4; ++line) __builtin_prefetch(at + 64 * line);
}

// Children entered, the nearest on top of the list; `list` is its top.
static inline int push_entered(const WideNode& node, const NarrowRay& ray, int limit, int* keys,
                               std::uint32_t* refs) {
  alignas(32) float entry[wide];
  const unsigned mask = enter(node, ray, __builtin_bit_cast(float, limit), entry);
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i near = _mm256_load_si256(reinterpret_cast<const __m256i*>(entry));
  const __m256i missed = _mm256_cmpeq_epi32(
      _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(mask)), bit), _mm256_setzero_si256());
  const __m256i key = _mm256_or_si256(_mm256_andnot_si256(_mm256_set1_epi32(7), near), lane);
  const __m256i sorted = descending(_mm256_or_si256(key, missed));
  const __m256i child = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(keys), sorted);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(refs),
                      _mm256_permutevar8x32_epi32(child, sorted));
  return __builtin_popcount(mask);
}

// Waiting children at the top that begin beyond `limit`, at most seven; keys: the upper eight.
static inline int culled(const int* keys, int limit) {
  const __m256i key = _mm256_andnot_si256(
      _mm256_set1_epi32(7), _mm256_loadu_si256(reinterpret_cast<const __m256i*>(keys)));
  const __m256i far = _mm256_cmpgt_epi32(key, _mm256_set1_epi32(limit));
  const auto kept = ~static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(far))) & 0xFFU;
  return __builtin_clz(kept | 1U) - 24;
}

static inline void start(const WideTreeView& tree, const Ray* rays, int id, Walker& w,
                         WaitingList& waiting) {
  w.fast = narrow(rays[id], tree.frame);
  w.ray = rays + id;
  w.best = {rays[id].t_max, -1};
  w.limit = __builtin_bit_cast(int, w.fast.limit(w.best.t));
  w.id = id;
  w.top = below_stack + 1;
  waiting.refs[end_of_stack] = tree.root;  // never followed, but may be fetched
  waiting.refs[below_stack] = tree.root;
  waiting.keys[below_stack] = std::numeric_limits<int>::min();
}

/// @tparam any the first hit found will do
template <bool any, class Done>
static inline void walk(const WideTreeView& tree, const Ray* rays, int count, Done done) {
  RayStream s;
  int active[walkers], active_count = 0, next = 0;
  for (; next < count && active_count < walkers; ++next) {
    for (int i = 0; i < below_stack; ++i)
      s.waiting[next].keys[i] = std::numeric_limits<int>::min();
    start(tree, rays, next, s.walker[next], s.waiting[next]);
    active[active_count++] = next;
  }
  while (active_count > 0) {
    Round round;
    for (int i = 0; i < active_count; ++i) {
      const int at = active[i];
      Walker& w = s.walker[at];
      const WaitingList& waiting = s.waiting[at];
      if constexpr (!any) w.top -= culled(waiting.keys + w.top - 8, w.limit);
      const int taken = --w.top;
      const std::uint32_t ref = waiting.refs[taken];
      round.ref[at] = ref;
      const unsigned turn = taken == end_of_stack ? end_turn : ref >> 31;
      round.of[turn][round.count[turn]++] = at;
    }
    active_count = 0;
    for (int i = 0; i < round.count[node_turn]; ++i) {
      const int at = active[active_count++] = round.of[node_turn][i];
      Walker& w = s.walker[at];
      WaitingList& waiting = s.waiting[at];
      w.top += push_entered(tree.nodes[round.ref[at]], w.fast, w.limit, waiting.keys + w.top,
                            waiting.refs + w.top);
      prefetch_next(tree, waiting.refs[w.top - 1]);
    }
    for (int i = 0; i < round.count[leaf_turn]; ++i) {
      const int at = active[active_count++] = round.of[leaf_turn][i];
      Walker& w = s.walker[at];
      nearest_of_leaf(tree.leaves[round.ref[at] & ~leaf_flag], *w.ray, w.best);
      if constexpr (any) {
        w.top = w.best.face >= 0 ? below_stack : w.top;
      } else {
        w.limit = __builtin_bit_cast(int, w.fast.limit(w.best.t));
      }
      prefetch_next(tree, s.waiting[at].refs[w.top - 1]);
    }
    for (int i = 0; i < round.count[end_turn]; ++i) {
      const int at = round.of[end_turn][i];
      done(s.walker[at].id, s.walker[at].best);
      if (next == count) continue;
      start(tree, rays, next++, s.walker[at], s.waiting[at]);
      active[active_count++] = at;
    }
  }
}
