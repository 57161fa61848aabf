// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "broad/bvh_build.hpp"

namespace carom::broad {

/// Notices which parts of a tree a refit has spoilt, and builds those anew.
class TreeParts {
 public:
  [[nodiscard]] bool empty() const { return parts_.empty(); }
  /// Chooses the parts of a fresh tree and remembers how well they bound.
  void measure(const WideTree& tree);
  /// @returns the number of parts rebuilt; a tree spoilt as a whole counts as one
  int mend(const VertexRef& vertices, const FaceRef& faces, Quality quality, WideTree& tree);

 private:
  struct Part {
    std::uint32_t node;
    int node_count, leaf_begin, leaf_end;
    double cost;
  };
  [[nodiscard]] double cost_of(const WideTree& tree, std::uint32_t first, int count) const;

  std::vector<Part> parts_;
  std::vector<double> surfaces_;  // of each node's children, see WideKernels
  double top_cost_ = 0;
};

}  // namespace carom::broad
