// SPDX-License-Identifier: Apache-2.0
#include "carom/broad/all_faces.hpp"

#include "broad/face_store.hpp"
#include "broad/pair_keys.hpp"

namespace carom {

using namespace broad;

AllFaces::AllFaces(const Eigen::Ref<const TriangleMesh::Vertices>& vertices,
                   const Eigen::Ref<const TriangleMesh::Faces>& faces) {
  require_mesh(vertices, faces);
  mesh_ = {vertices, faces};
}

namespace {

Nearest first_of(const TriangleMesh& mesh, const Ray& ray) {
  Nearest best{ray.t_max, -1};
  for (int f = 0; f < static_cast<int>(mesh.faces.rows()); ++f) consider_hit(mesh, f, ray, best);
  return best;
}

}  // namespace

std::vector<RayHit> AllFaces::raycast(Points origins, Points directions,
                                      double max_distance) const {
  return each_ray(origins, directions, max_distance,
                  one_by_one<Nearest>([&](const Ray& ray) { return first_of(mesh_, ray); }));
}

std::vector<std::uint8_t> AllFaces::any_hit(Points origins, Points directions,
                                            double max_distance) const {
  return each_any(origins, directions, max_distance, one_by_one<std::uint8_t>([&](const Ray& ray) {
                    return first_of(mesh_, ray).face >= 0;
                  }));
}

std::vector<SegmentHit> AllFaces::segments(Points starts, Points ends) const {
  return each_segment(starts, ends,
                      one_by_one<Nearest>([&](const Ray& ray) { return first_of(mesh_, ray); }));
}

std::vector<std::uint8_t> AllFaces::blocked(Points starts, Points ends) const {
  return each_blocked(starts, ends, one_by_one<std::uint8_t>([&](const Ray& ray) {
                        return first_of(mesh_, ray).face >= 0;
                      }));
}

Overlaps AllFaces::overlaps(Points lower, Points upper) const {
  return each_box(lower, upper, [&](const double* box, std::vector<int>& faces) {
    for (int f = 0; f < face_count(); ++f)
      if (boxes_meet(box_of(mesh_, f).data(), box)) faces.push_back(f);
  });
}

std::vector<ClosestPoint> AllFaces::closest(Points points) const {
  return each_point(points, [&](const double* point, Nearest& best, double* at) {
    for (int f = 0; f < face_count(); ++f) consider_point(mesh_, f, point, best, at);
  });
}

std::vector<BodyPair> AllFaces::self_pairs() const {
  std::vector<BodyPair> out;
  for (int a = 0; a < face_count(); ++a)
    for (int b = a + 1; b < face_count(); ++b)
      if (boxes_meet(box_of(mesh_, a).data(), box_of(mesh_, b).data())) out.push_back({a, b});
  return out;
}

int AllFaces::face_count() const {
  return static_cast<int>(mesh_.faces.rows());
}
std::size_t AllFaces::memory_bytes() const {
  return sizeof(double) * static_cast<std::size_t>(mesh_.vertices.size()) +
         sizeof(int) * static_cast<std::size_t>(mesh_.faces.size());
}

}  // namespace carom
