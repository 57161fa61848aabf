// SPDX-License-Identifier: Apache-2.0
#include "narrow/candidates.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "narrow/patch.hpp"

namespace carom {

void emit(std::vector<Candidate>& found, double angle, std::vector<Manifold>& out) {
  thread_local std::vector<ContactPoint> group;
  std::ranges::sort(
      found, {}, [](const Candidate& c) { return std::pair(c.point.separation, c.point.feature); });
  while (!found.empty()) {
    const Eigen::Vector3d normal = found.front().normal;
    group.clear();
    std::erase_if(found, [&](const Candidate& c) {
      if (c.normal.dot(normal) < 0 || c.normal.cross(normal).norm() > angle) return false;
      const auto twin = std::ranges::find(group, c.point.feature, &ContactPoint::feature);
      if (twin == group.end()) group.push_back(c.point);
      return true;
    });
    reduce(group, normal, out.emplace_back());
  }
}

void join(std::size_t begin, double angle, std::vector<Manifold>& out) {
  if (out.size() - begin < 2) return;
  thread_local std::vector<Candidate> all;
  all.clear();
  for (std::size_t i = begin; i < out.size(); ++i)
    for (int k = 0; k < out[i].count; ++k) all.push_back({out[i].normal, out[i].points[k]});
  out.resize(begin);
  emit(all, angle, out);
}

}  // namespace carom
