// SPDX-License-Identifier: Apache-2.0
#include "carom/broad/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "broad/block_tree.hpp"
#include "broad/pair_keys.hpp"
#include "broad/size_classes.hpp"

namespace carom {
namespace {

using namespace broad;

// Choices of speed alone, measured on drifting boxes and settled piles; no answer depends on them.
constexpr double margin = 0.05;    // of the mean extent, on every side
constexpr double steps_ahead = 4;  // a fat box reaches as far as the last step's motion times this
constexpr double shrunk = 0.5;     // a box this much smaller than when fattened is fattened anew
constexpr int few_escapes = 8;     // one by one below one in this many, together above
constexpr double worn_out = 1.5;   // rebuild when queries strike this much more surface

enum class Kind : std::uint8_t { bounded, unbounded, empty };

Kind kind_of(const Aabb& box) {
  if (box.empty()) return Kind::empty;
  return box.lower.allFinite() && box.upper.allFinite() ? Kind::bounded : Kind::unbounded;
}

void require_no_nan(const Aabb& box, std::size_t row) {
  if (box.lower.hasNaN() || box.upper.hasNaN())
    throw InvalidInput("boxes[" + std::to_string(row) + "]", "NaN", "must be numbers",
                       "a body without a finite state must be frozen before");
}

double half_perimeter(const Aabb& box) {
  return (box.upper - box.lower).sum();
}

bool overlap(const Aabb& a, const Aabb& b) {
  bool in = true;
  for (int k = 0; k < 3; ++k) in = in & (a.lower[k] <= b.upper[k]) & (b.lower[k] <= a.upper[k]);
  return in;
}

}  // namespace

struct BoxTree::Impl {
  struct Place {
    int tree = -1, slot = 0;
  };
  struct Tree {
    BlockTree tree;
    bool moves = false;
    double fresh_cost = 0;
  };

  std::vector<Aabb> tight, fat;
  std::vector<std::uint8_t> moves, escaped_flag;
  std::vector<Kind> kind;
  std::vector<double> least;  // half perimeter below which a fat box is too loose
  std::vector<Place> place;
  std::vector<Tree> trees;
  std::size_t used_trees = 0;
  std::vector<int> unbounded, escaped, rows;
  std::vector<std::uint64_t> candidates, fresh, extra;
  std::vector<BodyPair> pairs;
  PairSort sort;
  SizeClasses classes;
  int moving = 0;
  std::int64_t since_full_pass = 0;
  Counters counters;

  std::span<Tree> used() { return {trees.data(), used_trees}; }
  std::span<const Tree> used() const { return {trees.data(), used_trees}; }

  bool holds(std::size_t r, const Aabb& box) const {
    bool in = true;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      in = in & (fat[r].lower[k] <= box.lower[k]) & (box.lower[k] <= box.upper[k]) &
           (box.upper[k] <= fat[r].upper[k]);
      sum += box.upper[k] - box.lower[k];
    }
    return in & (sum >= least[r]);
  }

  // `step` is the motion since the last update.
  void fatten(std::size_t r, const Aabb& box, const Eigen::Vector3d& step) {
    fat[r] = box;
    const double size = half_perimeter(box);
    least[r] = shrunk * size;
    if (moves[r] == 0) return;
    const double rim = margin / 3 * size;
    for (int k = 0; k < 3; ++k) {
      // One step ahead always; further only while that stays comparable with the box itself.
      const double reach =
          std::max(std::min(steps_ahead * std::abs(step[k]), size), std::abs(step[k]));
      fat[r].lower[k] -= rim + (step[k] < 0 ? reach : 0);
      fat[r].upper[k] += rim + (step[k] > 0 ? reach : 0);
    }
    // Near the end of the range of doubles the margin may overflow; trees hold finite boxes.
    if (!fat[r].lower.allFinite() || !fat[r].upper.allFinite()) fat[r] = box;
  }

  void start(std::span<const Aabb> boxes, std::span<const std::uint8_t> moves_now) {
    const std::size_t n = boxes.size();
    tight.assign(boxes.begin(), boxes.end());
    moves.assign(moves_now.begin(), moves_now.end());
    escaped_flag.assign(n, 0);
    fat.resize(n);
    least.resize(n);
    kind.resize(n);
    unbounded.clear();
    moving = 0;
    for (std::size_t r = 0; r < n; ++r) {
      kind[r] = kind_of(boxes[r]);
      if (kind[r] == Kind::unbounded) unbounded.push_back(static_cast<int>(r));
      if (kind[r] == Kind::bounded) fatten(r, boxes[r], Eigen::Vector3d::Zero());
      moving += static_cast<int>(kind[r] == Kind::bounded && moves[r] != 0);
    }
    build();
    find_candidates();
  }

  void build() {
    ++counters.builds;
    place.assign(tight.size(), {});
    used_trees = 0;
    for (const bool moving_ones : {true, false}) {
      rows.clear();
      for (std::size_t r = 0; r < tight.size(); ++r)
        if (kind[r] == Kind::bounded && (moves[r] != 0) == moving_ones)
          rows.push_back(static_cast<int>(r));
      for (const std::span<const int> group : classes.split(rows, fat)) {
        if (used_trees == trees.size()) trees.emplace_back();
        Tree& t = trees[used_trees];
        t.tree.build(group, fat);
        t.moves = moving_ones;
        t.fresh_cost = t.tree.cost();
        for (std::size_t slot = 0; slot < t.tree.rows().size(); ++slot)
          place[static_cast<std::size_t>(t.tree.rows()[slot])] = {static_cast<int>(used_trees),
                                                                  static_cast<int>(slot)};
        ++used_trees;
      }
    }
  }

  static void append(void* sink, const std::uint64_t* keys, int count) {
    auto& list = *static_cast<std::vector<std::uint64_t>*>(sink);
    list.insert(list.end(), keys, keys + count);
  }

  void find_candidates() {
    ++counters.full_passes;
    since_full_pass = 0;
    candidates.clear();
    const BlockKernels& kernel = block_kernels();
    for (std::size_t a = 0; a < used_trees; ++a) {
      if (!trees[a].moves) continue;  // moving trees come first
      const BlockTreeView one = trees[a].tree.view();
      kernel.self_pairs(one, &candidates, append);
      for (std::size_t b = a + 1; b < used_trees; ++b) {
        const BlockTreeView other = trees[b].tree.view();
        const bool fewer = one.leaves <= other.leaves;
        kernel.cross_pairs(fewer ? one : other, fewer ? other : one, &candidates, append);
      }
    }
    sort(candidates, static_cast<int>(tight.size()));
  }

  // All boxes get new fat ones; the trees keep their order while it serves.
  void full_pass(std::span<const Aabb> boxes) {
    for (std::size_t r = 0; r < boxes.size(); ++r)
      if (kind[r] == Kind::bounded && (moves[r] != 0 || escaped_flag[r] != 0)) {
        fatten(r, boxes[r], boxes[r].centre() - tight[r].centre());
        trees[static_cast<std::size_t>(place[r].tree)].tree.set(place[r].slot, fat[r]);
      }
    bool worn = false;
    for (Tree& t : used()) {
      t.tree.refit();
      worn = worn || t.tree.cost() > worn_out * t.fresh_cost;
    }
    if (worn) build();
    find_candidates();
  }

  void refresh_escaped(std::span<const Aabb> boxes) {
    for (const int row : escaped) {
      const auto r = static_cast<std::size_t>(row);
      fatten(r, boxes[r], boxes[r].centre() - tight[r].centre());
      BlockTree& tree = trees[static_cast<std::size_t>(place[r].tree)].tree;
      tree.set(place[r].slot, fat[r]);
      tree.refit(place[r].slot);
    }
    fresh.clear();
    for (const int row : escaped) {
      const auto r = static_cast<std::size_t>(row);
      const Aabb& box = fat[r];
      const double query[6] = {box.lower[0], box.lower[1], box.lower[2],
                               box.upper[0], box.upper[1], box.upper[2]};
      extra.clear();
      for (const Tree& t : used())
        if (t.moves || moves[r] != 0) block_kernels().query(t.tree.view(), query, &extra, append);
      for (const std::uint64_t key : extra) {
        const int other = static_cast<int>(key);
        // Two that both escaped find each other twice: the smaller row keeps the pair.
        if (other > row || (other < row && escaped_flag[static_cast<std::size_t>(other)] == 0))
          fresh.push_back(pair_key(row, other));
      }
    }
    std::sort(fresh.begin(), fresh.end());
    std::erase_if(candidates, [&](std::uint64_t key) {
      return (escaped_flag[first_row(key)] | escaped_flag[second_row(key)]) != 0;
    });
    merge_into(candidates, fresh);
  }

  // Whether the boxes still lie where the trees think; fills `escaped`. Changes nothing else.
  bool same_kinds(std::span<const Aabb> boxes) {
    escaped.clear();
    bool same = true;
    for (std::size_t r = 0; r < boxes.size(); ++r) {
      if (kind[r] == Kind::bounded && holds(r, boxes[r])) continue;
      require_no_nan(boxes[r], r);
      same = same && kind_of(boxes[r]) == kind[r];
      if (kind[r] == Kind::bounded) escaped.push_back(static_cast<int>(r));
    }
    return same;
  }

  void update(std::span<const Aabb> boxes, std::span<const std::uint8_t> moves_now) {
    const bool same_bodies = boxes.size() == tight.size() &&
                             std::equal(moves_now.begin(), moves_now.end(), moves.begin());
    if (!same_bodies) {
      for (std::size_t r = 0; r < boxes.size(); ++r) require_no_nan(boxes[r], r);
      start(boxes, moves_now);
    } else if (!same_kinds(boxes)) {
      start(boxes, moves_now);
    } else {
      for (const int row : escaped) escaped_flag[static_cast<std::size_t>(row)] = 1;
      const auto count = static_cast<std::int64_t>(escaped.size());
      since_full_pass += count;
      // The second condition lets worn trees be noticed when boxes only ever leave one by one.
      if (count * few_escapes > moving + block_width || since_full_pass > 2 * moving + 64)
        full_pass(boxes);
      else if (count > 0)
        refresh_escaped(boxes);
      counters.refattened += count;
      for (const int row : escaped) escaped_flag[static_cast<std::size_t>(row)] = 0;
      std::copy(boxes.begin(), boxes.end(), tight.begin());
    }
    ++counters.updates;
    counters.candidates = static_cast<std::int64_t>(candidates.size());
    collect();
  }

  // Pairs with an unbounded box: each is tested against all.
  void pairs_of_unbounded() {
    extra.clear();
    for (const int row : unbounded) {
      const auto u = static_cast<std::size_t>(row);
      for (std::size_t r = 0; r < tight.size(); ++r) {
        if (r == u || kind[r] == Kind::empty || (moves[r] | moves[u]) == 0) continue;
        if (kind[r] == Kind::unbounded && r < u) continue;
        if (overlap(tight[u], tight[r])) extra.push_back(pair_key(row, static_cast<int>(r)));
      }
    }
    if (!std::is_sorted(extra.begin(), extra.end())) std::sort(extra.begin(), extra.end());
  }

  void collect() {
    pairs_of_unbounded();
    pairs.clear();
    auto next = extra.begin();
    const auto take = [&](std::uint64_t key) {
      pairs.push_back({static_cast<int>(first_row(key)), static_cast<int>(second_row(key))});
    };
    for (const std::uint64_t key : candidates) {
      if (!overlap(tight[first_row(key)], tight[second_row(key)])) continue;
      while (next != extra.end() && *next < key) take(*next++);
      take(key);
    }
    while (next != extra.end()) take(*next++);
  }
};

BoxTree::BoxTree() : impl_(std::make_unique<Impl>()) {}
BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

std::span<const BodyPair> BoxTree::update(std::span<const Aabb> boxes,
                                          std::span<const std::uint8_t> moves) {
  if (boxes.size() != moves.size())
    throw InvalidInput("moves", std::to_string(moves.size()) + " entries",
                       "must have one per box: " + std::to_string(boxes.size()));
  impl_->update(boxes, moves);
  return impl_->pairs;
}

std::span<const BodyPair> BoxTree::pairs() const {
  return impl_->pairs;
}
int BoxTree::size() const {
  return static_cast<int>(impl_->tight.size());
}
const BoxTree::Counters& BoxTree::counters() const {
  return impl_->counters;
}

void BoxTree::overlaps(const Aabb& box, std::vector<int>& rows) const {
  if (box.lower.hasNaN() || box.upper.hasNaN()) throw InvalidInput("box", "NaN", "must be numbers");
  rows.clear();
  if (box.empty()) return;
  const double query[6] = {box.lower[0], box.lower[1], box.lower[2],
                           box.upper[0], box.upper[1], box.upper[2]};
  const auto take = [](void* sink, const std::uint64_t* keys, int count) {
    auto& list = *static_cast<std::vector<int>*>(sink);
    list.insert(list.end(), keys, keys + count);
  };
  for (const Impl::Tree& t : std::as_const(*impl_).used())
    block_kernels().query(t.tree.view(), query, &rows, take);
  rows.insert(rows.end(), impl_->unbounded.begin(), impl_->unbounded.end());
  std::erase_if(
      rows, [&](int row) { return !overlap(box, impl_->tight[static_cast<std::size_t>(row)]); });
  std::sort(rows.begin(), rows.end());
}

void BoxTree::crossed(const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                      std::vector<int>& rows) const {
  if (!start.allFinite() || !end.allFinite())
    throw InvalidInput("segment", "not finite", "must have finite ends",
                       "cut a ray at the far side of the scene");
  rows.clear();
  Segment segment{.start = {start[0], start[1], start[2]},
                  .step = {},
                  .widening = tolerance::slab_widening,
                  .tiny = std::numeric_limits<double>::min()};
  for (int k = 0; k < 3; ++k) {
    segment.step[k] = end[k] - start[k];
    require_finite(segment.step[k], "segment length", "m");
  }
  const auto take = [](void* sink, const std::uint64_t* keys, int count) {
    auto& list = *static_cast<std::vector<int>*>(sink);
    list.insert(list.end(), keys, keys + count);
  };
  for (const Impl::Tree& t : std::as_const(*impl_).used())
    block_kernels().crossed(t.tree.view(), segment, &rows, take);
  rows.insert(rows.end(), impl_->unbounded.begin(), impl_->unbounded.end());
  std::erase_if(rows, [&](int row) {
    const Aabb& box = impl_->tight[static_cast<std::size_t>(row)];
    const double bounds[6] = {box.lower[0], box.lower[1], box.lower[2],
                              box.upper[0], box.upper[1], box.upper[2]};
    return !may_cross(segment, bounds);
  });
  std::sort(rows.begin(), rows.end());
}

}  // namespace carom
