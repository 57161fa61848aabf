// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::broad {

using Cell = std::array<int, 3>;  // each in [0, 2^20]

/// Lists of faces by cell, hashed on (i, j, k) with open addressing; filled in two passes so that
/// all lists lie in one array.
class CellTable {
 public:
  void reserve(std::size_t cells) { grow(std::bit_ceil(2 * cells + 16)); }
  void count(const Cell& c) {
    Slot& slot = find_or_add(key(c));
    ++slot.count;
    ++entries_;
  }
  void finish_counting() {
    std::uint32_t begin = 0;
    for (Slot& slot : slots_) {
      slot.begin = begin;
      begin += slot.count;
      slot.count = 0;
    }
    faces_.resize(entries_);
  }
  void put(const Cell& c, int face) {
    Slot& slot = find_or_add(key(c));
    faces_[slot.begin + slot.count++] = face;
  }
  void finish() { faces_.shrink_to_fit(); }

  [[nodiscard]] std::span<const int> faces(const Cell& c) const {
    const std::uint64_t wanted = key(c);
    for (std::size_t at = home(wanted);; at = (at + 1) & mask_) {
      const Slot& slot = slots_[at];
      if (slot.key == wanted) return {faces_.data() + slot.begin, slot.count};
      if (slot.key == none) return {};
    }
  }
  template <class Visit>
  void for_each(Visit visit) const {
    constexpr std::uint64_t low = (std::uint64_t{1} << 21) - 1;
    for (const Slot& slot : slots_)
      if (slot.key != none)
        visit(Cell{static_cast<int>(slot.key & low), static_cast<int>(slot.key >> 21 & low),
                   static_cast<int>(slot.key >> 42)},
              std::span<const int>(faces_.data() + slot.begin, slot.count));
  }

  [[nodiscard]] std::size_t cells() const { return used_; }
  [[nodiscard]] std::size_t entries() const { return entries_; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return slots_.size() * sizeof(Slot) + faces_.size() * sizeof(int);
  }

 private:
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t key = none;
    std::uint32_t begin = 0, count = 0;
  };

  static std::uint64_t key(const Cell& c) {
    return static_cast<std::uint64_t>(c[0]) | static_cast<std::uint64_t>(c[1]) << 21 |
           static_cast<std::uint64_t>(c[2]) << 42;
  }
  // Multiplication by 2^64 over the golden ratio, the high bits: neighbours scatter.
  [[nodiscard]] std::size_t home(std::uint64_t k) const {
    return static_cast<std::size_t>(((k ^ k >> 32) * 0x9E3779B97F4A7C15ULL) >> shift_);
  }
  Slot& find_or_add(std::uint64_t k) {
    if (2 * used_ >= slots_.size()) grow(2 * slots_.size());
    std::size_t at = home(k);
    while (slots_[at].key != none && slots_[at].key != k) at = (at + 1) & mask_;
    if (slots_[at].key == none) {
      slots_[at].key = k;
      ++used_;
    }
    return slots_[at];
  }
  void grow(std::size_t size) {
    std::vector<Slot> old(size);
    old.swap(slots_);
    mask_ = size - 1;
    shift_ = 64 - std::countr_zero(size);
    for (const Slot& slot : old) {
      if (slot.key == none) continue;
      std::size_t at = home(slot.key);
      while (slots_[at].key != none) at = (at + 1) & mask_;
      slots_[at] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::vector<int> faces_;
  std::size_t mask_ = 0, used_ = 0, entries_ = 0;
  int shift_ = 0;
};

}  // namespace carom::broad
