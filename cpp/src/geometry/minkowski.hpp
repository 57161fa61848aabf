// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>

#include "carom/geometry/separation.hpp"

namespace carom::detail {

/// A point of the difference of the two cores, b - a, and the points it came from (frame of a).
struct Vertex {
  Eigen::Vector3d w = Eigen::Vector3d::Zero(), a = w, b = w;
};

struct Difference {
  const Convex &a, &b;
  const Frame& b_in_a;
  mutable int asked = 0;

  /// Farthest point of b - a along -d: the one that bounds the gap along d from above.
  Vertex support(const Eigen::Vector3d& d) const {
    ++asked;
    Vertex v;
    v.a = a.support(d);
    v.b = b_in_a * b.support(-(b_in_a.rotation.transpose() * d));
    v.w = v.b - v.a;
    return v;
  }
  double gap(const Eigen::Vector3d& n) const { return n.dot(support(n).w); }
};

/// What a polyhedral search ends with: gap between the cores along `normal`, and witnesses.
struct Found {
  bool overlap = false, capped = false, beyond = false;
  double distance = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(), a = Eigen::Vector3d::Zero(), b = a;
};

[[nodiscard]] Found gjk(const Difference& difference, double beyond);
[[nodiscard]] Found expand(const Difference& difference);
/// Turns `found.normal` to the nearest largest gap; keeps it where that gains nothing.
void refine(const Difference& difference, Found& found);

}  // namespace carom::detail
