// SPDX-License-Identifier: Apache-2.0
#include "contact/manifold_cache.hpp"

#include <utility>

#include "carom/numerics/tolerance.hpp"

namespace carom::contact {
namespace {

std::array<double, 3> stored(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Eigen::Vector3d loaded(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

void ManifoldCache::begin_step() {
  std::swap(pairs, pairs_before_);
  std::swap(points, points_before_);
  pairs.clear(), points.clear();
  next_ = 0;
}

void ManifoldCache::clear() {
  pairs.clear(), points.clear();
}

bool ManifoldCache::carry(const Pair& before, const Frame& frame_a, const Frame& frame_b,
                          const Eigen::Vector3d& offset, const Eigen::Quaterniond& rotation,
                          double margin, double reach, std::vector<Manifold>& out) {
  const double most = tolerance::recycle_motion * reach;
  if (margin > before.margin + most) return false;
  if ((offset - loaded(before.offset)).squaredNorm() > most * most) return false;
  const Eigen::Quaterniond then(before.rotation[3], before.rotation[0], before.rotation[1],
                                before.rotation[2]);
  // The vector part is half the angle between the two.
  if ((then.conjugate() * rotation).vec().squaredNorm() >
      tolerance::recycle_motion * tolerance::recycle_motion / 4)
    return false;
  int patch = -1;
  for (int k = before.first; k < before.first + before.count; ++k) {
    const Point& p = points_before_[k];
    if (p.patch != patch) {
      patch = p.patch;
      out.emplace_back().normal = frame_a.rotation * loaded(p.normal_a);
    }
    Manifold& m = out.back();
    const Eigen::Vector3d xa = frame_a * loaded(p.on_a), xb = frame_b * loaded(p.on_b);
    m.points[m.count++] = {0.5 * (xa + xb), m.normal.dot(xb - xa), p.feature};
  }
  Pair kept = before;
  kept.first = static_cast<int>(points.size());
  points.insert(points.end(), points_before_.begin() + before.first,
                points_before_.begin() + before.first + before.count);
  pairs.push_back(kept);
  return true;
}

void ManifoldCache::collide(int a, int b, const Placed& in_a, const Placed& in_b, double margin,
                            double reach, std::vector<Manifold>& out) {
  const Frame &frame_a = in_a.frame, &frame_b = in_b.frame;
  // A ball's point does not stay in place when it rolls, and finding it costs less than this.
  if (in_a.is_ball || in_b.is_ball) {
    carom::collide(in_a.shape, frame_a, in_b.shape, frame_b, margin, out);
    return;
  }
  const Eigen::Vector3d offset =
      frame_a.rotation.transpose() * (frame_b.translation - frame_a.translation);
  const Eigen::Quaterniond rotation = in_a.orientation.conjugate() * in_b.orientation;
  while (next_ < pairs_before_.size() &&
         std::pair(pairs_before_[next_].a, pairs_before_[next_].b) < std::pair(a, b))
    ++next_;
  if (next_ < pairs_before_.size() && pairs_before_[next_].a == a && pairs_before_[next_].b == b &&
      carry(pairs_before_[next_], frame_a, frame_b, offset, rotation, margin, reach, out))
    return;

  const std::size_t first_manifold = out.size();
  carom::collide(in_a.shape, frame_a, in_b.shape, frame_b, margin, out);
  Pair pair{a,
            b,
            stored(offset),
            {rotation.x(), rotation.y(), rotation.z(), rotation.w()},
            margin,
            static_cast<int>(points.size()),
            0};
  for (std::size_t i = first_manifold; i < out.size(); ++i) {
    const Manifold& m = out[i];
    for (int k = 0; k < m.count; ++k) {
      const Eigen::Vector3d half = 0.5 * m.points[k].separation * m.normal;
      points.push_back({stored(frame_a.to_local(m.points[k].position - half)),
                        stored(frame_b.to_local(m.points[k].position + half)),
                        stored(frame_a.rotation.transpose() * m.normal), m.points[k].feature,
                        static_cast<int>(i - first_manifold)});
      ++pair.count;
    }
  }
  pairs.push_back(pair);
}

}  // namespace carom::contact
