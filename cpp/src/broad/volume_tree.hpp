// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "broad/wide_tree.hpp"

namespace carom::broad {

/// Spheres over the children of the wide tree's nodes, in double.
struct SphereChild {
  double centre[3], radius;
};

/// Oriented boxes likewise; rows of `axes` are unit vectors.
struct OrientedBoxChild {
  double axes[3][3], centre[3], half[3];
};

/// Other bounding volumes over the same tree, eight per node. Queries walk them by recursion on the
/// volumes instead of the nodes' boxes; the leaves and their tests are the same.
template <class Child>
class VolumeTree {
 public:
  void fit(const WideTreeView& tree);  ///< about the boxes of the faces below each child

  [[nodiscard]] Nearest raycast(const WideTreeView& tree, const Ray& ray, bool any) const;
  void overlaps(const WideTreeView& tree, const double* box, void* sink, Emit emit) const;
  void closest(const WideTreeView& tree, const double* point, Nearest& best, double* at) const;
  void self_pairs(const WideTreeView& tree, void* sink, Emit emit) const;
  [[nodiscard]] std::size_t memory_bytes() const { return children_.size() * sizeof(Child); }

 private:
  std::vector<Child> children_;  // eight per node
  double lower_[3] = {0, 0, 0}, upper_[3] = {0, 0, 0};
};

extern template class VolumeTree<SphereChild>;
extern template class VolumeTree<OrientedBoxChild>;

}  // namespace carom::broad
