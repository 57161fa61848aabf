// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/mesh_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Geometry>

#include "carom/numerics/tolerance.hpp"

#include "geometry/mesh_polytope.hpp"
#include "geometry/plain_nodes.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

struct HalfEdge {
  int lo, hi, face, slot;
  bool forward;  // the face runs from lo to hi
};

void set_faces(MeshSurface& s) {
  const auto faces = static_cast<int>(s.mesh.faces.rows());
  s.face_normals.assign(faces, Vector3d::Zero());
  std::set<std::array<int, 3>> seen;
  const Vector3d origin = s.mesh.vertices.colwise().mean();
  double six_volume = 0;
  for (int f = 0; f < faces; ++f) {
    const Vector3d a = s.corner(f, 0), ab = s.corner(f, 1) - a, ac = s.corner(f, 2) - a;
    const Vector3d n = ab.cross(ac);
    six_volume += (a - origin).dot((s.corner(f, 1) - origin).cross(s.corner(f, 2) - origin));
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    if (n.norm() > tolerance::flat_triangle * longest * longest)
      s.face_normals[f] = n.normalized();
    else
      ++s.faults.degenerate_faces;
    std::array<int, 3> key{s.mesh.faces(f, 0), s.mesh.faces(f, 1), s.mesh.faces(f, 2)};
    std::ranges::sort(key);
    if (!seen.insert(key).second) ++s.faults.duplicate_faces;
  }
  s.volume = six_volume / 6;
}

MeshSurface::Bend bend_of(const MeshSurface& s, const MeshSurface::Edge& e) {
  if (e.f1 < 0) return MeshSurface::Bend::convex;
  const Vector3d& n0 = s.face_normals[e.f0];
  const double rise = n0.dot(e.inward1);  // sine of the bend; positive where face 1 rises over 0
  if (n0.dot(s.face_normals[e.f1]) > 0 && std::abs(rise) <= tolerance::flat_bend)
    return MeshSurface::Bend::flat;
  return rise < 0 ? MeshSurface::Bend::convex : MeshSurface::Bend::concave;
}

/// In the plane of face f, perpendicular to the directed edge v0 v1, towards the inside.
Vector3d inward(const MeshSurface& s, int f, const Vector3d& along) {
  return s.face_normals[f].cross(along);
}

void set_edges(MeshSurface& s) {
  const auto faces = static_cast<int>(s.mesh.faces.rows());
  s.face_edges.assign(faces, {-1, -1, -1});
  std::vector<HalfEdge> halves;
  for (int f = 0; f < faces; ++f)
    if (!s.face_normals[f].isZero(0))
      for (int k = 0; k < 3; ++k) {
        const int v0 = s.mesh.faces(f, k), v1 = s.mesh.faces(f, (k + 1) % 3);
        halves.push_back({std::min(v0, v1), std::max(v0, v1), f, k, v0 < v1});
      }
  std::ranges::sort(halves, {},
                    [](const HalfEdge& h) { return std::tuple(h.lo, h.hi, h.face, h.slot); });
  for (std::size_t i = 0; i < halves.size();) {
    std::size_t j = i;
    while (j < halves.size() && halves[j].lo == halves[i].lo && halves[j].hi == halves[i].hi) ++j;
    const bool pair = j - i == 2 && halves[i].forward != halves[i + 1].forward;
    if (j - i == 1) ++s.faults.open_edges;
    if (j - i > 1 && !pair) ++s.faults.non_manifold_edges;
    for (; i < j; i += pair ? 2 : 1) {
      const HalfEdge& h = halves[i];
      MeshSurface::Edge e{};
      e.v0 = h.forward ? h.lo : h.hi;
      e.v1 = h.forward ? h.hi : h.lo;
      e.f0 = h.face;
      e.f1 = pair ? halves[i + 1].face : -1;
      const Vector3d along = (s.vertex(e.v1) - s.vertex(e.v0)).normalized();
      e.inward0 = inward(s, e.f0, along);
      e.inward1 = pair ? inward(s, e.f1, -along) : e.inward0;
      e.normal = s.face_normals[e.f0];
      if (pair) {
        const Vector3d sum = s.face_normals[e.f0] + s.face_normals[e.f1];
        // Two faces back to back (a sheet folded shut) have no halfway normal but the way out.
        e.normal =
            sum.norm() > tolerance::flat_bend ? Vector3d(sum.normalized()) : Vector3d(-e.inward0);
      }
      e.bend = bend_of(s, e);
      const int number = static_cast<int>(s.edges.size());
      s.face_edges[h.face][h.slot] = number;
      if (pair) s.face_edges[halves[i + 1].face][halves[i + 1].slot] = number;
      s.edges.push_back(e);
    }
  }
}

void set_vertices(MeshSurface& s) {
  const auto vertices = static_cast<int>(s.mesh.vertices.rows());
  s.vertex_normals.assign(vertices, Vector3d::Zero());
  s.vertex_sharp.assign(vertices, 0);
  std::vector<std::uint8_t> used(vertices, 0);
  for (int f = 0; f < static_cast<int>(s.mesh.faces.rows()); ++f)
    for (int k = 0; k < 3; ++k) {
      const int v = s.mesh.faces(f, k);
      used[v] = 1;
      const Vector3d e0 = s.corner(f, (k + 1) % 3) - s.vertex(v);
      const Vector3d e1 = s.corner(f, (k + 2) % 3) - s.vertex(v);
      s.vertex_normals[v] += std::atan2(e0.cross(e1).norm(), e0.dot(e1)) * s.face_normals[f];
    }
  for (Vector3d& n : s.vertex_normals)
    if (n.norm() > 0) n.normalize();
  s.faults.unused_vertices = static_cast<int>(std::ranges::count(used, 0));

  s.vertex_first.assign(vertices + 1, 0);
  for (const auto& e : s.edges) ++s.vertex_first[e.v0 + 1], ++s.vertex_first[e.v1 + 1];
  std::partial_sum(s.vertex_first.begin(), s.vertex_first.end(), s.vertex_first.begin());
  s.vertex_edges.resize(s.vertex_first.back());
  std::vector<int> next(s.vertex_first.begin(), s.vertex_first.end() - 1);
  for (int e = 0; e < static_cast<int>(s.edges.size()); ++e) {
    for (int v : {s.edges[e].v0, s.edges[e].v1}) {
      s.vertex_edges[next[v]++] = e;
      if (s.edges[e].bend == MeshSurface::Bend::convex) s.vertex_sharp[v] = 1;
    }
  }
}

/// Faces joined across flat edges. A chain of tiny bends could turn a corner unseen, so a face
/// joins only while it lies in the plane of the cluster's first face.
void set_clusters(MeshSurface& s) {
  const auto faces = static_cast<int>(s.mesh.faces.rows());
  s.face_cluster.assign(faces, -1);
  std::vector<int> stack;
  for (int seed = 0; seed < faces; ++seed) {
    if (s.face_cluster[seed] >= 0) continue;
    s.face_cluster[seed] = seed;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const int f = stack.back();
      stack.pop_back();
      for (int e : s.face_edges[f]) {
        if (e < 0 || s.edges[e].bend != MeshSurface::Bend::flat) continue;
        const int g = s.edges[e].f0 == f ? s.edges[e].f1 : s.edges[e].f0;
        if (s.face_cluster[g] >= 0) continue;
        const Vector3d turn = s.face_normals[g].cross(s.face_normals[seed]);
        if (turn.norm() > tolerance::flat_bend) continue;
        s.face_cluster[g] = seed;
        stack.push_back(g);
      }
    }
  }
}

}  // namespace

MeshSurface::MeshSurface(const TriangleMesh& source) : mesh(source), tree(source) {
  set_faces(*this);
  set_edges(*this);
  set_vertices(*this);
  set_clusters(*this);
  plain = plain_nodes(*this);
  faults.inverted = faults.closed() && volume < 0;
  polytope = polytope_of(*this);
}

std::string MeshFaults::to_string() const {
  std::string out;
  const auto add = [&out](int count, std::string one, std::string many) {
    if (count == 0) return;
    if (!out.empty()) out += ", ";
    out += std::to_string(count) + ' ' + (count == 1 ? one : many);
  };
  add(open_edges, "open edge", "open edges");
  add(non_manifold_edges, "non-manifold edge", "non-manifold edges");
  add(degenerate_faces, "face without area", "faces without area");
  add(duplicate_faces, "duplicate face", "duplicate faces");
  add(unused_vertices, "unused vertex", "unused vertices");
  if (inverted) out += out.empty() ? "faces turned inward" : ", faces turned inward";
  return out;
}

}  // namespace carom
