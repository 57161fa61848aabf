// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/mesh_diagnosis.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "carom/geometry/aabb.hpp"
#include "carom/geometry/mesh_crossings.hpp"
#include "carom/geometry/mesh_topology.hpp"

namespace carom {
namespace {

/// One closed part of a mesh.
struct Part {
  TriangleMesh::Faces faces;
  Aabb box;
  double volume = 0;  // signed, m^3
  int depth = 0;      // how many parts hold it
  int holder = -1;    // the smallest of them
  bool mixed = false;
};

double signed_volume(const TriangleMesh::Vertices& v, const TriangleMesh::Faces& faces) {
  const Eigen::Vector3d from = v.row(faces(0, 0)).transpose();
  double six = 0;
  for (Eigen::Index i = 0; i < faces.rows(); ++i) {
    Eigen::Matrix3d c;
    for (int k = 0; k < 3; ++k) c.col(k) = v.row(faces(i, k)).transpose() - from;
    six += c.determinant();
  }
  return six / 6;
}

double winding(const TriangleMesh::Vertices& v, const TriangleMesh::Faces& faces,
               const Eigen::Vector3d& point) {
  double sum = 0;
  for (Eigen::Index i = 0; i < faces.rows(); ++i) {
    Eigen::Matrix3d c;
    for (int k = 0; k < 3; ++k) c.col(k) = v.row(faces(i, k)).transpose() - point;
    const Eigen::RowVector3d r = c.colwise().norm();
    const double below = r.prod() + c.col(0).dot(c.col(1)) * r[2] + c.col(1).dot(c.col(2)) * r[0] +
                         c.col(2).dot(c.col(0)) * r[1];
    sum += std::atan2(c.determinant(), below);
  }
  return sum / (2 * std::numbers::pi);
}

/// Whether `inner` lies inside `outer`: asked at the corner whose answer is furthest from doubt,
/// for parts may touch.
bool holds(const TriangleMesh::Vertices& v, const Part& outer, const Part& inner) {
  if ((inner.box.lower.array() < outer.box.lower.array()).any() ||
      (inner.box.upper.array() > outer.box.upper.array()).any())
    return false;
  double best = 0.5;
  const Eigen::Index tries = std::min<Eigen::Index>(inner.faces.rows(), 8);
  for (Eigen::Index i = 0; i < tries; ++i) {
    const double w = std::abs(winding(v, outer.faces, v.row(inner.faces(i, 0)).transpose()));
    if (std::abs(w - 0.5) > std::abs(best - 0.5)) best = w;
    if (std::abs(best - 0.5) > 0.4) break;
  }
  return best > 0.5;
}

void turn(TriangleMesh::Faces& faces) {
  faces.col(1).swap(faces.col(2));
}

std::vector<Part> parts_of(const TriangleMesh& mesh, const MeshTopology& t) {
  std::vector<Part> parts(t.components);
  std::vector<Eigen::Index> size(t.components, 0);
  for (const int c : t.component) ++size[c];
  for (int c = 0; c < t.components; ++c) {
    parts[c].faces.resize(size[c], 3);
    parts[c].mixed = t.mixed[c] != 0;
    size[c] = 0;
  }
  for (Eigen::Index i = 0; i < t.faces.rows(); ++i) {
    Part& part = parts[t.component[i]];
    auto row = part.faces.row(size[t.component[i]]++);
    row = t.faces.row(i);
    if (t.turned[i]) std::swap(row[1], row[2]);
    for (int k = 0; k < 3; ++k) part.box.extend(mesh.vertices.row(row[k]).transpose());
  }
  return parts;
}

/// Turns each part so that solids are positive and cavities negative, and counts what it found.
void settle(const TriangleMesh::Vertices& v, std::vector<Part>& parts, MeshDiagnosis& d) {
  for (Part& part : parts) part.volume = signed_volume(v, part.faces);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < parts.size(); ++j)
      if (i != j && std::abs(parts[j].volume) > std::abs(parts[i].volume) &&
          holds(v, parts[j], parts[i])) {
        ++parts[i].depth;
        const int holder = parts[i].holder;
        if (holder < 0 || std::abs(parts[j].volume) < std::abs(parts[holder].volume))
          parts[i].holder = static_cast<int>(j);
      }
  // An outermost part that is inside out turns with all it holds: their sense is to each other.
  for (Part& part : parts) {
    const Part* root = &part;
    while (root->holder >= 0) root = &parts[root->holder];
    const bool wrong =
        part.mixed ? (part.volume > 0) != (part.depth % 2 == 0) : !root->mixed && root->volume < 0;
    if (!wrong) continue;
    turn(part.faces);
    d.inverted += part.mixed ? 0 : 1;
  }
  for (Part& part : parts) part.volume = signed_volume(v, part.faces);
  for (const Part& part : parts) {
    d.volume += part.volume;
    if (part.volume < 0) ++d.cavities;
    if (part.holder >= 0 && part.volume > 0 && parts[part.holder].volume > 0) ++d.nested;
  }
}

std::string count_of(long n, const char* one, const char* many) {
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

}  // namespace

MendedMesh mended(const TriangleMesh& mesh) {
  require_valid(mesh, "mesh");
  const MeshTopology t = mesh_topology(mesh);
  MendedMesh result;
  MeshDiagnosis& d = result.diagnosis;
  d.components = t.components;
  d.open_edges = t.open_edges;
  d.mixed_edges = t.mixed_edges;
  d.non_manifold_edges = t.non_manifold_edges;
  d.duplicate_faces = t.duplicate_faces;
  d.degenerate_faces = t.degenerate_faces;
  d.orientable = t.orientable;
  d.crossings = std::ssize(mesh_crossings(mesh.vertices, t.faces));
  result.mesh.vertices = mesh.vertices;
  result.mesh.faces = t.faces;
  if (!d.closed() || !d.orientable) return result;

  std::vector<Part> parts = parts_of(mesh, t);
  settle(mesh.vertices, parts, d);
  Eigen::Index row = 0;
  for (const Part& part : parts) {
    result.mesh.faces.middleRows(row, part.faces.rows()) = part.faces;
    row += part.faces.rows();
  }
  return result;
}

MeshDiagnosis diagnose(const TriangleMesh& mesh) {
  return mended(mesh).diagnosis;
}

double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  return winding(mesh.vertices, mesh.faces, point);
}

std::vector<std::string> MeshDiagnosis::findings() const {
  std::vector<std::string> said;
  if (open_edges > 0)
    said.push_back("the mesh is open at " + count_of(open_edges, "edge", "edges"));
  if (!orientable) said.emplace_back("the surface has one side only");
  if (mixed_edges > 0)
    said.push_back("mixed winding at " + count_of(mixed_edges, "edge", "edges") +
                   (closed() && orientable ? "; the few were turned to agree with the many" : ""));
  if (inverted > 0)
    said.push_back(count_of(inverted, "part was", "parts were") + " inside out and turned");
  if (cavities > 0)
    said.push_back("the mesh has " + count_of(cavities, "cavity", "cavities") +
                   "; left out of the volume");
  if (nested > 0)
    said.push_back(count_of(nested, "part lies", "parts lie") +
                   " inside another and wound the same way; counted twice");
  if (crossings > 0)
    said.push_back("the mesh crosses itself at " + count_of(crossings, "pair", "pairs") +
                   " of faces; what lies inside twice is counted twice");
  if (duplicate_faces > 0)
    said.push_back(count_of(duplicate_faces, "duplicate face was", "duplicate faces were") +
                   " left out");
  if (degenerate_faces > 0)
    said.push_back(count_of(degenerate_faces, "face uses", "faces use") +
                   " a corner twice and was left out");
  if (non_manifold_edges > 0)
    said.push_back(count_of(non_manifold_edges, "edge is", "edges are") +
                   " shared by four or more faces");
  return said;
}

}  // namespace carom
