// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "carom/narrow/contacts.hpp"

namespace carom {

/// Up to four of a thing, on the stack: what a face of a box needs.
template <class T>
struct Four {
  std::array<T, 4> items;
  std::size_t count = 0;

  void clear() { count = 0; }
  void resize(std::size_t n) { count = n; }
  void push_back(const T& x) { items[count++] = x; }
  [[nodiscard]] std::size_t size() const { return count; }
  [[nodiscard]] T& operator[](std::size_t i) { return items[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return items[i]; }
};

/// Supporting face of one shape: a convex polygon (or a segment, or a point), corners
/// counter-clockwise from outside.
template <template <class...> class List>
struct FaceOf {
  List<Eigen::Vector3d> points;
  List<std::uint32_t> vertex_features;  ///< one per point
  List<std::uint32_t> edge_features;    ///< of the edge that starts at each point
  std::uint32_t feature = 0;

  void clear() { points.clear(), vertex_features.clear(), edge_features.clear(); }
  void push(const Eigen::Vector3d& p, std::uint32_t vertex, std::uint32_t edge) {
    points.push_back(p);
    vertex_features.push_back(vertex);
    edge_features.push_back(edge);
  }
};
using Face = FaceOf<std::vector>;
using Quad = FaceOf<Four>;

/// Corners of the overlap of two faces seen along `normal` (unit, from a to b), each with the gap
/// between the faces there; those with a gap above `margin` are left out. Appends.
///
/// A corner is a vertex of one over the other or a crossing of two edges, and is named by them: the
/// name does not depend on which shape was taken for reference.
void clip(const Face& a, const Face& b, const Eigen::Vector3d& normal, double margin,
          std::vector<ContactPoint>& out);
void clip(const Quad& a, const Quad& b, const Eigen::Vector3d& normal, double margin,
          std::vector<ContactPoint>& out);

}  // namespace carom
