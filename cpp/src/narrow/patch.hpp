// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "carom/narrow/contacts.hpp"

namespace carom {

/// The four of `points` that carry the patch best: the deepest, the one farthest from it, the one
/// that spans the largest triangle with them and the one farthest out on its other side. All of
/// them where there are no more than four. All share `normal`; frames are the caller's.
void reduce(std::span<const ContactPoint> points, const Eigen::Vector3d& normal, Manifold& out);

/// Seen from the other body.
inline void flip(Manifold& m) {
  m.normal = -m.normal;
}

}  // namespace carom
