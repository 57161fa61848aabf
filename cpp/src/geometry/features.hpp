// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace carom::feature {

// A part of one shape in 32 bits: two for its kind, the rest its number.
[[nodiscard]] constexpr std::uint32_t vertex(int i) {
  return static_cast<std::uint32_t>(i) & 0x3fffffffu;
}
[[nodiscard]] constexpr std::uint32_t edge(int i) {
  return 0x40000000u | vertex(i);
}
[[nodiscard]] constexpr std::uint32_t face(int i) {
  return 0x80000000u | vertex(i);
}
/// Of a piece that is curved, or one piece as a whole.
[[nodiscard]] constexpr std::uint32_t curve(int i) {
  return 0xc0000000u | vertex(i);
}

/// Name of two meeting parts: a mix that keeps distinct pairs distinct but for one chance in 2^32.
/// Source of the mixing constants: splitmix64 (public domain, S. Vigna).
[[nodiscard]] constexpr std::uint32_t pair(std::uint32_t of_a, std::uint32_t of_b) {
  std::uint64_t z = (static_cast<std::uint64_t>(of_a) << 32 | of_b) + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32);
}

}  // namespace carom::feature
