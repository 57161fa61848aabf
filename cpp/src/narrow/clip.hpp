// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "carom/narrow/contacts.hpp"

namespace carom {

/// Supporting face of one shape: a convex polygon (or a segment, or a point), corners
/// counter-clockwise from outside.
struct Face {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> vertex_features;  ///< one per point
  std::vector<std::uint32_t> edge_features;    ///< of the edge that starts at each point
  std::uint32_t feature = 0;

  void clear() { points.clear(), vertex_features.clear(), edge_features.clear(); }
  void push(const Eigen::Vector3d& p, std::uint32_t vertex, std::uint32_t edge) {
    points.push_back(p);
    vertex_features.push_back(vertex);
    edge_features.push_back(edge);
  }
};

/// Corners of the overlap of two faces seen along `normal` (unit, from a to b), each with the gap
/// between the faces there; those with a gap above `margin` are left out. Appends.
///
/// A corner is a vertex of one over the other or a crossing of two edges, and is named by them: the
/// name does not depend on which shape was taken for reference.
void clip(const Face& a, const Face& b, const Eigen::Vector3d& normal, double margin,
          std::vector<ContactPoint>& out);

}  // namespace carom
