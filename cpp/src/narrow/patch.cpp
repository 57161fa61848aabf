// SPDX-License-Identifier: Apache-2.0
#include "narrow/patch.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

/// Scores of the points, each worked out once: on the stack for as many as a pair of faces has.
class Scores {
 public:
  template <class Score>
  Scores(std::span<const ContactPoint> points, const Score& score) {
    if (points.size() > few_.size()) {
      thread_local std::vector<double> many;
      many.resize(points.size());
      at_ = many.data();
    }
    for (std::size_t i = 0; i < points.size(); ++i) at_[i] = score(points[i]);
  }
  double operator[](std::size_t i) const { return at_[i]; }

 private:
  std::array<double, 16> few_;
  double* at_ = few_.data();
};

/// Index of the largest score; of scores equal to within `slack` the deepest, of those the one with
/// the lowest feature: a choice that rounding cannot turn.
template <class Score>
int best(std::span<const ContactPoint> points, double slack, double depth_slack,
         const Score& score) {
  const Scores scores(points, score);
  double top = -std::numeric_limits<double>::infinity(), depth = -top;
  for (std::size_t i = 0; i < points.size(); ++i) top = std::max(top, scores[i]);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (scores[i] >= top - slack) depth = std::min(depth, points[i].separation);
  int chosen = -1;
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    if (scores[i] >= top - slack && points[i].separation <= depth + depth_slack &&
        (chosen < 0 || points[i].feature < points[chosen].feature))
      chosen = i;
  return chosen;
}

}  // namespace

void reduce(std::span<const ContactPoint> points, const Eigen::Vector3d& normal, Manifold& out) {
  out.normal = normal;
  out.count = 0;
  if (points.size() <= out.points.size()) {
    for (const ContactPoint& p : points) out.points[out.count++] = p;
    return;
  }
  Eigen::Vector3d lower = points[0].position, upper = lower;
  for (const ContactPoint& p : points) {
    lower = lower.cwiseMin(p.position);
    upper = upper.cwiseMax(p.position);
  }
  const double size = (upper - lower).norm(), slack = tolerance::equally_deep * size;
  const auto keep = [&](int i) { out.points[out.count++] = points[i]; };

  double depth = std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : points) depth = std::min(depth, p.separation);
  const Eigen::Vector3d centre = 0.5 * (lower + upper);
  keep(best(points, slack, slack, [&](const ContactPoint& p) {  // of the deepest, the farthest out
    return p.separation <= depth + slack ? (p.position - centre).norm() : -1.0;
  }));
  // What lies higher over the plane counts as so much less far out: of a thin body the upper
  // corners are within reach as well, and would else be taken for the lower ones.
  const auto height = [&](const ContactPoint& p) { return p.separation - depth; };
  const Eigen::Vector3d a = out.points[0].position;
  keep(best(points, slack, slack,
            [&](const ContactPoint& p) { return (p.position - a).norm() - height(p); }));
  const Eigen::Vector3d ab = out.points[1].position - a;
  const double length = ab.norm(), thin = slack * size;
  const auto area = [&](const ContactPoint& p) { return normal.dot(ab.cross(p.position - a)); };
  const auto beside = [&](double side) {
    return [&, side](const ContactPoint& p) { return side * area(p) - length * height(p); };
  };
  const auto to_left = beside(1), to_right = beside(-1);
  const int left = best(points, thin, slack, to_left), right = best(points, thin, slack, to_right);
  if (to_left(points[left]) > thin) keep(left);
  if (to_right(points[right]) > thin) keep(right);
  if (out.count < 4 && out.count > 2) {  // one side only: the corner that adds most to the triangle
    const Eigen::Vector3d c = out.points[2].position;
    const auto outside = [&](const ContactPoint& p) {
      const Eigen::Vector3d b = out.points[1].position;
      const double turn = area(out.points[2]) > 0 ? 1 : -1;
      return std::max(
          turn * normal.dot((p.position - b).cross(c - b)) - (c - b).norm() * height(p),
          turn * normal.dot((p.position - c).cross(a - c)) - (a - c).norm() * height(p));
    };
    const int fourth = best(points, thin, slack, outside);
    if (outside(points[fourth]) > thin) keep(fourth);
  }
}

}  // namespace carom
