// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "carom/narrow/contacts.hpp"

namespace carom {

/// A contact point with a direction of its own, before points are put together.
struct Candidate {
  Eigen::Vector3d normal;  ///< from a to b
  ContactPoint point;
};

/// Makes manifolds: from the deepest point on, those whose normals lie within `angle` (rad) of its
/// normal join it, and each is cut down to the points that carry it. Empties `found`.
void emit(std::vector<Candidate>& found, double angle, std::vector<Manifold>& out);

/// Joins manifolds of out from `begin` on that share a normal within `angle`.
void join(std::size_t begin, double angle, std::vector<Manifold>& out);

}  // namespace carom
