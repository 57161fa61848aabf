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

/// A ray on its way. A key of a waiting child is the bits of its (positive) entry, the lowest three
/// of which hold its lane: as an integer without them it is a lower bound that orders like the
/// float.
struct alignas(64) Walker {
  NarrowRay fast;
  const Ray* ray;
  Nearest best;
  int limit;          ///< bits of the float, negative before the start
  int top;            ///< one past the next child
  int id;             ///< of the ray
  std::uint32_t ref;  ///< what this turn is about
  int keys[below_stack + stack_size + wide];
  std::uint32_t refs[below_stack + stack_size + wide];
};

enum Turn : unsigned { node_turn, leaf_turn, end_turn, turns };

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

/// Nodes and leaves by the upper bit of a reference: no branch to guess.
struct Places {
  std::uintptr_t base[2], size[2];

  explicit Places(const WideTreeView& tree)
      : base{reinterpret_cast<std::uintptr_t>(tree.nodes),
             reinterpret_cast<std::uintptr_t>(tree.leaves)},
        size{sizeof(WideNode), sizeof(Leaf)} {}

  void fetch(std::uint32_t ref) const {
    const unsigned kind = ref >> 31;
    const auto at = reinterpret_cast<const char*>(base[kind] + (ref & ~leaf_flag) * size[kind]);
    for (int line = 0; line < 4; ++line) __builtin_prefetch(at + 64 * line);
  }
};

// Children entered, the nearest on top.
static inline void push_ordered(const WideNode& node, Walker& w) {
  alignas(32) float entry[wide];
  const unsigned mask = enter(node, w.fast, __builtin_bit_cast(float, w.limit), entry);
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i near = _mm256_load_si256(reinterpret_cast<const __m256i*>(entry));
  const __m256i missed = _mm256_cmpeq_epi32(
      _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(mask)), bit), _mm256_setzero_si256());
  const __m256i key = _mm256_or_si256(_mm256_andnot_si256(_mm256_set1_epi32(7), near), lane);
  const __m256i sorted = descending(_mm256_or_si256(key, missed));
  const __m256i child = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(w.keys + w.top), sorted);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(w.refs + w.top),
                      _mm256_permutevar8x32_epi32(child, sorted));
  w.top += __builtin_popcount(mask);
}

/// Row m: the lanes in the mask m, then any.
struct PackedLanes {
  alignas(64) std::uint8_t of[256][wide];
  constexpr PackedLanes() : of{} {
    for (unsigned mask = 0; mask < 256; ++mask)
      for (unsigned lane = 0, count = 0; lane < wide; ++lane)
        if ((mask >> lane & 1U) != 0) of[mask][count++] = static_cast<std::uint8_t>(lane);
  }
};
static constexpr PackedLanes packed_lanes;

// Children entered, in any order.
static inline void push_any(const WideNode& node, Walker& w) {
  alignas(32) float entry[wide];
  const unsigned mask = enter(node, w.fast, __builtin_bit_cast(float, w.limit), entry);
  const __m256i lanes = _mm256_cvtepu8_epi32(
      _mm_loadl_epi64(reinterpret_cast<const __m128i*>(packed_lanes.of[mask])));
  const __m256i child = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(w.refs + w.top),
                      _mm256_permutevar8x32_epi32(child, lanes));
  w.top += __builtin_popcount(mask);
}

// Waiting children at the top that begin beyond `limit`, at most seven; keys: the upper eight.
static inline int culled(const int* keys, int limit) {
  const __m256i key = _mm256_andnot_si256(
      _mm256_set1_epi32(7), _mm256_loadu_si256(reinterpret_cast<const __m256i*>(keys)));
  const __m256i far = _mm256_cmpgt_epi32(key, _mm256_set1_epi32(limit));
  const auto kept = ~static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(far))) & 0xFFU;
  return __builtin_clz(kept | 1U) - 24;
}

static inline void start(const WideTreeView& tree, const Ray* rays, int id, Walker& w) {
  w.fast = narrow(rays[id], tree.frame);
  w.ray = rays + id;
  w.best = {rays[id].t_max, -1};
  w.limit = __builtin_bit_cast(int, w.fast.limit(w.best.t));
  w.id = id;
  w.top = below_stack + 1;
  w.refs[end_of_stack] = w.refs[below_stack] = tree.root;  // the first is fetched, never followed
  w.keys[below_stack] = std::numeric_limits<int>::min();
}

/// @tparam any the first hit found will do
template <bool any, class Done>
static inline void walk(const WideTreeView& tree, const Ray* rays, int count, Done done) {
  Walker walker[walkers];
  Walker* active[walkers];
  int active_count = 0, next = 0;
  for (; next < count && next < walkers; ++next) {
    Walker& w = walker[next];
    for (int i = 0; i < below_stack; ++i) w.keys[i] = std::numeric_limits<int>::min();
    start(tree, rays, next, w);
    active[active_count++] = &w;
  }
  const Places places(tree);
  while (active_count > 0) {
    Walker* turn[turns][walkers];
    int turn_count[turns] = {0, 0, 0};
    for (int i = 0; i < active_count; ++i) {
      Walker& w = *active[i];
      int at = w.top;
      if constexpr (!any) at -= culled(w.keys + at - 8, w.limit);
      w.top = --at;
      w.ref = w.refs[at];
      const unsigned kind = at == end_of_stack ? end_turn : w.ref >> 31;
      turn[kind][turn_count[kind]++] = &w;
    }
    active_count = 0;
    for (int i = 0; i < turn_count[node_turn]; ++i) {
      Walker& w = *(active[active_count++] = turn[node_turn][i]);
      if constexpr (any)
        push_any(tree.nodes[w.ref], w);
      else
        push_ordered(tree.nodes[w.ref], w);
      places.fetch(w.refs[w.top - 1]);
    }
    for (int i = 0; i < turn_count[leaf_turn]; ++i) {
      Walker& w = *(active[active_count++] = turn[leaf_turn][i]);
      nearest_of_leaf(tree.leaves[w.ref & ~leaf_flag], *w.ray, w.best);
      if constexpr (any)
        w.top = w.best.face >= 0 ? below_stack : w.top;
      else
        w.limit = __builtin_bit_cast(int, w.fast.limit(w.best.t));
      places.fetch(w.refs[w.top - 1]);
    }
    for (int i = 0; i < turn_count[end_turn]; ++i) {
      Walker& w = *turn[end_turn][i];
      done(w.id, w.best);
      if (next == count) continue;
      start(tree, rays, next++, w);
      active[active_count++] = &w;
    }
  }
}
