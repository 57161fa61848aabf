// SPDX-License-Identifier: Apache-2.0
#pragma once
// The tree of Bvh as its kernels see it: plain arrays, so that one source can be compiled for
// several CPU levels.
#include <cstddef>
#include <cstdint>

#include "broad/box_blocks.hpp"  // Emit
#include "broad/triangle_queries.hpp"

namespace carom::broad {

inline constexpr int wide = 8;        // children of a node
inline constexpr int leaf_width = 4;  // triangles of a leaf
inline constexpr std::uint32_t leaf_flag = 0x80000000U;
inline constexpr std::uint32_t no_child = 0xFFFFFFFFU;
// SAH splits are followed by halving beyond this depth, so 32-bit counts end below 64.
inline constexpr int depth_of_free_splits = 20;
inline constexpr int max_depth = 64;
inline constexpr int stack_size = (wide - 1) * max_depth + wide;

/// Boxes of eight children in tree space, rounded outward: lower x, y, z, upper x, y, z. Unused
/// children are empty boxes.
struct alignas(64) WideNode {
  float bounds[6][wide];
  std::uint32_t child[wide];  ///< index of a node, or leaf_flag | index of a leaf
};

/// Corners of four triangles, as given. face is -1 in unused lanes, whose corners are all 0.
struct alignas(64) Leaf {
  double corner[3][3][leaf_width];  ///< corner, axis, triangle
  int face[leaf_width];
};

/// x in tree space is x scale - shift, about within [-1, 1]. scale is a power of two.
struct Frame {
  double scale = 1;
  double shift[3] = {0, 0, 0};
};

struct WideTreeView {
  const WideNode* nodes;
  const Leaf* leaves;
  std::uint32_t root;  ///< a child reference; no_child for an empty tree
  int leaf_count;
  Frame frame;
};

/// Bounds of one triangle in tree space for the builder: lower x, y, z, index, then minus upper x,
/// y, z, so that one minimum joins two of them.
struct alignas(32) BuildItem {
  float bounds[8];
  [[nodiscard]] int index() const { return __builtin_bit_cast(int, bounds[3]); }
};

/// Where the builder writes. Node k comes before its children.
struct BuildTarget {
  BuildItem* items;
  int count;
  int bins;          ///< at most max_bins
  BuildItem* spill;  ///< room for spill_count items, see sah_build.inl
  int spill_count;
  WideNode* nodes;
  int node_capacity;
  int*
      leaf_begin;  ///< first item of each leaf, and one past the last leaf's end; count + 1 entries
  int node_count, leaf_count;
  std::uint32_t root;
  bool full;  ///< node_capacity was too small
};
inline constexpr int max_bins = 32;

/// A tree and where its vertices now are.
struct RefitTarget {
  WideNode* nodes;
  int node_count;
  std::uint32_t root;
  Leaf* leaves;
  /// Rows of `vertices` of each leaf: corner, triangle; unused lanes repeat the first.
  const int* corner_ids;
  const double* vertices;  ///< x, y, z per row
  Frame frame;             ///< theirs
};
inline constexpr int corners_of_leaf = 3 * leaf_width;

struct WideKernels {
  void (*build)(BuildTarget& target);
  /// Corners of the leaves, then boxes of the nodes. Faces of the leaves stay.
  void (*refit)(const RefitTarget& target);
  /// Half the surface of the children of nodes [first, last) each, in tree space.
  void (*surfaces)(const WideNode* nodes, int first, int last, double* out);
  /// Box of at least one row of x, y, z; false when one is not finite.
  bool (*extent)(const double* vertices, std::size_t rows, double* low, double* high);
  void (*raycast)(const WideTreeView& tree, const Ray* rays, int count, Nearest* out);
  void (*any_hit)(const WideTreeView& tree, const Ray* rays, int count, std::uint8_t* out);
  /// Emits faces whose box overlaps (lower x, y, z, upper x, y, z).
  void (*overlaps)(const WideTreeView& tree, const double* box, void* sink, Emit emit);
  /// Nearest point; `best` starts with the largest squared distance of interest.
  void (*closest)(const WideTreeView& tree, const double* point, Nearest& best, double* at);
  /// Emits keys of pairs of faces.
  void (*self_pairs)(const WideTreeView& tree, void* sink, Emit emit);
};

namespace portable {
extern const WideKernels wide_kernels;
}
namespace avx2 {
extern const WideKernels wide_kernels;
}
[[nodiscard]] const WideKernels& wide_kernels();

}  // namespace carom::broad
