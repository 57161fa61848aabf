// SPDX-License-Identifier: Apache-2.0
// Trees of every kind and the grid answer as a loop over all faces does, to the bit.
#include <Eigen/Geometry>

#include "carom/broad/bvh.hpp"
#include "carom/broad/grid.hpp"
#include "carom/numerics/invalid_input.hpp"

#include "broad/meshes.hpp"

namespace carom {
namespace {

using namespace testing;

void expect_all_agree(const TriangleMesh& mesh, int queries, unsigned seed) {
  Random random(seed);
  const Queries q(mesh, queries, random);
  const AllFaces truth(mesh.vertices, mesh.faces);
  for (const Quality quality : {Quality::low, Quality::medium, Quality::high})
    expect_same(Bvh(mesh.vertices, mesh.faces, Volume::box, quality), truth, q, "boxes");
  expect_same(Bvh(mesh.vertices, mesh.faces, Volume::sphere), truth, q, "spheres");
  expect_same(Bvh(mesh.vertices, mesh.faces, Volume::oriented_box), truth, q, "oriented boxes");
  expect_same(HashGrid(mesh.vertices, mesh.faces), truth, q, "grid");
}

TEST(MeshIndex, AgreesWithAllFacesOnSoup) {
  Random random(1);
  for (const int n : {1, 2, 4, 5, 9, 33, 700}) expect_all_agree(soup(n, 10, 1, random), 300, 2);
}

TEST(MeshIndex, AgreesOnClosedSurfaces) {
  expect_all_agree(bumpy_sphere(16, 0.2), 600, 3);
}

TEST(MeshIndex, AgreesFarFromTheOrigin) {
  TriangleMesh mesh = bumpy_sphere(10, 0.2);
  mesh.vertices.array() += 1e8;
  expect_all_agree(mesh, 300, 4);
  mesh.vertices.array() -= 1e8;
  mesh.vertices.col(1).array() -= 1e8;
  expect_all_agree(mesh, 300, 5);
}

TEST(MeshIndex, AgreesAtAllScales) {
  for (const double scale : {1e-30, 1e-9, 1e9, 1e30}) {
    TriangleMesh mesh = bumpy_sphere(8, 0.2);
    mesh.vertices *= scale;
    expect_all_agree(mesh, 200, 6);
  }
}

TEST(MeshIndex, AgreesOnNeedlesPointsAndFlatFaces) {
  Random random(7);
  TriangleMesh mesh = soup(400, 10, 1, random);
  for (int f = 0; f < 400; ++f) {
    const auto row = [&](int v) { return mesh.vertices.row(3 * f + v); };
    if (f % 4 == 0) row(2) = row(1) + random.point(-1e-12, 1e-12);              // needle
    if (f % 4 == 1) row(2) = row(1) = row(0);                                   // point
    if (f % 4 == 2) row(0)[2] = row(1)[2] = row(2)[2] = std::round(row(0)[2]);  // in a plane
    if (f % 8 == 3) row(2) = 0.5 * (row(0) + row(1));                           // a line
  }
  expect_all_agree(mesh, 400, 8);
}

TEST(MeshIndex, AgreesOnMixedSizes) {
  Random random(9);
  TriangleMesh mesh = soup(500, 10, 0.1, random);
  for (int f = 0; f < 500; f += 50) mesh.vertices.middleRows(3 * f, 3) *= 30;
  for (int f = 1; f < 500; f += 7) {
    const Eigen::RowVector3d c = mesh.vertices.row(3 * f);
    for (int v = 1; v < 3; ++v)
      mesh.vertices.row(3 * f + v) = c + 1e-6 * (mesh.vertices.row(3 * f + v) - c);
  }
  expect_all_agree(mesh, 400, 10);
}

TEST(MeshIndex, AnswersAmongAHundredThousandEqualFaces) {
  // Case C16: no split can part them. Depth stays within its bound; of equals the lowest is named.
  constexpr int n = 100000;
  TriangleMesh mesh;
  mesh.vertices.resize(3, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.faces.resize(n, 3);
  for (int f = 0; f < n; ++f) mesh.faces.row(f) << 0, 1, 2;
  TriangleMesh::Vertices start(1, 3), end(1, 3);
  start << 0.2, 0.2, 1;
  end << 0.2, 0.2, -1;
  const auto expect_lowest = [&](const MeshIndex& index, const char* what) {
    SCOPED_TRACE(what);
    const SegmentHit hit = index.segments(start, end).front();
    EXPECT_EQ(hit.face, 0);
    EXPECT_EQ(hit.fraction, 0.5);
    EXPECT_EQ(index.raycast(start, end - start).front().face, 0);
    EXPECT_EQ(index.any_hit(start, start - end).front(), 0);
    const ClosestPoint near = index.closest(end).front();
    EXPECT_EQ(near.face, 0);
    EXPECT_EQ(near.distance, 1);
    EXPECT_EQ(index.overlaps(end, start.cwiseMax(end)).faces.size(), 0U + n);
    EXPECT_TRUE(index.overlaps(start, start).faces.empty());
  };
  for (const Quality quality : {Quality::low, Quality::medium, Quality::high}) {
    const Bvh tree(mesh.vertices, mesh.faces, Volume::box, quality);
    EXPECT_LE(tree.depth(), 64);
    expect_lowest(tree, "boxes");
  }
  expect_lowest(Bvh(mesh.vertices, mesh.faces, Volume::sphere), "spheres");
  expect_lowest(Bvh(mesh.vertices, mesh.faces, Volume::oriented_box), "oriented boxes");
  expect_lowest(HashGrid(mesh.vertices, mesh.faces), "grid");
}

TEST(MeshIndex, AgreesWhereEveryFaceIsThatSamePoint) {
  // Boxes of no size in a mesh of no size, near the origin and where a spacing of doubles is 1.5e-8
  for (const double offset : {0.0, 3.0, 1e8}) {
    TriangleMesh mesh;
    mesh.vertices = TriangleMesh::Vertices::Constant(3, 3, offset);
    mesh.faces.resize(60, 3);
    for (int f = 0; f < 60; ++f) mesh.faces.row(f) << f % 3, (f + 1) % 3, 2;
    expect_all_agree(mesh, 60, 19);
  }
}

TEST(MeshIndex, AgreesOnOneFaceOfEveryKind) {
  for (const double offset : {0.0, 1e8, -1e8})
    for (const int kind : {0, 1, 2, 3}) {
      TriangleMesh mesh;
      mesh.vertices.resize(3, 3);
      mesh.vertices << 0, 0, 0, 2, 0.5, 1, 0.25, 1, -3;
      if (kind == 1) mesh.vertices.row(2) = 0.5 * mesh.vertices.row(1);                   // a line
      if (kind == 2) mesh.vertices.row(2) << 2, 0.5, 1 + 1e-9;                            // needle
      if (kind == 3) mesh.vertices.row(1) = mesh.vertices.row(2) = mesh.vertices.row(0);  // point
      mesh.vertices.array() += offset;
      mesh.faces.resize(1, 3);
      mesh.faces << 0, 1, 2;
      expect_all_agree(mesh, 100, 20);
    }
}

TEST(MeshIndex, ReadsRowsThatLieApart) {
  // Columns of a wider matrix: rows of x, y, z with other numbers between them.
  const TriangleMesh mesh = bumpy_sphere(8, 0.2);
  Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor> wide(mesh.vertices.rows(), 5);
  wide.setConstant(77);
  wide.leftCols<3>() = mesh.vertices;
  Random random(21);
  const Queries q(mesh, 60, random);
  const AllFaces truth(mesh.vertices, mesh.faces);
  const auto apart = wide.leftCols<3>();
  for (const Quality quality : {Quality::low, Quality::medium}) {
    Bvh tree(apart, mesh.faces, Volume::box, quality);
    expect_same(tree, truth, q, "tree");
    tree.refit(apart);
    expect_same(tree, truth, q, "after refit");
  }
  expect_same(HashGrid(apart, mesh.faces), truth, q, "grid");
  expect_same(AllFaces(apart, mesh.faces), truth, q, "all");
  wide.leftCols<3>().topRows(40) = q.starts.topRows(40);
  const TriangleMesh::Vertices starts = wide.leftCols<3>().topRows(40);
  const auto a = truth.closest(wide.leftCols<3>().topRows(40)), b = truth.closest(starts);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].point, b[i].point);
}

TEST(MeshIndex, StaysShallowForNestedSizes) {
  // Every split by area peels one face off: without a bound the depth would be the face count.
  constexpr int n = 900;
  TriangleMesh mesh;
  mesh.vertices.resize(3 * n, 3);
  mesh.faces.resize(n, 3);
  for (int f = 0; f < n; ++f) {
    const double s = std::pow(2.0, -f);
    mesh.vertices.middleRows(3 * f, 3) << s, 0, 0, 1.5 * s, 0, 0, s, 0.2 * s, 0.1 * s;
    mesh.faces.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  }
  EXPECT_LE(Bvh(mesh.vertices, mesh.faces).depth(), 64);
  expect_all_agree(mesh, 200, 11);
}

// Rays of one call go through the tree together: how many they are, and who goes beside whom, must
// not show. 513 is one more than a block; 3, 16 and 17 stand around the least and the usual number.
TEST(Bvh, AnswersARayAloneAsInCompany) {
  Random random(31);
  const TriangleMesh mesh = soup(700, 10, 2, random);
  Queries q(mesh, 513, random);
  for (Eigen::Index i = 0; i < q.starts.rows(); ++i)
    if (q.starts.row(i) == q.ends.row(i)) q.ends(i, 0) += 1;
  for (const Quality quality : {Quality::low, Quality::medium}) {
    const Bvh tree(mesh.vertices, mesh.faces, Volume::box, quality);
    for (const double reach : {0.5, 3.0, std::numeric_limits<double>::infinity()}) {
      std::vector<RayHit> alone;
      std::vector<std::uint8_t> blocked;
      for (Eigen::Index i = 0; i < q.starts.rows(); ++i) {
        const auto start = q.starts.row(i), end = q.ends.row(i);
        alone.push_back(tree.raycast(start, end - start, reach).front());
        blocked.push_back(tree.any_hit(start, end - start, reach).front());
      }
      for (const Eigen::Index count : {3, 15, 16, 17, 512, 513}) {
        const TriangleMesh::Vertices origins = q.starts.topRows(count);
        const TriangleMesh::Vertices directions = q.ends.topRows(count) - origins;
        const auto together = tree.raycast(origins, directions, reach);
        const auto any = tree.any_hit(origins, directions, reach);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
          ASSERT_EQ(together[i].face, alone[i].face) << i << " of " << count;
          ASSERT_EQ(together[i].distance, alone[i].distance) << i << " of " << count;
          ASSERT_EQ(any[i], blocked[i]) << i << " of " << count;
        }
      }
    }
  }
}

TEST(MeshIndex, HoldsNoFacesAtAll) {
  TriangleMesh mesh;
  mesh.vertices.resize(0, 3);
  mesh.faces.resize(0, 3);
  expect_all_agree(mesh, 20, 12);
}

TEST(MeshIndex, LeaksNothingThroughEdgesAndCorners) {
  // From the centre every ray must hit a closed surface: aimed exactly at vertices and at points of
  // edges, where single roundings decide between two faces.
  const TriangleMesh mesh = bumpy_sphere(40, 0.1);
  const int n = static_cast<int>(mesh.faces.rows());
  TriangleMesh::Vertices from = TriangleMesh::Vertices::Zero(4 * n, 3), to(4 * n, 3);
  Random random(13);
  for (int f = 0; f < n; ++f) {
    const auto corner = [&](int v) { return mesh.vertices.row(mesh.faces(f, v % 3)); };
    to.row(4 * f) = corner(f);
    for (int e = 0; e < 3; ++e) {
      const double w = random.uniform(0, 1);
      to.row(4 * f + 1 + e) = w * corner(e) + (1 - w) * corner(e + 1);
    }
  }
  for (const double shift : {0.0, 100.0, 1e6}) {
    const TriangleMesh::Vertices moved = mesh.vertices.array() + shift;
    const TriangleMesh::Vertices start = from.array() + shift;
    const Bvh tree(moved, mesh.faces);
    const HashGrid grid(moved, mesh.faces);
    int missed = 0;
    for (const std::uint8_t hit : tree.any_hit(start, to)) missed += hit == 0;
    for (const std::uint8_t hit : grid.any_hit(start, to)) missed += hit == 0;
    EXPECT_EQ(missed, 0) << shift;
  }
}

TEST(MeshIndex, TakesMinusZeroForZeroInARaysDirection) {
  // 1 / -0 is minus infinity. From inside a closed surface every ray must hit it.
  const TriangleMesh mesh = bumpy_sphere(16, 0.2);
  Random random(14);
  TriangleMesh::Vertices from = TriangleMesh::Vertices::Zero(300, 3), along(300, 3);
  for (int i = 0; i < 300; ++i) {
    along.row(i) = random.point(-1, 1);
    along(i, i % 3) = -0.0;
    if (i % 2 == 0) along(i, (i + 1) % 3) = -0.0;
  }
  for (const Quality quality : {Quality::low, Quality::medium, Quality::high}) {
    const Bvh tree(mesh.vertices, mesh.faces, Volume::box, quality);
    const auto hits = tree.raycast(from, along);
    // Adding 0 turns -0 into 0 and changes nothing else.
    const auto plain = tree.raycast(from, along.array() + 0.0);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      EXPECT_GE(hits[i].face, 0);
      EXPECT_EQ(hits[i].face, plain[i].face);
      EXPECT_EQ(hits[i].distance, plain[i].distance);
    }
  }
}

TEST(MeshIndex, GivesTheClosedFormsOfASquare) {
  // Two triangles of the unit square z = 0.
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 2, 3;
  const Bvh tree(mesh.vertices, mesh.faces);
  TriangleMesh::Vertices o(4, 3), d(4, 3);
  o << 0.7, 0.2, 3, 0.2, 0.7, -2, 0.5, 0.5, 1, 2, 2, 1;
  d << 0, 0, -2, 0, 0, 1, 0, 0, -1, 0, 0, -1;
  const auto hits = tree.raycast(o, d);
  EXPECT_EQ(hits[0].face, 0);
  EXPECT_EQ(hits[0].distance, 3);
  EXPECT_EQ(hits[1].face, 1);
  EXPECT_EQ(hits[1].distance, 2);
  EXPECT_EQ(hits[2].face, 0) << "of two faces at one distance the lower";
  EXPECT_EQ(hits[3].face, -1);
  EXPECT_EQ(tree.raycast(o, d, 2.999).front().face, -1);
  EXPECT_EQ(tree.raycast(o, d, 3).front().face, 0) << "the distance is inclusive";
  TriangleMesh::Vertices p(3, 3);
  p << 0.25, 0.5, -2, 4, 5, 0, -3, 0.5, 4;
  const auto near = tree.closest(p);
  // Distances 2, 5 and 5 are exact; the sums and roots behind them round to them within 1 ulp.
  EXPECT_DOUBLE_EQ(near[0].distance, 2);
  EXPECT_DOUBLE_EQ(near[1].distance, 5);
  EXPECT_DOUBLE_EQ(near[2].distance, 5);
  EXPECT_EQ(near[1].point, Eigen::Vector3d(1, 1, 0));
}

TEST(MeshIndex, TimesAreThoseOfExtendedPrecision) {
  Random random(14);
  const TriangleMesh mesh = soup(300, 4, 1, random);
  const AllFaces all(mesh.vertices, mesh.faces);
  using Vector = Eigen::Matrix<long double, 3, 1>;
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const TriangleMesh::Vertices a = random.point(0, 4), b = random.point(0, 4);
    const SegmentHit hit = all.segments(a, b).front();
    // Moller and Trumbore (1997), another route, in 64-bit mantissas.
    const Vector o = a.row(0).transpose().cast<long double>();
    const Vector d = b.row(0).transpose().cast<long double>() - o;
    long double best = 2;
    long double slack = 1;
    for (int f = 0; f < 300; ++f) {
      const Vector v = mesh.vertices.row(3 * f).transpose().cast<long double>();
      const Vector e1 = mesh.vertices.row(3 * f + 1).transpose().cast<long double>() - v;
      const Vector e2 = mesh.vertices.row(3 * f + 2).transpose().cast<long double>() - v;
      const Vector n = d.cross(e2), s = o - v, m = s.cross(e1);
      const long double det = e1.dot(n), u = s.dot(n) / det, w = d.dot(m) / det;
      const long double t = e2.dot(m) / det;
      if (u >= 0 && w >= 0 && u + w <= 1 && t >= 0 && t <= 1 && t < best) {
        best = t;
        // Sum of terms of size |e|^2 |d| against the determinant: the condition of t.
        slack = e1.norm() * e2.norm() * d.norm() / std::abs(det);
      }
    }
    if (best > 1) {
      EXPECT_EQ(hit.face, -1);
      continue;
    }
    ++hits;
    // About 30 rounded operations on numbers of that condition, coordinates up to 4 lengths.
    EXPECT_NEAR(hit.fraction, static_cast<double>(best),
                static_cast<double>(30 * 4 * slack) * 1e-16);
  }
  EXPECT_GT(hits, 500);
}

TEST(MeshIndex, RefusesWhatItCannotUse) {
  TriangleMesh mesh = bumpy_sphere(6, 0);
  TriangleMesh::Vertices bad = mesh.vertices;
  bad(3, 1) = std::nan("");
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    bad(3, 1) = x;
    for (const Volume volume : {Volume::box, Volume::sphere, Volume::oriented_box})
      for (const Quality quality : {Quality::low, Quality::medium, Quality::high})
        EXPECT_THROW(Bvh(bad, mesh.faces, volume, quality), InvalidInput);
    EXPECT_THROW(HashGrid(bad, mesh.faces), InvalidInput);
    EXPECT_THROW(AllFaces(bad, mesh.faces), InvalidInput);
  }
  TriangleMesh::Faces faces = mesh.faces;
  faces(2, 0) = static_cast<int>(mesh.vertices.rows());
  EXPECT_THROW(Bvh(mesh.vertices, faces), InvalidInput);
  faces(2, 0) = -1;
  EXPECT_THROW(HashGrid(mesh.vertices, faces), InvalidInput);
  const Bvh tree(mesh.vertices, mesh.faces);
  TriangleMesh::Vertices one = TriangleMesh::Vertices::Ones(1, 3);
  EXPECT_THROW((void)tree.raycast(one, 0 * one), InvalidInput);
  EXPECT_THROW((void)tree.raycast(one, one, -1), InvalidInput);
  EXPECT_THROW((void)tree.raycast(one, one, std::nan("")), InvalidInput);
  EXPECT_THROW((void)tree.raycast(one, mesh.vertices), InvalidInput);
  TriangleMesh::Vertices nan = one * std::nan("");
  EXPECT_THROW((void)tree.closest(nan), InvalidInput);
  EXPECT_THROW((void)tree.overlaps(nan, one), InvalidInput);
  EXPECT_THROW((void)tree.segments(nan, one), InvalidInput);
  EXPECT_THROW(HashGrid(mesh.vertices, mesh.faces, 0.0), InvalidInput);
  EXPECT_THROW(HashGrid(mesh.vertices, mesh.faces, 1e-9), InvalidInput);
}

TEST(HashGrid, AgreesAtEveryCellSize) {
  const TriangleMesh mesh = bumpy_sphere(12, 0.2);
  Random random(15);
  const Queries q(mesh, 300, random);
  const AllFaces truth(mesh.vertices, mesh.faces);
  for (const double size : {0.01, 0.1, 0.37, 1.0, 5.0, 1e6})
    expect_same(HashGrid(mesh.vertices, mesh.faces, size), truth, q, "grid");
}

TEST(Bvh, AnswersForMovedVerticesAfterRefit) {
  const TriangleMesh mesh = bumpy_sphere(16, 0.2);
  Random random(16);
  for (const Volume volume : {Volume::box, Volume::sphere, Volume::oriented_box})
    for (const Quality quality : {Quality::low, Quality::medium}) {
      Bvh tree(mesh.vertices, mesh.faces, volume, quality);
      TriangleMesh::Vertices moved = mesh.vertices;
      for (int step = 0; step < 4; ++step) {
        for (Eigen::Index v = 0; v < moved.rows(); ++v) moved.row(v) += random.point(-0.05, 0.05);
        if (step == 2) moved.array() += 1e5;
        tree.refit(moved);
        const Queries q({moved, mesh.faces}, 150, random);
        expect_same(tree, AllFaces(moved, mesh.faces), q, "after refit");
      }
    }
}

TEST(Bvh, RebuildsOnlyThePartThatTheMotionSpoilt) {
  // One patch of a soup is shuffled; the rest lies still.
  Random random(17);
  TriangleMesh mesh = soup(6000, 20, 0.2, random);
  Bvh tree(mesh.vertices, mesh.faces);
  tree.refit(mesh.vertices);
  EXPECT_EQ(tree.rebuilt_parts(), 0) << "nothing moved";
  mesh.vertices *= 3;
  mesh.vertices.array() += 7;
  tree.refit(mesh.vertices);
  EXPECT_EQ(tree.rebuilt_parts(), 0) << "growth and shift of the whole spoil nothing";
  for (int f = 0; f < 6000; ++f) {
    if (mesh.vertices(3 * f, 0) > 22 || mesh.vertices(3 * f, 1) > 22) continue;
    const Eigen::RowVector3d to = random.point(7, 22) - mesh.vertices.row(3 * f);
    for (int v = 0; v < 3; ++v) mesh.vertices.row(3 * f + v) += to;
  }
  tree.refit(mesh.vertices);
  EXPECT_GT(tree.rebuilt_parts(), 0);
  const Queries q(mesh, 60, random);
  expect_same(tree, AllFaces(mesh.vertices, mesh.faces), q, "after mending");
}

TEST(Bvh, RefusesToRefitAnotherMeshAndStaysAsItWas) {
  const TriangleMesh mesh = bumpy_sphere(8, 0.1);
  Random random(18);
  const Queries q(mesh, 60, random);
  Bvh tree(mesh.vertices, mesh.faces);
  TriangleMesh::Vertices bad = mesh.vertices.topRows(5);
  EXPECT_THROW(tree.refit(bad), InvalidInput);
  bad = 2 * mesh.vertices;
  bad(4, 2) = std::nan("");
  EXPECT_THROW(tree.refit(bad), InvalidInput);
  expect_same(tree, AllFaces(mesh.vertices, mesh.faces), q, "unchanged");
}

}  // namespace
}  // namespace carom
