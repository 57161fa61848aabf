// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "carom/geometry/separation.hpp"
#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"
#include "narrow/patch.hpp"
#include "narrow/routines.hpp"
#include "narrow/support_face.hpp"

namespace carom {

void patch_along(const Convex& a, const Convex& b, const Frame& b_in_a, const Separation& s,
                 double margin, std::vector<Manifold>& out) {
  thread_local Face face_a, face_b;
  thread_local std::vector<ContactPoint> points;
  points.clear();
  support_face(a, s.normal, Frame{}, face_a);
  support_face(b, -(b_in_a.rotation.transpose() * s.normal), b_in_a, face_b);
  if (face_a.points.size() > 1 && face_b.points.size() > 1)
    clip(face_a, face_b, s.normal, margin, points);
  // The patch is flat where the bodies are nearly so: the deepest point itself must not be lost.
  double least = std::numeric_limits<double>::infinity(), size = 0;
  for (const ContactPoint& p : points) least = std::min(least, p.separation);
  // Measured by the faces, not by the patch: where two edges cross it is a point.
  for (const Face* face : {&face_a, &face_b})
    for (const Eigen::Vector3d& p : face->points)
      size = std::max(size, (p - face->points[0]).norm());
  if (!(least <= s.distance + tolerance::equally_deep * size))
    points.push_back(
        {0.5 * (s.point_a + s.point_b), s.distance,
         feature::pair(face_a.points.size() == 1 ? face_a.vertex_features[0] : face_a.feature,
                       face_b.points.size() == 1 ? face_b.vertex_features[0] : face_b.feature)});
  reduce(points, s.normal, out.emplace_back());
}

void convex_convex(const Convex& a, const Convex& b, const Frame& b_in_a, double margin,
                   std::vector<Manifold>& out) {
  const Separation s = separation(a, b, b_in_a, margin);
  if (s.status == SeparationStatus::beyond || s.distance > margin) return;
  patch_along(a, b, b_in_a, s, margin, out);
}

void half_space_convex(const Eigen::Vector3d& normal, double offset, const Convex& b,
                       const Frame& b_in_a, double margin, std::vector<Manifold>& out) {
  thread_local Face face;
  thread_local std::vector<ContactPoint> points;
  const Eigen::Vector3d down = -(b_in_a.rotation.transpose() * normal);
  const Eigen::Vector3d tip = b_in_a * b.support(down) - b.radius * normal;
  const double least = normal.dot(tip) - offset;
  if (least > margin) return;
  support_face(b, down, b_in_a, face);
  points.clear();
  const auto add = [&](const Eigen::Vector3d& p, std::uint32_t f) {
    const double gap = normal.dot(p) - offset;
    if (gap <= margin)
      points.push_back({p - 0.5 * gap * normal, gap, feature::pair(feature::face(0), f)});
  };
  double lowest = std::numeric_limits<double>::infinity(), size = 0;
  for (std::size_t i = 0; i < face.points.size(); ++i) {
    add(face.points[i], face.vertex_features[i]);
    lowest = std::min(lowest, normal.dot(face.points[i]) - offset);
    size = std::max(size, (face.points[i] - face.points[0]).norm());
  }
  const bool lone = face.points.size() == 1;  // the deepest itself, but for rounding
  if (!lone && lowest > least + tolerance::equally_deep * size) add(tip, face.feature);
  reduce(points, normal, out.emplace_back());
}

}  // namespace carom
