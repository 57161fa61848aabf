// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include "broad/mesh_queries.hpp"

namespace carom::broad {

/// Corners by pointer, for indices that keep the mesh as it came.
inline const double* corner(const TriangleMesh& mesh, int face, int v) {
  return mesh.vertices.data() + std::ptrdiff_t{3} * mesh.faces(face, v);
}

inline void consider_hit(const TriangleMesh& mesh, int face, const Ray& ray, Nearest& best) {
  const double t =
      hit_time(ray, corner(mesh, face, 0), corner(mesh, face, 1), corner(mesh, face, 2));
  if (t <= best.t) keep_nearer(best, t, face);
}

inline void consider_point(const TriangleMesh& mesh, int face, const double* point, Nearest& best,
                           double* at) {
  double q[3];
  const double d2 = closest_on_triangle(point, corner(mesh, face, 0), corner(mesh, face, 1),
                                        corner(mesh, face, 2), q);
  if (!(d2 < best.t || (d2 == best.t && (best.face < 0 || face < best.face)))) return;
  best = {d2, face};
  for (int k = 0; k < 3; ++k) at[k] = q[k];
}

using Box = std::array<double, 6>;  // lower x, y, z, upper x, y, z

inline Box box_of(const TriangleMesh& mesh, int face) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    const double a = corner(mesh, face, 0)[k], b = corner(mesh, face, 1)[k],
                 c = corner(mesh, face, 2)[k];
    box[static_cast<std::size_t>(k)] = smaller(smaller(a, b), c);
    box[static_cast<std::size_t>(k) + 3] = larger(larger(a, b), c);
  }
  return box;
}

inline bool boxes_meet(const double* a, const double* b) {
  bool in = true;
  for (int k = 0; k < 3; ++k) in = in & (a[k] <= b[3 + k]) & (b[k] <= a[3 + k]);
  return in;
}

}  // namespace carom::broad
