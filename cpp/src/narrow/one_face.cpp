// SPDX-License-Identifier: Apache-2.0
#include "narrow/bounds.hpp"
#include "narrow/routines.hpp"

namespace carom {
namespace {

/// The only face whose plane the region crosses; -1 where there are none or several.
int only_face_crossed(const Polytope& p, const Aabb& region) {
  const Eigen::Vector3d centre = region.centre(), half = 0.5 * region.extents();
  int found = -1;
  for (int f = 0; f < p.face_count(); ++f) {
    const Eigen::Vector3d& n = p.normals[f];
    if (n.dot(centre) + n.cwiseAbs().dot(half) < p.offsets[f]) continue;
    if (found >= 0) return -1;
    found = f;
  }
  return found;
}

}  // namespace

bool one_face(const Polytope& a, const Convex& b, std::span<const Eigen::Vector3d> corners,
              const Frame& b_in_a, double margin, std::vector<Manifold>& out) {
  const int f = only_face_crossed(a, bounds_of(b, b_in_a).inflated(margin));
  if (f < 0) return false;
  const Eigen::Vector3d& n = a.normals[f];
  const Eigen::Vector3d down = -(b_in_a.rotation.transpose() * n);
  const Eigen::Vector3d tip = b_in_a * b.support(down) - b.radius * n;
  const double depth = a.offsets[f] - n.dot(tip);
  // A ball of that radius about the deepest point lies in a: no way out is shorter.
  for (int g = 0; g < a.face_count() && depth > 0; ++g)
    if (g != f && a.offsets[g] - a.normals[g].dot(tip) < depth) return false;
  if (corners.empty())
    half_space_convex(n, a.offsets[f], b, b_in_a, margin, out);
  else
    half_space_points(n, a.offsets[f], corners, b_in_a, margin, out);
  return true;
}

}  // namespace carom
