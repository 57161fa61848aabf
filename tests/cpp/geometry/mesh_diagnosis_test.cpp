// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/mesh_diagnosis.hpp"

#include <gtest/gtest.h>

#include "carom/geometry/mesh_crossings.hpp"
#include "carom/numerics/invalid_input.hpp"

#include "box_mesh.hpp"

namespace carom {
namespace {

const TriangleMesh unit = box_mesh({0, 0, 0}, {1, 1, 1});

TriangleMesh unit_at(double x, double y, double z) {
  return box_mesh({x, y, z}, {x + 1, y + 1, z + 1});
}

TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh loose;
  loose.vertices.resize(3 * mesh.faces.rows(), 3);
  loose.faces.resize(mesh.faces.rows(), 3);
  for (int i = 0; i < mesh.faces.size(); ++i) {
    loose.vertices.row(i) = mesh.vertices.row(mesh.faces.data()[i]);
    loose.faces.data()[i] = i;
  }
  return loose;
}

TEST(SoundMesh, HasNoFindings) {
  const MeshDiagnosis d = diagnose(unit);
  EXPECT_TRUE(d.closed());
  EXPECT_EQ(d.volume, 1);
  EXPECT_EQ(d.components, 1);
  EXPECT_TRUE(d.findings().empty());
}

TEST(SoundMesh, MayBeATriangleSoup) {
  TriangleMesh loose = soup(unit);
  for (int i = 0; i < loose.vertices.size(); ++i)
    if (loose.vertices.data()[i] == 0 && i % 2 == 0) loose.vertices.data()[i] = -0.0;
  EXPECT_TRUE(diagnose(loose).findings().empty());
  EXPECT_EQ(diagnose(loose).volume, 1);
}

TEST(OpenMesh, TellsHowManyEdges) {
  TriangleMesh lidless = unit;
  lidless.faces.conservativeResize(10, 3);
  EXPECT_EQ(diagnose(lidless).open_edges, 4);
  EXPECT_FALSE(diagnose(lidless).closed());
  EXPECT_NE(diagnose(lidless).findings().front().find("open at 4 edges"), std::string::npos);
}

TEST(InsideOutMesh, IsTurned) {
  const MendedMesh m = mended(reversed(unit));
  EXPECT_EQ(m.diagnosis.inverted, 1);
  EXPECT_EQ(m.diagnosis.volume, 1);
  EXPECT_TRUE(diagnose(m.mesh).findings().empty());
}

TEST(MixedWinding, IsMendedByTheMany) {
  TriangleMesh mesh = unit;
  for (const int f : {1, 7}) std::swap(mesh.faces(f, 0), mesh.faces(f, 1));
  const MendedMesh m = mended(mesh);
  EXPECT_EQ(m.diagnosis.mixed_edges, 6);  // two faces apart: three edges each
  EXPECT_EQ(m.diagnosis.volume, 1);
  EXPECT_TRUE(diagnose(m.mesh).findings().empty());
}

TEST(Cavity, IsLeftOutOfTheVolume) {
  const TriangleMesh outer = box_mesh({0, 0, 0}, {2, 3, 4});
  const TriangleMesh hole = box_mesh({0.5, 0.5, 0.5}, {1.5, 2.5, 3.5});
  const MeshDiagnosis d = diagnose(joined(outer, reversed(hole)));
  EXPECT_EQ(d.cavities, 1);
  EXPECT_EQ(d.volume, 24 - 6);
  EXPECT_EQ(d.inverted, 0);
  // the whole turned inside out is the same body
  EXPECT_EQ(diagnose(reversed(joined(outer, reversed(hole)))).volume, 24 - 6);
  // wound like the outside it is a second solid, and that is said
  const MeshDiagnosis twice = diagnose(joined(outer, hole));
  EXPECT_EQ(twice.nested, 1);
  EXPECT_EQ(twice.volume, 24 + 6);
}

TEST(Cavity, WithMixedWindingIsTurnedByWhereItLies) {
  TriangleMesh hole = box_mesh({0.5, 0.5, 0.5}, {1.5, 2.5, 3.5});
  std::swap(hole.faces(3, 0), hole.faces(3, 1));
  const MeshDiagnosis d = diagnose(joined(box_mesh({0, 0, 0}, {2, 3, 4}), hole));
  EXPECT_EQ(d.volume, 24 - 6);
  EXPECT_EQ(d.cavities, 1);
}

TEST(Cavity, MayHoldAnIsland) {
  const TriangleMesh nest =
      joined(joined(box_mesh({0, 0, 0}, {9, 9, 9}), reversed(box_mesh({1, 1, 1}, {8, 8, 8}))),
             box_mesh({2, 2, 2}, {7, 7, 7}));
  const MeshDiagnosis d = diagnose(nest);
  EXPECT_EQ(d.volume, 729 - 343 + 125);
  EXPECT_EQ(d.cavities, 1);
  EXPECT_EQ(d.nested, 0);
}

TEST(Crossing, IsFoundAndCounted) {
  EXPECT_GT(diagnose(joined(unit, unit_at(0.3, 0.4, 0.6))).crossings, 0);
  // on the diagonals of the faces, where every plain determinant is 0
  EXPECT_GT(diagnose(joined(unit, unit_at(0.5, 0.5, 0.5))).crossings, 0);
  EXPECT_GT(diagnose(joined(unit, unit_at(0x1p-40, 0x1p-41, 0x1p-42))).crossings, 0);
  EXPECT_EQ(diagnose(joined(unit, unit_at(1.5, 0, 0))).crossings, 0);
}

TEST(Crossing, IsNotTouching) {
  EXPECT_EQ(diagnose(joined(unit, unit_at(1 + 0x1p-52, 0.25, 0.25))).crossings, 0);
  EXPECT_EQ(diagnose(joined(unit, unit_at(1, 0.25, 0.125))).crossings, 0);  // face on face
  EXPECT_EQ(diagnose(unit).crossings, 0);
}

TEST(Crossing, ThroughARidgeIsFoundWhereOnlyRidgesAreHit) {
  // A blade whose edge goes exactly through the diagonals of two faces of the cube, and out again.
  TriangleMesh blade;
  blade.vertices.resize(3, 3);
  blade.vertices << -1, 0.5, 0.5, 2, 0.5, 0.5, 0.5, 5, 9;
  blade.faces.resize(1, 3);
  blade.faces << 0, 1, 2;
  EXPECT_GT(diagnose(joined(unit, blade)).crossings, 0);
  // the same edge along a rim of the cube touches it
  blade.vertices << -1, 1, 1, 2, 1, 1, 0.5, 5, 9;
  EXPECT_EQ(diagnose(joined(unit, blade)).crossings, 0);
}

TEST(Crossing, AgreesWithAllPairs) {
  // A strip wound through itself: pairs counted by the tree against every pair tested alone.
  TriangleMesh strip;
  const int n = 40;
  strip.vertices.resize(n + 2, 3);
  for (int i = 0; i < n + 2; ++i)
    strip.vertices.row(i) << std::sin(1.9 * i), std::cos(2.7 * i), std::sin(0.7 * i + 1);
  strip.faces.resize(n, 3);
  for (int i = 0; i < n; ++i) strip.faces.row(i) << i, i + 1, i + 2;
  std::vector<std::pair<int, int>> expected;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      TriangleMesh::Faces two(2, 3);
      two << strip.faces.row(i), strip.faces.row(j);
      if (!mesh_crossings(strip.vertices, two).empty()) expected.emplace_back(i, j);
    }
  EXPECT_GT(expected.size(), 50u);
  EXPECT_EQ(mesh_crossings(strip.vertices, strip.faces), expected);
}

TEST(Copies, AreLeftOut) {
  TriangleMesh mesh = unit;
  mesh.faces.conservativeResize(14, 3);
  mesh.faces.row(12) << 4, 6, 0;  // face 0 from another corner
  mesh.faces.row(13) << 1, 1, 2;
  const MeshDiagnosis d = diagnose(mesh);
  EXPECT_EQ(d.duplicate_faces, 1);
  EXPECT_EQ(d.degenerate_faces, 1);
  EXPECT_TRUE(d.closed());
  EXPECT_EQ(d.volume, 1);
}

TEST(Copies, BackToBackCancel) {
  TriangleMesh mesh = unit;
  mesh.vertices.conservativeResize(10, 3);
  mesh.vertices.row(8) << 5, 5, 5;
  mesh.vertices.row(9) << 5, 6, 5;
  mesh.faces.conservativeResize(14, 3);
  mesh.faces.row(12) << 7, 8, 9;
  mesh.faces.row(13) << 7, 9, 8;
  EXPECT_EQ(diagnose(mesh).duplicate_faces, 2);
  EXPECT_TRUE(diagnose(mesh).closed());
}

TEST(NonManifoldEdge, IsSaidAndLegal) {
  const MeshDiagnosis d = diagnose(joined(unit, unit_at(1, 1, 0)));  // two cubes on one edge
  EXPECT_EQ(d.non_manifold_edges, 1);
  EXPECT_TRUE(d.closed());
  EXPECT_EQ(d.volume, 2);
}

TEST(OneSidedSurface, IsToldApart) {
  // A Moebius strip of five triangles, coned twice to close it: the projective plane of six
  // corners.
  TriangleMesh plane;
  plane.vertices.resize(6, 3);
  plane.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0.5, 0.2, 0.7, 1;
  plane.faces.resize(10, 3);
  plane.faces << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 1, 1, 2, 4, 2, 3, 5, 3, 4, 1, 4, 5, 2, 5,
      1, 3;
  const MeshDiagnosis d = diagnose(plane);
  EXPECT_TRUE(d.closed());
  EXPECT_FALSE(d.orientable);
}

TEST(WindingNumber, TellsInsideFromOutside) {
  // solid angles are summed with a dozen roundings each: 12 faces of 1e-15
  EXPECT_NEAR(winding_number(unit, {0.3, 0.2, 0.9}), 1, 1e-14);
  EXPECT_NEAR(winding_number(unit, {1.3, 0.2, 0.9}), 0, 1e-14);
  EXPECT_NEAR(winding_number(reversed(unit), {0.3, 0.2, 0.9}), -1, 1e-14);
}

TEST(InvalidMesh, IsRefused) {
  TriangleMesh bad = unit;
  bad.faces(3, 1) = 8;
  EXPECT_THROW((void)diagnose(bad), InvalidInput);
}

}  // namespace
}  // namespace carom
