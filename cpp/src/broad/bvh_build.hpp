// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>

#include "carom/broad/bvh.hpp"

#include "broad/page_array.hpp"
#include "broad/wide_tree.hpp"

namespace carom::broad {

/// The arrays of one tree.
struct WideTree {
  PageArray<WideNode> nodes;
  PageArray<Leaf> leaves;
  PageArray<int> corner_ids;  ///< see RefitTarget; empty until the first fit
  int node_count = 0, leaf_count = 0;
  std::uint32_t root = no_child;
  Frame frame;

  [[nodiscard]] WideTreeView view() const {
    return {nodes.data(), leaves.data(), root, leaf_count, frame};
  }
};

using VertexRef = Eigen::Ref<const TriangleMesh::Vertices>;
using FaceRef = Eigen::Ref<const TriangleMesh::Faces>;

Frame frame_of(const VertexRef& vertices);
Frame frame_of_box(const double* low, const double* high);
/// Bounds of some faces for the builder.
PageArray<BuildItem> build_items(const VertexRef& vertices, const FaceRef& faces,
                                 std::span<const int> ids, const Frame& frame);
/// The tree over these items. @param frame theirs
WideTree build_over(const VertexRef& vertices, const FaceRef& faces, PageArray<BuildItem> items,
                    const Frame& frame, Quality quality);
WideTree build_tree(const VertexRef& vertices, const FaceRef& faces, Quality quality);

/// Moves the corners in the leaves and fits all boxes anew, in tree.frame.
void fit(const VertexRef& vertices, const FaceRef& faces, WideTree& tree);
/// Sets corner_ids of leaves [first, last) to what their faces say.
void name_corners(const FaceRef& faces, int first, int last, WideTree& tree);
/// Writes the corners of four faces (-1: none).
void write_leaf(const VertexRef& vertices, const FaceRef& faces, const int* ids, Leaf& leaf);

}  // namespace carom::broad
