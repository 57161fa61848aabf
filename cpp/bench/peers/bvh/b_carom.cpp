// SPDX-License-Identifier: Apache-2.0
// carom's trees and grid in the format of the peers' benches: RES lines for meshes given as
// arguments, BP lines (moving boxes) without any. Every answer is in double; the counts of hits at
// the end of a line must equal those of the other double-precision peers.
#include <memory>

#include "carom/broad/box_tree.hpp"
#include "carom/broad/bvh.hpp"
#include "carom/broad/grid.hpp"

#include "common.h"

using carom::TriangleMesh;

namespace {

struct Questions {
  TriangleMesh::Vertices starts, ends, lower, upper;

  explicit Questions(const Mesh& mesh) : starts(NR, 3), ends(NR, 3), lower(NB, 3), upper(NB, 3) {
    const std::vector<RayQ> segments = rays(mesh, NR);
    const std::vector<BoxQ> regions = boxes(mesh, NB);
    for (int i = 0; i < NR; ++i)
      for (int k = 0; k < 3; ++k) {
        starts(i, k) = segments[i].o[k];
        ends(i, k) = segments[i].o[k] + segments[i].d[k] * segments[i].len;
      }
    for (int i = 0; i < NB; ++i)
      for (int k = 0; k < 3; ++k) {
        lower(i, k) = regions[i].lo[k];
        upper(i, k) = regions[i].hi[k];
      }
  }
};

template <class Build, class Refit>
void measure(const char* name, const char* file, std::size_t faces, const Questions& q, Build build,
             Refit refit) {
  const int repeats = faces > 500000 ? 3 : 5;
  auto index = build();
  const double build_s = med(repeats, [&] { index = build(); });
  const double refit_s = refit(*index, repeats);
  std::size_t hits = 0, blocked = 0, overlapping = 0;
  const double closest_s = med(5, [&] {
    hits = 0;
    for (const carom::SegmentHit& hit : index->segments(q.starts, q.ends)) hits += hit.face >= 0;
  });
  const double any_s = med(5, [&] {
    blocked = 0;
    for (const std::uint8_t hit : index->blocked(q.starts, q.ends)) blocked += hit;
  });
  const double box_s =
      med(3, [&] { overlapping = index->overlaps(q.lower, q.upper).faces.size(); });
  out(name, file, faces, build_s, refit_s, NR / closest_s, NR / any_s, NB / box_s, hits, blocked,
      overlapping);
}

void meshes(const char* file) {
  const Mesh mesh = load(file);
  const TriangleMesh::Vertices vertices = Eigen::Map<const TriangleMesh::Vertices>(
      mesh.v.front().data(), static_cast<Eigen::Index>(mesh.v.size()), 3);
  const TriangleMesh::Faces faces = Eigen::Map<const TriangleMesh::Faces>(
      mesh.f.front().data(), static_cast<Eigen::Index>(mesh.f.size()), 3);
  const Questions q(mesh);
  const struct {
    carom::Quality quality;
    const char* name;
  } qualities[] = {{carom::Quality::low, "carom-f64-low"},
                   {carom::Quality::medium, "carom-f64-medium"},
                   {carom::Quality::high, "carom-f64-high"}};
  for (const auto& [quality, name] : qualities)
    measure(
        name, file, mesh.f.size(), q,
        [&, quality = quality] {
          return std::make_unique<carom::Bvh>(vertices, faces, carom::Volume::box, quality);
        },
        [&](carom::Bvh& tree, int repeats) { return med(repeats, [&] { tree.refit(vertices); }); });
  measure(
      "carom-f64-grid", file, mesh.f.size(), q,
      [&] { return std::make_unique<carom::HashGrid>(vertices, faces); },
      [](carom::HashGrid&, int) { return 0.0; });
}

void moving_boxes(int n, int steps) {
  Rng random{0x9E3779B97F4A7C15ULL};
  const double side = std::cbrt(n * 4.0);
  std::vector<double> centre, velocity, half;
  for (int i = 0; i < 3 * n; ++i) {
    centre.push_back(random.u() * side);
    velocity.push_back((random.u() - 0.5) * 0.1);
    half.push_back(0.3 + 0.4 * random.u());
  }
  std::vector<carom::Aabb> boxes(static_cast<std::size_t>(n));
  const std::vector<std::uint8_t> moves(boxes.size(), 1);
  const auto place = [&] {
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k) {
        boxes[i].lower[k] = centre[3 * i + k] - half[3 * i + k];
        boxes[i].upper[k] = centre[3 * i + k] + half[3 * i + k];
      }
  };
  place();
  carom::BoxTree tree;
  double begin = now();
  tree.update(boxes, moves);
  const double build_s = now() - begin;
  // Some steps re-fatten all boxes, others none: the mean, not the median, is what a user pays.
  double total = 0, worst = 0;
  std::size_t pairs = 0;
  for (int s = 0; s < steps; ++s) {
    for (int i = 0; i < 3 * n; ++i) {
      centre[i] += velocity[i];
      if (centre[i] < 0 || centre[i] > side) velocity[i] = -velocity[i];
    }
    place();
    begin = now();
    pairs = tree.update(boxes, moves).size();
    const double took = now() - begin;
    total += took;
    worst = std::max(worst, took);
  }
  std::printf("BP,carom-f64,%d,build %.3f,update and pairs: mean %.4f worst %.4f ms,%zu\n", n,
              build_s * 1e3, total / steps * 1e3, worst * 1e3, pairs);
}

}  // namespace

int main(int count, char** files) {
  if (count == 1)
    for (const int n : {1000, 10000, 100000}) moving_boxes(n, 40);
  for (int i = 1; i < count; ++i) meshes(files[i]);
}
