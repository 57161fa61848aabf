// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "carom/broad/pairs.hpp"

namespace carom::broad {

/// A pair of rows as one number that sorts like it: smaller row << 32 | larger row.
inline std::uint64_t pair_key(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 |
         static_cast<std::uint64_t>(std::max(a, b));
}
inline std::size_t first_row(std::uint64_t key) {
  return static_cast<std::size_t>(key >> 32);
}
inline std::size_t second_row(std::uint64_t key) {
  return static_cast<std::size_t>(key & 0xFFFFFFFFU);
}

/// Sorts keys of rows below `rows`: counted by first row, then each row's few by themselves.
class PairSort {
 public:
  void operator()(std::vector<std::uint64_t>& keys, int rows) {
    count_.assign(static_cast<std::size_t>(rows) + 1, 0);
    for (const std::uint64_t key : keys) ++count_[first_row(key) + 1];
    for (std::size_t r = 1; r < count_.size(); ++r) count_[r] += count_[r - 1];
    sorted_.resize(keys.size());
    for (const std::uint64_t key : keys) sorted_[count_[first_row(key)]++] = key;
    // count_[r] is now the end of row r.
    std::size_t begin = 0;
    for (std::size_t r = 0; r + 1 < count_.size(); ++r) {
      const std::size_t end = count_[r];
      if (end - begin > 1)
        std::sort(sorted_.begin() + static_cast<std::ptrdiff_t>(begin),
                  sorted_.begin() + static_cast<std::ptrdiff_t>(end));
      begin = end;
    }
    keys.swap(sorted_);
  }

 private:
  std::vector<std::size_t> count_;
  std::vector<std::uint64_t> sorted_;
};

/// Merges ascending `more` into ascending `list`, from the back, without other memory.
inline void merge_into(std::vector<std::uint64_t>& list, const std::vector<std::uint64_t>& more) {
  std::size_t a = list.size(), b = more.size();
  list.resize(a + b);
  for (std::size_t to = list.size(); b > 0; --to)
    list[to - 1] = a > 0 && list[a - 1] > more[b - 1] ? list[--a] : more[--b];
}

/// The keys as pairs, ascending.
inline std::vector<BodyPair> sorted_pairs(std::vector<std::uint64_t> keys, int rows) {
  PairSort sort;
  sort(keys, rows);
  std::vector<BodyPair> out;
  out.reserve(keys.size());
  for (const std::uint64_t key : keys)
    out.push_back({static_cast<int>(first_row(key)), static_cast<int>(second_row(key))});
  return out;
}

}  // namespace carom::broad
