// SPDX-License-Identifier: Apache-2.0
#pragma once
// One bounding volume against a ray, a box, a point. All are conservative: each adds `guard` times
// the sizes met, which exceeds the rounding of its few products and sums and of the exact test in
// the leaf.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Eigenvalues>

#include "carom/numerics/tolerance.hpp"

#include "broad/volume_tree.hpp"

namespace carom::broad {

using Corners = std::span<const Eigen::Vector3d>;
inline constexpr double guard = tolerance::volume_guard;
inline constexpr double tiny = tolerance::volume_tiny;

inline double size_of(const double* v) {
  return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}

inline void fit(SphereChild& s, Corners corners) {
  Eigen::Vector3d low = corners.front(), high = low;
  for (const Eigen::Vector3d& p : corners) low = low.cwiseMin(p), high = high.cwiseMax(p);
  Eigen::Vector3d c = 0.5 * low + 0.5 * high;
  // A few steps towards the farthest corner (Badoiu and Clarkson 2003) tighten the box's centre.
  double radius = 0;
  Eigen::Vector3d best = c;
  for (int step = 0; step < 6; ++step) {
    const Eigen::Vector3d* farthest = &corners.front();
    double most = 0;
    for (const Eigen::Vector3d& p : corners)
      if ((p - c).norm() > most) most = (p - c).norm(), farthest = &p;
    if (step == 0 || most < radius) radius = most, best = c;
    c += (*farthest - c) / (step + 3);
  }
  for (int k = 0; k < 3; ++k) s.centre[k] = best[k];
  s.radius = radius + guard * (radius + best.cwiseAbs().sum()) + tiny;
}

/// Whether the ray may enter before `limit`, and the earliest it could.
inline bool may_enter(const SphereChild& s, const Ray& ray, double limit, double& entry) {
  double to[3], along = 0, length2 = 0;
  for (int k = 0; k < 3; ++k) {
    to[k] = s.centre[k] - ray.start[k];
    along += to[k] * ray.step[k];
    length2 += ray.step[k] * ray.step[k];
  }
  const double error = guard * (size_of(to) + size_of(s.centre) + size_of(ray.start));
  const double middle = along / length2;
  const double t = std::clamp(middle, 0.0, limit);
  double gap2 = 0;
  for (int k = 0; k < 3; ++k) {
    const double gap = to[k] - t * ray.step[k];
    gap2 += gap * gap;
  }
  const double reach = s.radius + error;
  if (!(gap2 <= reach * reach * (1 + guard))) return false;
  entry = std::max(0.0, middle - 2 * reach);  // |step| >= 1/2
  return true;
}

inline bool may_overlap(const SphereChild& s, const double* box) {
  double gap2 = 0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max({box[k] - s.centre[k], s.centre[k] - box[3 + k], 0.0});
    gap2 += gap * gap;
  }
  const double reach = s.radius + guard * size_of(s.centre);
  return gap2 <= reach * reach * (1 + guard);
}

inline double least_distance(const SphereChild& s, const double* p) {
  const double to[3] = {s.centre[0] - p[0], s.centre[1] - p[1], s.centre[2] - p[2]};
  const double d = std::sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
  return std::max(0.0, d * (1 - guard) - s.radius - guard * (size_of(s.centre) + size_of(p)));
}

inline void fit(OrientedBoxChild& b, Corners corners) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), low = corners.front(), high = low;
  for (const Eigen::Vector3d& p : corners) {
    mean += p / static_cast<double>(corners.size());
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const double size = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
  for (const Eigen::Vector3d& p : corners) {
    const Eigen::Vector3d d = (p - mean) / size;
    covariance += d * d.transpose();
  }
  const auto span_along = [&](const Eigen::Matrix3d& axes, Eigen::Vector3d& centre,
                              Eigen::Vector3d& half) {
    Eigen::Vector3d a = axes * (corners.front() - mean), z = a;
    for (const Eigen::Vector3d& p : corners) {
      const Eigen::Vector3d q = axes * (p - mean);
      a = a.cwiseMin(q);
      z = z.cwiseMax(q);
    }
    centre = mean + axes.transpose() * (0.5 * (a + z));
    half = 0.5 * (z - a);
    return half[0] * half[1] + half[1] * half[2] + half[2] * half[0];
  };
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Eigen::Matrix3d axes = solver.eigenvectors().transpose();
  Eigen::Vector3d centre, half, straight_centre, straight_half;
  const Eigen::Matrix3d straight = Eigen::Matrix3d::Identity();
  const double surface =
      axes.allFinite() ? span_along(axes, centre, half) : std::numeric_limits<double>::infinity();
  if (!(surface < span_along(straight, straight_centre, straight_half)))
    axes = straight, centre = straight_centre, half = straight_half;
  const double rim = guard * (centre.cwiseAbs().sum() + half.sum()) + tiny;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) b.axes[i][k] = axes(i, k);
    b.centre[i] = centre[i];
    b.half[i] = half[i] + rim;
  }
}

inline bool may_enter(const OrientedBoxChild& b, const Ray& ray, double limit, double& entry) {
  double to[3];
  for (int k = 0; k < 3; ++k) to[k] = ray.start[k] - b.centre[k];
  const double error =
      guard * (size_of(to) + size_of(b.half) + size_of(b.centre) + size_of(ray.start)) + tiny;
  double first = 0, last = limit;
  for (int i = 0; i < 3; ++i) {
    double at = 0, rate = 0;
    for (int k = 0; k < 3; ++k) {
      at += b.axes[i][k] * to[k];
      rate += b.axes[i][k] * ray.step[k];
    }
    const double half = b.half[i] + error;
    // Slower than the error of `rate` matters over the way to the box and through it.
    if (std::abs(rate) <= guard) {
      if (std::abs(at) > half + 4 * error) return false;
      continue;
    }
    const double enter = (-std::copysign(half, rate) - at) / rate;
    const double leave = (std::copysign(half, rate) - at) / rate;
    first = std::max(first, enter - guard * std::abs(enter));
    last = std::min(last, leave + guard * std::abs(leave));
  }
  entry = first;
  return first <= last;
}

inline bool may_overlap(const OrientedBoxChild& b, const double* box) {
  double to[3], half[3];
  for (int k = 0; k < 3; ++k) {
    half[k] = 0.5 * box[3 + k] - 0.5 * box[k];
    to[k] = (0.5 * box[3 + k] + 0.5 * box[k]) - b.centre[k];
  }
  const double error = guard * (size_of(to) + size_of(half) + size_of(b.half) + size_of(b.centre));
  // The face axes of both; the nine edge axes are left out, which can only let more through.
  for (int i = 0; i < 3; ++i) {
    double at = 0, reach = b.half[i] + error, reach_straight = half[i] + error;
    for (int k = 0; k < 3; ++k) {
      at += b.axes[i][k] * to[k];
      reach += std::abs(b.axes[i][k]) * half[k];
      reach_straight += std::abs(b.axes[k][i]) * b.half[k];
    }
    if (std::abs(at) > reach || std::abs(to[i]) > reach_straight) return false;
  }
  return true;
}

inline double least_distance(const OrientedBoxChild& b, const double* p) {
  double to[3], gap2 = 0;
  for (int k = 0; k < 3; ++k) to[k] = p[k] - b.centre[k];
  for (int i = 0; i < 3; ++i) {
    double at = 0;
    for (int k = 0; k < 3; ++k) at += b.axes[i][k] * to[k];
    const double gap = std::max(0.0, std::abs(at) - b.half[i]);
    gap2 += gap * gap;
  }
  const double error = guard * (size_of(to) + size_of(b.centre) + size_of(p));
  return std::max(0.0, std::sqrt(gap2) - error);
}

}  // namespace carom::broad
