// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/polytope.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include <Eigen/Geometry>

namespace carom {
namespace {

/// Newell's normal: the sum of cross products is right for any planar polygon, collinear corners
/// included.
Eigen::Vector3d newell(const Polytope& p, std::span<const int> loop) {
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = p.vertices[loop[0]];
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    n += (p.vertices[loop[k]] - origin).cross(p.vertices[loop[k + 1]] - origin);
  return n.normalized();
}

}  // namespace

bool finish(Polytope& p) {
  const int faces = static_cast<int>(p.first.size()) - 1;
  p.normals.resize(faces);
  p.offsets.resize(faces);
  p.corner_edges.assign(p.corners.size(), -1);
  p.edges.clear();
  std::unordered_map<std::uint64_t, int> open;  // directed edge to its number
  for (int f = 0; f < faces; ++f) {
    const std::span<const int> loop(p.corners.data() + p.first[f], p.first[f + 1] - p.first[f]);
    if (loop.size() < 3) return false;
    p.normals[f] = newell(p, loop);
    p.offsets[f] = -std::numeric_limits<double>::infinity();
    for (int v : loop) p.offsets[f] = std::max(p.offsets[f], p.normals[f].dot(p.vertices[v]));
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t v0 = loop[k], v1 = loop[(k + 1) % loop.size()];
      const auto twin = open.find(std::uint64_t{v1} << 32 | v0);
      if (twin != open.end()) {
        if (p.edges[twin->second].f1 >= 0) return false;
        p.edges[twin->second].f1 = f;
        p.corner_edges[p.first[f] + k] = twin->second;
      } else {
        const int e = static_cast<int>(p.edges.size());
        if (!open.emplace(std::uint64_t{v0} << 32 | v1, e).second) return false;
        p.corner_edges[p.first[f] + k] = e;
        p.edges.push_back({static_cast<int>(v0), static_cast<int>(v1), f, -1});
      }
    }
  }
  return std::ranges::all_of(p.edges, [](const Polytope::Edge& e) { return e.f1 >= 0; });
}

Polytope box_polytope(const Eigen::Vector3d& extents) {
  Polytope p;
  for (int i = 0; i < 8; ++i)
    p.vertices.emplace_back(0.5 * (i & 1 ? extents.x() : -extents.x()),
                            0.5 * (i & 2 ? extents.y() : -extents.y()),
                            0.5 * (i & 4 ? extents.z() : -extents.z()));
  p.first = {0, 4, 8, 12, 16, 20, 24};
  p.corners = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  (void)finish(p);
  return p;
}

}  // namespace carom
