// SPDX-License-Identifier: Apache-2.0
#include "broad/volume_tree.hpp"

#include "broad/volumes.hpp"

namespace carom::broad {
namespace {

// Leaves below each child, consecutive because leaves are numbered in the order of the walk.
struct Below {
  int begin, end;
};

Below leaves_below(const WideTreeView& tree, std::uint32_t ref) {
  const auto edge = [&](bool last) {
    std::uint32_t at = ref;
    while ((at & leaf_flag) == 0) {
      const WideNode& node = tree.nodes[at];
      int i = 0;
      if (last)
        for (i = wide - 1; node.child[i] == no_child; --i) {
        }
      at = node.child[i];
    }
    return static_cast<int>(at & ~leaf_flag);
  };
  return {edge(false), edge(true) + 1};
}

void corner_of(const Leaf& leaf, int i, double (*abc)[3]) {
  for (int v = 0; v < 3; ++v)
    for (int k = 0; k < 3; ++k) abc[v][k] = leaf.corner[v][k][i];
}

void box_of_lane(const Leaf& leaf, int i, double* box) {
  for (int k = 0; k < 3; ++k) {
    const double a = leaf.corner[0][k][i], b = leaf.corner[1][k][i], c = leaf.corner[2][k][i];
    box[k] = smaller(smaller(a, b), c);
    box[3 + k] = larger(larger(a, b), c);
  }
}

bool meet(const double* a, const double* b) {
  bool in = true;
  for (int k = 0; k < 3; ++k) in = in & (a[k] <= b[3 + k]) & (b[k] <= a[3 + k]);
  return in;
}

struct Waiting {
  std::uint32_t ref;
  double bound;
};

// Depth first, the child of the least bound first. `bound_of(child)` is negative to skip;
// `visit(leaf)` may lower `limit`, beyond which bounds are skipped.
template <class Child, class Bound, class Visit>
void descend(const WideTreeView& tree, const std::vector<Child>& children, double& limit,
             Bound bound_of, Visit visit) {
  if (tree.root == no_child) return;
  Waiting stack[stack_size];
  int top = 0;
  stack[top++] = {tree.root, 0};
  while (top > 0) {
    const Waiting next = stack[--top];
    if (next.bound > limit) continue;
    if ((next.ref & leaf_flag) != 0) {
      visit(tree.leaves[next.ref & ~leaf_flag], static_cast<int>(next.ref & ~leaf_flag));
      continue;
    }
    const WideNode& node = tree.nodes[next.ref];
    const int floor = top;
    for (int i = 0; i < wide && node.child[i] != no_child; ++i) {
      const double bound = bound_of(children[std::size_t{wide} * next.ref + std::size_t(i)]);
      if (!(bound >= 0) || bound > limit) continue;
      int to = top++;
      for (; to > floor && stack[to - 1].bound < bound; --to) stack[to] = stack[to - 1];
      stack[to] = {node.child[i], bound};
    }
  }
}

}  // namespace

template <class Child>
void VolumeTree<Child>::fit(const WideTreeView& tree) {
  children_.clear();
  for (int k = 0; k < 3; ++k) lower_[k] = upper_[k] = 0;
  if (tree.root == no_child) return;
  std::vector<Eigen::Vector3d> corners;
  // The corners of the faces' boxes: overlap is asked of these, and they hold the faces.
  const auto gather = [&](Below range) {
    corners.clear();
    for (int l = range.begin; l < range.end; ++l)
      for (int i = 0; i < leaf_width && tree.leaves[l].face[i] >= 0; ++i) {
        double box[6];
        box_of_lane(tree.leaves[l], i, box);
        for (int c = 0; c < 8; ++c)
          corners.emplace_back(box[c & 1 ? 3 : 0], box[c & 2 ? 4 : 1], box[c & 4 ? 5 : 2]);
      }
  };
  gather({0, tree.leaf_count});
  for (int k = 0; k < 3; ++k) lower_[k] = upper_[k] = corners.front()[k];
  for (const Eigen::Vector3d& p : corners)
    for (int k = 0; k < 3; ++k) {
      lower_[k] = smaller(lower_[k], p[k]);
      upper_[k] = larger(upper_[k], p[k]);
    }
  if ((tree.root & leaf_flag) != 0) return;
  std::vector<std::uint32_t> waiting{tree.root};
  while (!waiting.empty()) {
    const std::uint32_t index = waiting.back();
    waiting.pop_back();
    const WideNode& node = tree.nodes[index];
    if (children_.size() < std::size_t{wide} * (index + 1))
      children_.resize(std::size_t{wide} * (index + 1));
    for (int i = 0; i < wide && node.child[i] != no_child; ++i) {
      gather(leaves_below(tree, node.child[i]));
      // A part rebuilt into fewer leaves leaves empty ones behind; nothing points at them.
      broad::fit(children_[std::size_t{wide} * index + std::size_t(i)], corners);
      if ((node.child[i] & leaf_flag) == 0) waiting.push_back(node.child[i]);
    }
  }
}

template <class Child>
Nearest VolumeTree<Child>::raycast(const WideTreeView& tree, const Ray& ray, bool any) const {
  Nearest best{ray.t_max, -1};
  double limit = ray.t_max;
  descend(
      tree, children_, limit,
      [&](const Child& child) {
        double entry = 0;
        return may_enter(child, ray, best.t, entry) ? entry : -1;
      },
      [&](const Leaf& leaf, int) {
        for (int i = 0; i < leaf_width && leaf.face[i] >= 0; ++i) {
          double abc[3][3];
          corner_of(leaf, i, abc);
          const double t = hit_time(ray, abc[0], abc[1], abc[2]);
          if (t <= best.t) keep_nearer(best, t, leaf.face[i]);
        }
        limit = any && best.face >= 0 ? -1 : best.t;
      });
  return best;
}

template <class Child>
void VolumeTree<Child>::overlaps(const WideTreeView& tree, const double* box, void* sink,
                                 Emit emit) const {
  // Nothing lies outside the mesh: cutting the box there keeps infinite ones out of the sums.
  double cut[6];
  for (int k = 0; k < 3; ++k) {
    const double size = upper_[k] - lower_[k];
    cut[k] = larger(box[k], lower_[k] - size);
    cut[3 + k] = smaller(box[3 + k], upper_[k] + size);
    if (!(cut[k] <= cut[3 + k])) return;
  }
  double limit = 0;
  descend(
      tree, children_, limit,
      [&](const Child& child) { return may_overlap(child, cut) ? 0.0 : -1.0; },
      [&](const Leaf& leaf, int) {
        for (int i = 0; i < leaf_width && leaf.face[i] >= 0; ++i) {
          double own[6];
          box_of_lane(leaf, i, own);
          const auto face = static_cast<std::uint64_t>(leaf.face[i]);
          if (meet(own, box)) emit(sink, &face, 1);
        }
      });
}

template <class Child>
void VolumeTree<Child>::closest(const WideTreeView& tree, const double* point, Nearest& best,
                                double* at) const {
  double limit = std::numeric_limits<double>::infinity();
  descend(
      tree, children_, limit, [&](const Child& child) { return least_distance(child, point); },
      [&](const Leaf& leaf, int) {
        for (int i = 0; i < leaf_width && leaf.face[i] >= 0; ++i) {
          double abc[3][3], q[3];
          corner_of(leaf, i, abc);
          const double d2 = closest_on_triangle(point, abc[0], abc[1], abc[2], q);
          if (!(d2 < best.t || (d2 == best.t && (best.face < 0 || leaf.face[i] < best.face))))
            continue;
          best = {d2, leaf.face[i]};
          for (int k = 0; k < 3; ++k) at[k] = q[k];
        }
        limit = std::sqrt(best.t) * (1 + guard) + tiny;
      });
}

template <class Child>
void VolumeTree<Child>::self_pairs(const WideTreeView& tree, void* sink, Emit emit) const {
  double limit = 0;
  for (int own = 0; own < tree.leaf_count; ++own) {
    const Leaf& leaf = tree.leaves[own];
    for (int i = 0; i < leaf_width && leaf.face[i] >= 0; ++i) {
      double box[6];
      box_of_lane(leaf, i, box);
      descend(
          tree, children_, limit,
          [&](const Child& child) { return may_overlap(child, box) ? 0.0 : -1.0; },
          [&](const Leaf& other, int) {
            for (int j = 0; j < leaf_width && other.face[j] >= 0; ++j) {
              if (other.face[j] <= leaf.face[i]) continue;
              double theirs[6];
              box_of_lane(other, j, theirs);
              const std::uint64_t key = static_cast<std::uint64_t>(leaf.face[i]) << 32 |
                                        static_cast<std::uint64_t>(other.face[j]);
              if (meet(box, theirs)) emit(sink, &key, 1);
            }
          });
    }
  }
}

template class VolumeTree<SphereChild>;
template class VolumeTree<OrientedBoxChild>;

}  // namespace carom::broad
