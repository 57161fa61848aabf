// SPDX-License-Identifier: Apache-2.0
#include "broad/morton_build.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>
#include <vector>

namespace carom::broad {
namespace {

constexpr int bits = 14;
constexpr int digit = 11;  // 4 passes over 42 bits

struct Keyed {
  std::uint64_t key;
  int item;
};

std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1F00000000FFFFULL;
  x = (x | x << 16) & 0x1F0000FF0000FFULL;
  x = (x | x << 8) & 0x100F00F00F00F00FULL;
  x = (x | x << 4) & 0x10C30C30C30C30C3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

}  // namespace

void sort_by_morton(PageArray<BuildItem>& items) {
  const std::size_t n = items.size();
  float low[3] = {1e30F, 1e30F, 1e30F}, high[3] = {-1e30F, -1e30F, -1e30F};
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      const float c = items[i].bounds[k] - items[i].bounds[4 + k];
      low[k] = std::min(low[k], c);
      high[k] = std::max(high[k], c);
    }
  float scale[3];
  for (int k = 0; k < 3; ++k)
    scale[k] = high[k] - low[k] > 1e-30F ? 16383.0F / (high[k] - low[k]) : 0;
  std::vector<Keyed> keys(n), other(n);
  std::vector<std::uint32_t> count(std::size_t{4} << digit, 0);
  constexpr std::uint64_t mask = (1U << digit) - 1;
  for (std::size_t i = 0; i < n; ++i) {
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) {
      const float c = items[i].bounds[k] - items[i].bounds[4 + k];
      key |= spread(static_cast<std::uint64_t>((c - low[k]) * scale[k])) << (2 - k);
    }
    keys[i] = {key, static_cast<int>(i)};
    for (std::size_t pass = 0; pass < 4; ++pass)
      ++count[(pass << digit) + (key >> (digit * pass) & mask)];
  }
  for (std::size_t pass = 0; pass < 4; ++pass) {
    std::uint32_t* const begin = count.data() + (pass << digit);
    std::uint32_t sum = 0;
    for (std::size_t d = 0; d <= mask; ++d) sum += std::exchange(begin[d], sum);
    for (const Keyed& k : keys) other[begin[k.key >> (digit * pass) & mask]++] = k;
    keys.swap(other);
  }
  PageArray<BuildItem> sorted(n);
  for (std::size_t i = 0; i < n; ++i) {
    BuildItem item = items[static_cast<std::size_t>(keys[i].item)];
    // The high 32 of 42 bits decide all but the last splits; those go by position.
    item.bounds[7] = __builtin_bit_cast(float, static_cast<std::uint32_t>(keys[i].key >> 10));
    sorted[i] = item;
  }
  items = std::move(sorted);
}

void build_sorted(BuildTarget& target) {
  struct Range {
    int begin, end;
  };
  const auto key = [&](int i) {
    return __builtin_bit_cast(std::uint32_t, target.items[i].bounds[7]);
  };
  // Where the highest bit that differs within the range changes; the middle if none does.
  const auto split = [&](Range r, bool free) {
    const std::uint32_t differ = key(r.begin) ^ key(r.end - 1);
    const int half = (r.end - r.begin) / 2;
    const int middle = r.begin + (half + leaf_width - 1) / leaf_width * leaf_width;
    if (differ == 0 || !free) return middle;
    const std::uint32_t bit = std::bit_floor(differ);
    int low = r.begin, high = r.end - 1;
    while (high - low > 1) {
      const int at = low + (high - low) / 2;
      ((key(at) & bit) != 0 ? high : low) = at;
    }
    return high;
  };
  struct Waiting {
    Range range;
    int depth;
    std::uint32_t* ref;
  };
  target.node_count = target.leaf_count = 0;
  target.full = false;
  std::vector<Waiting> waiting{{{0, target.count}, 0, &target.root}};
  while (!waiting.empty()) {
    const Waiting next = waiting.back();
    waiting.pop_back();
    const Range all = next.range;
    if (all.end - all.begin <= leaf_width) {
      target.leaf_begin[target.leaf_count] = all.begin;
      *next.ref = leaf_flag | static_cast<std::uint32_t>(target.leaf_count++);
      continue;
    }
    if (target.node_count == target.node_capacity) {
      target.full = true;
      return;
    }
    *next.ref = static_cast<std::uint32_t>(target.node_count);
    WideNode& node = target.nodes[target.node_count++];
    Range child[wide] = {all};
    int count = 1;
    while (count < wide) {
      const auto longest = std::max_element(
          child, child + count, [](Range a, Range b) { return a.end - a.begin < b.end - b.begin; });
      if (longest->end - longest->begin <= leaf_width) break;
      const int at = split(*longest, next.depth < depth_of_free_splits);
      std::copy_backward(longest + 1, child + count, child + count + 1);
      longest[1] = {at, longest->end};
      longest->end = at;
      ++count;
    }
    for (int k = 0; k < wide; ++k) {
      node.child[k] = no_child;
      for (int b = 0; b < 6; ++b)
        node.bounds[b][k] = (b < 3 ? 1.0F : -1.0F) * std::numeric_limits<float>::infinity();
    }
    // The first child is taken next, so that leaves are numbered as items lie.
    for (int k = count - 1; k >= 0; --k)
      waiting.push_back({child[k], next.depth + 1, &node.child[k]});
  }
  target.leaf_begin[target.leaf_count] = target.count;
}

}  // namespace carom::broad
