// SPDX-License-Identifier: Apache-2.0
#include "broad/tree_parts.hpp"

#include <algorithm>
#include <utility>

namespace carom::broad {
namespace {

// Choices of speed alone. A part is rebuilt when a ray that meets it must test this much more.
constexpr double spoilt = 1.6;
constexpr int parts_wanted = 64;

double half_area(const WideNode& node, int i) {
  const double x = static_cast<double>(node.bounds[3][i]) - static_cast<double>(node.bounds[0][i]);
  const double y = static_cast<double>(node.bounds[4][i]) - static_cast<double>(node.bounds[1][i]);
  const double z = static_cast<double>(node.bounds[5][i]) - static_cast<double>(node.bounds[2][i]);
  return x * y + y * z + z * x;
}

double area_of_union(const WideNode& node) {
  WideNode all{};
  for (int b = 0; b < 6; ++b)
    all.bounds[b][0] = b < 3 ? *std::min_element(node.bounds[b], node.bounds[b] + wide)
                             : *std::max_element(node.bounds[b], node.bounds[b] + wide);
  return half_area(all, 0);
}

void measure_surfaces(const WideTree& tree, std::uint32_t first, int count,
                      std::vector<double>& out) {
  const int begin = static_cast<int>(first);
  wide_kernels().surfaces(tree.nodes.data(), begin, begin + count, out.data());
}

}  // namespace

// Surface of all children of some nodes against that of the whole, the expected number of children
// a ray enters (surface area heuristic).
double TreeParts::cost_of(const WideTree& tree, std::uint32_t first, int count) const {
  double sum = 0;
  for (std::uint32_t n = first; n < first + static_cast<std::uint32_t>(count); ++n)
    sum += surfaces_[n];
  const double whole = area_of_union(tree.nodes[first]);
  return whole > 0 ? sum / whole : 0;
}

void TreeParts::measure(const WideTree& tree) {
  parts_.clear();
  if (tree.root == no_child || (tree.root & leaf_flag) != 0) return;
  // Sizes of subtrees: children come after their parents, leaves are numbered in order.
  const auto n = static_cast<std::size_t>(tree.node_count);
  surfaces_.resize(n);
  measure_surfaces(tree, 0, tree.node_count, surfaces_);
  std::vector<int> nodes(n, 1), first(n, 0), last(n, 0);
  for (std::size_t k = n; k-- > 0;) {
    const WideNode& node = tree.nodes[k];
    bool seen = false;
    for (const std::uint32_t ref : node.child) {
      if (ref == no_child) continue;
      const bool leaf = (ref & leaf_flag) != 0;
      const int begin = leaf ? static_cast<int>(ref & ~leaf_flag) : first[ref];
      if (!seen) first[k] = begin;
      seen = true;
      last[k] = leaf ? begin + 1 : last[ref];
      nodes[k] += leaf ? 0 : nodes[ref];
    }
  }
  const int most = std::max(tree.leaf_count / parts_wanted, 16);
  std::vector<std::uint32_t> waiting{tree.root};
  double inside = 0;
  while (!waiting.empty()) {
    const std::uint32_t k = waiting.back();
    waiting.pop_back();
    if (last[k] - first[k] <= most || k == tree.root) {
      const double cost = cost_of(tree, k, nodes[k]);
      if (k != tree.root) {
        parts_.push_back({k, nodes[k], first[k], last[k], cost});
        continue;
      }
      inside = cost;
    }
    for (const std::uint32_t ref : tree.nodes[k].child)
      if (ref != no_child && (ref & leaf_flag) == 0) waiting.push_back(ref);
  }
  top_cost_ = inside;
}

int TreeParts::mend(const VertexRef& vertices, const FaceRef& faces, Quality quality,
                    WideTree& tree) {
  if (parts_.empty()) return 0;
  int mended = 0;
  measure_surfaces(tree, 0, tree.node_count, surfaces_);
  for (Part& part : parts_) {
    if (!(cost_of(tree, part.node, part.node_count) > spoilt * part.cost)) continue;
    std::vector<int> ids;
    for (int l = part.leaf_begin; l < part.leaf_end; ++l)
      for (const int face : tree.leaves[static_cast<std::size_t>(l)].face)
        if (face >= 0) ids.push_back(face);
    const WideTree fresh = build_over(
        vertices, faces, build_items(vertices, faces, ids, tree.frame), tree.frame, quality);
    if (fresh.node_count > part.node_count || fresh.leaf_count > part.leaf_end - part.leaf_begin)
      continue;  // no room: left to the whole
    for (int k = 0; k < part.node_count; ++k) {
      WideNode node{};
      std::fill_n(node.child, wide, no_child);
      if (k < fresh.node_count) {
        node = fresh.nodes[static_cast<std::size_t>(k)];
        for (std::uint32_t& ref : node.child)
          if (ref != no_child)
            ref += (ref & leaf_flag) != 0 ? static_cast<std::uint32_t>(part.leaf_begin) : part.node;
      }
      tree.nodes[part.node + static_cast<std::uint32_t>(k)] = node;
    }
    for (int l = 0; l < part.leaf_end - part.leaf_begin; ++l) {
      Leaf leaf{};
      std::fill_n(leaf.face, leaf_width, -1);
      if (l < fresh.leaf_count) leaf = fresh.leaves[static_cast<std::size_t>(l)];
      tree.leaves[static_cast<std::size_t>(part.leaf_begin + l)] = leaf;
    }
    name_corners(faces, part.leaf_begin, part.leaf_end, tree);
    measure_surfaces(tree, part.node, part.node_count, surfaces_);
    part.cost = std::max(part.cost, cost_of(tree, part.node, part.node_count));
    ++mended;
  }
  if (cost_of(tree, tree.root, tree.node_count) > spoilt * top_cost_) {
    tree = build_tree(vertices, faces, quality);
    measure(tree);
    ++mended;
  }
  return mended;
}

}  // namespace carom::broad
