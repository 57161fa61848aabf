// SPDX-License-Identifier: Apache-2.0
#include "broad/bvh_build.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "broad/morton_build.hpp"

namespace carom::broad {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

// x scale is exact, the difference from the shift off by half a unit of its double, its conversion
// by half a unit of the single: one whole unit of the result, or the smallest number, covers them.
struct Outward {
  double scale, shift[3];
  explicit Outward(const Frame& frame)
      : scale(frame.scale), shift{frame.shift[0], frame.shift[1], frame.shift[2]} {}

  [[nodiscard]] float low(double x, int axis) const {
    const auto f = static_cast<float>(x * scale - shift[axis]);
    return f - (std::abs(f) * std::numeric_limits<float>::epsilon() +
                std::numeric_limits<float>::min());
  }
  [[nodiscard]] float high(double x, int axis) const { return -mirrored(x, axis); }

 private:
  [[nodiscard]] float mirrored(double x, int axis) const {
    const auto f = static_cast<float>(shift[axis] - x * scale);
    return f - (std::abs(f) * std::numeric_limits<float>::epsilon() +
                std::numeric_limits<float>::min());
  }
};

void fill_item(const VertexRef& vertices, const FaceRef& faces, int face, const Outward& outward,
               BuildItem& item) {
  const double* const a = vertices.data() + 3 * std::ptrdiff_t{faces(face, 0)};
  const double* const b = vertices.data() + 3 * std::ptrdiff_t{faces(face, 1)};
  const double* const c = vertices.data() + 3 * std::ptrdiff_t{faces(face, 2)};
  for (int k = 0; k < 3; ++k) {
    item.bounds[k] = outward.low(smaller(smaller(a[k], b[k]), c[k]), k);
    item.bounds[4 + k] = -outward.high(larger(larger(a[k], b[k]), c[k]), k);
  }
  item.bounds[3] = __builtin_bit_cast(float, face);
  item.bounds[7] = 0;
}

}  // namespace

Frame frame_of(const VertexRef& vertices) {
  double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  if (vertices.rows() > 0)
    (void)wide_kernels().extent(vertices.data(), static_cast<std::size_t>(vertices.rows()), low,
                                high);
  return frame_of_box(low, high);
}

Frame frame_of_box(const double* low, const double* high) {
  Frame frame;
  double half = 0;
  for (int k = 0; k < 3; ++k) half = larger(half, 0.5 * high[k] - 0.5 * low[k]);
  int exponent = 0;
  std::frexp(half, &exponent);
  // Beyond this range the scaled numbers themselves would leave that of doubles.
  exponent = half == 0 ? 0 : std::clamp(exponent, -900, 1000);
  frame.scale = std::scalbn(1.0, -exponent);
  for (int k = 0; k < 3; ++k) frame.shift[k] = (0.5 * low[k] + 0.5 * high[k]) * frame.scale;
  return frame;
}

void write_leaf(const VertexRef& vertices, const FaceRef& faces, const int* ids, Leaf& leaf) {
  for (int i = 0; i < leaf_width; ++i) {
    leaf.face[i] = ids[i];
    for (int v = 0; v < 3; ++v) {
      const double* const p =
          ids[i] < 0 ? nullptr : vertices.data() + 3 * std::ptrdiff_t{faces(ids[i], v)};
      for (int k = 0; k < 3; ++k) leaf.corner[v][k][i] = p == nullptr ? 0.0 : p[k];
    }
  }
}

PageArray<BuildItem> build_items(const VertexRef& vertices, const FaceRef& faces,
                                 std::span<const int> ids, const Frame& frame) {
  const Outward outward(frame);
  PageArray<BuildItem> items(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
    fill_item(vertices, faces, ids[i], outward, items[i]);
  return items;
}

namespace {

// Leaves of the items in their order; sets the leaf count.
void fill_leaves(const VertexRef& vertices, const FaceRef& faces, const PageArray<BuildItem>& items,
                 const int* leaf_begin, WideTree& tree) {
  tree.leaves = PageArray<Leaf>(static_cast<std::size_t>(tree.leaf_count));
  for (int l = 0; l < tree.leaf_count; ++l) {
    int ids[leaf_width];
    for (int i = 0; i < leaf_width; ++i) {
      const int at = leaf_begin[l] + i;
      ids[i] = at < leaf_begin[l + 1] ? items[static_cast<std::size_t>(at)].index() : -1;
    }
    write_leaf(vertices, faces, ids, tree.leaves[static_cast<std::size_t>(l)]);
  }
}

}  // namespace

WideTree build_over(const VertexRef& vertices, const FaceRef& faces, PageArray<BuildItem> items,
                    const Frame& frame, Quality quality) {
  WideTree tree;
  tree.frame = frame;
  const int n = static_cast<int>(items.size());
  if (n == 0) return tree;
  PageArray<int> leaf_begin(static_cast<std::size_t>(n) + 1);
  if (quality == Quality::low) sort_by_morton(items);
  // Fits a cache of the second level; larger ranges are parted in place.
  constexpr int spill_most = 1 << 14;
  PageArray<BuildItem> spill(static_cast<std::size_t>(std::min(n, spill_most)));
  BuildTarget target{};
  // Trees of meshes need n / 15 nodes or so; n always does, since each node has two children.
  for (int capacity = n / 10 + 64;; capacity = n) {
    tree.nodes = PageArray<WideNode>(static_cast<std::size_t>(capacity));
    target = {.items = items.data(),
              .count = n,
              .bins = quality == Quality::high ? max_bins : max_bins / 2,
              .spill = spill.data(),
              .spill_count = static_cast<int>(spill.size()),
              .nodes = tree.nodes.data(),
              .node_capacity = capacity,
              .leaf_begin = leaf_begin.data(),
              .node_count = 0,
              .leaf_count = 0,
              .root = no_child,
              .full = false};
    if (quality == Quality::low)
      build_sorted(target);
    else
      wide_kernels().build(target);
    if (!target.full) break;
  }
  tree.node_count = target.node_count;
  tree.leaf_count = target.leaf_count;
  tree.root = target.root;
  fill_leaves(vertices, faces, items, leaf_begin.data(), tree);
  if (quality == Quality::low) fit(vertices, faces, tree);
  return tree;
}

WideTree build_tree(const VertexRef& vertices, const FaceRef& faces, Quality quality) {
  const Frame frame = frame_of(vertices);
  const Outward outward(frame);
  PageArray<BuildItem> items(static_cast<std::size_t>(faces.rows()));
  for (int i = 0; i < static_cast<int>(faces.rows()); ++i)
    fill_item(vertices, faces, i, outward, items[static_cast<std::size_t>(i)]);
  return build_over(vertices, faces, std::move(items), frame, quality);
}

void name_corners(const FaceRef& faces, int first, int last, WideTree& tree) {
  for (int l = first; l < last; ++l) {
    const int* const face = tree.leaves[static_cast<std::size_t>(l)].face;
    int* const ids = tree.corner_ids.data() + std::ptrdiff_t{corners_of_leaf} * l;
    for (int i = 0; i < leaf_width; ++i)
      for (int v = 0; v < 3; ++v) {
        const int from = face[i] < 0 ? face[0] : face[i];
        ids[leaf_width * v + i] = from < 0 ? 0 : faces(from, v);
      }
  }
}

void fit(const VertexRef& vertices, const FaceRef& faces, WideTree& tree) {
  if (tree.corner_ids.size() == 0 && tree.leaf_count > 0) {
    tree.corner_ids =
        PageArray<int>(std::size_t{corners_of_leaf} * static_cast<std::size_t>(tree.leaf_count));
    name_corners(faces, 0, tree.leaf_count, tree);
  }
  wide_kernels().refit({.nodes = tree.nodes.data(),
                        .node_count = tree.node_count,
                        .root = tree.root,
                        .leaves = tree.leaves.data(),
                        .corner_ids = tree.corner_ids.data(),
                        .vertices = vertices.data(),
                        .frame = tree.frame});
}

}  // namespace carom::broad
