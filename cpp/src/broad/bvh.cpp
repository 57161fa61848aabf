// SPDX-License-Identifier: Apache-2.0
#include "carom/broad/bvh.hpp"

#include <string>

#include "carom/numerics/invalid_input.hpp"

#include "broad/bvh_build.hpp"
#include "broad/mesh_queries.hpp"
#include "broad/pair_keys.hpp"
#include "broad/tree_parts.hpp"
#include "broad/volume_tree.hpp"

namespace carom {

using namespace broad;

struct Bvh::Impl {
  Volume volume;
  Quality quality;
  TriangleMesh::Faces faces;
  Eigen::Index vertex_count = 0;
  WideTree tree;
  TreeParts parts;
  VolumeTree<SphereChild> spheres;
  VolumeTree<OrientedBoxChild> oriented_boxes;
  int rebuilt_parts = 0;
  const WideKernels* kernels = &wide_kernels();

  void fit_volumes() {
    if (volume == Volume::sphere) spheres.fit(tree.view());
    if (volume == Volume::oriented_box) oriented_boxes.fit(tree.view());
  }
  // Ray queries of a block, as each_block asks them.
  auto first() const {
    return [this, view = tree.view()](const Ray* rays, int count, Nearest* out) {
      if (volume == Volume::box) return kernels->raycast(view, rays, count, out);
      for (int i = 0; i < count; ++i) out[i] = in_volumes(view, rays[i], false);
    };
  }
  auto any() const {
    return [this, view = tree.view()](const Ray* rays, int count, std::uint8_t* out) {
      if (volume == Volume::box) return kernels->any_hit(view, rays, count, out);
      for (int i = 0; i < count; ++i) out[i] = in_volumes(view, rays[i], true).face >= 0;
    };
  }

 private:
  [[nodiscard]] Nearest in_volumes(const WideTreeView& view, const Ray& ray, bool any) const {
    return volume == Volume::sphere ? spheres.raycast(view, ray, any)
                                    : oriented_boxes.raycast(view, ray, any);
  }
};

namespace {

template <class T>
void append(void* sink, const std::uint64_t* found, int count) {
  auto& list = *static_cast<std::vector<T>*>(sink);
  list.insert(list.end(), found, found + count);
}

// Kernels read x, y, z row after row; columns of a wider matrix are copied to `room` first.
VertexRef packed(const VertexRef& rows, TriangleMesh::Vertices& room) {
  if (rows.outerStride() == 3) return rows;
  room = rows;
  return room;
}

}  // namespace

Bvh::Bvh(const Eigen::Ref<const TriangleMesh::Vertices>& given,
         const Eigen::Ref<const TriangleMesh::Faces>& faces, Volume volume, Quality quality) {
  require_mesh(given, faces);
  TriangleMesh::Vertices room;
  const VertexRef vertices = packed(given, room);
  impl_ = std::make_unique<Impl>();
  impl_->volume = volume;
  impl_->quality = quality;
  impl_->faces = faces;
  impl_->vertex_count = vertices.rows();
  impl_->tree = build_tree(vertices, impl_->faces, quality);
  impl_->fit_volumes();
}
Bvh::~Bvh() = default;
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;

std::vector<RayHit> Bvh::raycast(Points origins, Points directions, double max_distance) const {
  return each_ray(origins, directions, max_distance, impl_->first());
}

std::vector<std::uint8_t> Bvh::any_hit(Points origins, Points directions,
                                       double max_distance) const {
  return each_any(origins, directions, max_distance, impl_->any());
}

std::vector<SegmentHit> Bvh::segments(Points starts, Points ends) const {
  return each_segment(starts, ends, impl_->first());
}

std::vector<std::uint8_t> Bvh::blocked(Points starts, Points ends) const {
  return each_blocked(starts, ends, impl_->any());
}

Overlaps Bvh::overlaps(Points lower, Points upper) const {
  const WideTreeView view = impl_->tree.view();
  return each_box(lower, upper, [&](const double* box, std::vector<int>& faces) {
    if (impl_->volume == Volume::sphere)
      impl_->spheres.overlaps(view, box, &faces, append<int>);
    else if (impl_->volume == Volume::oriented_box)
      impl_->oriented_boxes.overlaps(view, box, &faces, append<int>);
    else
      wide_kernels().overlaps(view, box, &faces, append<int>);
  });
}

std::vector<ClosestPoint> Bvh::closest(Points points) const {
  const WideTreeView view = impl_->tree.view();
  return each_point(points, [&](const double* point, Nearest& best, double* at) {
    if (impl_->volume == Volume::sphere)
      impl_->spheres.closest(view, point, best, at);
    else if (impl_->volume == Volume::oriented_box)
      impl_->oriented_boxes.closest(view, point, best, at);
    else
      wide_kernels().closest(view, point, best, at);
  });
}

std::vector<BodyPair> Bvh::self_pairs() const {
  const WideTreeView view = impl_->tree.view();
  std::vector<std::uint64_t> keys;
  if (impl_->volume == Volume::sphere)
    impl_->spheres.self_pairs(view, &keys, append<std::uint64_t>);
  else if (impl_->volume == Volume::oriented_box)
    impl_->oriented_boxes.self_pairs(view, &keys, append<std::uint64_t>);
  else
    wide_kernels().self_pairs(view, &keys, append<std::uint64_t>);
  return sorted_pairs(std::move(keys), face_count());
}

void Bvh::refit(const Eigen::Ref<const TriangleMesh::Vertices>& given) {
  if (given.rows() != impl_->vertex_count)
    throw InvalidInput("vertices", std::to_string(given.rows()) + " rows",
                       "must be as many as before: " + std::to_string(impl_->vertex_count),
                       "make a new Bvh for another mesh");
  TriangleMesh::Vertices room;
  const VertexRef vertices = packed(given, room);
  // One pass finds the box and what is not finite; only then look for the row to name.
  double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  if (vertices.rows() > 0 &&
      !impl_->kernels->extent(vertices.data(), static_cast<std::size_t>(vertices.rows()), low,
                              high))
    require_finite_vertices(vertices);
  if (impl_->faces.rows() == 0) return;
  if (impl_->parts.empty()) impl_->parts.measure(impl_->tree);  // as built, before anything moves
  impl_->tree.frame = frame_of_box(low, high);
  fit(vertices, impl_->faces, impl_->tree);
  impl_->rebuilt_parts += impl_->parts.mend(vertices, impl_->faces, impl_->quality, impl_->tree);
  impl_->fit_volumes();
}

int Bvh::face_count() const {
  return static_cast<int>(impl_->faces.rows());
}
std::size_t Bvh::memory_bytes() const {
  const WideTree& t = impl_->tree;
  return sizeof(WideNode) * static_cast<std::size_t>(t.node_count) +
         sizeof(Leaf) * static_cast<std::size_t>(t.leaf_count) +
         sizeof(int) * (static_cast<std::size_t>(impl_->faces.size()) + t.corner_ids.size()) +
         impl_->spheres.memory_bytes() + impl_->oriented_boxes.memory_bytes();
}
Volume Bvh::volume() const {
  return impl_->volume;
}
Quality Bvh::quality() const {
  return impl_->quality;
}
int Bvh::node_count() const {
  return impl_->tree.node_count;
}
int Bvh::rebuilt_parts() const {
  return impl_->rebuilt_parts;
}
int Bvh::depth() const {
  std::vector<int> below(static_cast<std::size_t>(impl_->tree.node_count), 1);
  const WideTree& t = impl_->tree;
  if (t.root == no_child) return 0;
  if ((t.root & leaf_flag) != 0) return 1;
  for (int i = t.node_count - 1; i >= 0; --i) {
    int deepest = 0;
    for (const std::uint32_t ref : t.nodes[static_cast<std::size_t>(i)].child)
      if (ref != no_child) deepest = std::max(deepest, (ref & leaf_flag) != 0 ? 1 : below[ref]);
    below[static_cast<std::size_t>(i)] = deepest + 1;
  }
  return below[t.root];
}

}  // namespace carom
