// SPDX-License-Identifier: Apache-2.0
// Prints the table of all pairs of shapes: `contact_pairs_bench > pairs.md`. Errors are the largest
// met; "search" is against a plain search over directions and is given for convex pairs; "swapped"
// is collide(a, b) against collide(b, a); "moved" is both carried along by one rigid motion.
#include <chrono>
#include <cstdio>

#include "carom/geometry/sdf.hpp"

#include "../../tests/cpp/narrow/shapes_for_tests.hpp"
#include "../../tests/cpp/narrow/support_reference.hpp"

using namespace carom;
using namespace carom::testing;
using Eigen::Vector3d;

namespace {

std::vector<Shape> every_shape() {
  std::mt19937_64 random(3);
  TriangleMesh::Vertices cloud(40, 3);
  for (int i = 0; i < 40; ++i) cloud.row(i) = 0.5 * random_vector(random).normalized().transpose();
  const auto ball = [](const Vector3d& p) { return p.norm() - 0.4; };
  HeightField::Heights hills(8, 8);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) hills(i, j) = 0.1 * std::sin(i) * std::cos(j);
  TriangleMesh::Vertices beads(3, 3);
  beads << -0.3, 0, 0, 0, 0.1, 0, 0.3, 0, 0;
  return {Sphere{0.4},
          Box{{0.5, 0.7, 0.9}},
          Plane{{0.1, 0.2, 1}, 0.1},
          Mesh(l_block()),
          Capsule{0.25, 0.6},
          Cylinder{0.35, 0.8},
          Cone{0.4, 0.9},
          Ellipsoid{{0.3, 0.4, 0.6}},
          ConvexHull(cloud),
          Sdf{std::make_shared<const SdfGrid>(SdfGrid::from_function(
              ball, {Vector3d::Constant(-0.4), Vector3d::Constant(0.4)}, 0.04))},
          HeightField(hills, 0.2),
          ParticleSet{beads, 0.15},
          Compound({{Box{{0.4, 0.4, 0.4}}, {}},
                    {Sphere{0.2}, {Vector3d(0.3, 0, 0), Eigen::Quaterniond::Identity()}}})};
}

Pose carried(const Pose& by, const Pose& pose) {
  return {by * pose.position, by.orientation * pose.orientation};
}

struct Row {
  int met = 0;
  double search = -1, swapped = 0, moved = 0, nanoseconds = 0;
};

bool is_static(const Shape& s) {
  return std::holds_alternative<Plane>(s) || std::holds_alternative<HeightField>(s);
}

Row measure(const Shape& a, const Shape& b, std::mt19937_64& random) {
  Row row;
  const double margin = 0.02;
  std::vector<Manifold> out;
  const bool searchable = !std::isnan(support(a, {}, Vector3d::UnitZ())) &&
                          !std::isnan(support(b, {}, Vector3d::UnitZ()));
  std::chrono::nanoseconds spent{0};
  int asked = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Pose pa = random_pose(random, 0.2);
    const Pose pb = random_pose(random, 0.9);
    out.clear();
    const auto start = std::chrono::steady_clock::now();
    collide(a, pa, b, pb, margin, out);
    spent += std::chrono::steady_clock::now() - start;
    ++asked;
    const double ab = deepest(out);
    if (out.empty()) continue;
    ++row.met;
    row.swapped = std::max(row.swapped, std::abs(ab - deepest(contacts(b, pb, a, pa, margin))));
    const Pose by = random_pose(random, 3);
    const double there = deepest(contacts(a, carried(by, pa), b, carried(by, pb), margin));
    row.moved = std::max(row.moved, std::abs(ab - there));
    if (searchable && trial < 12) {
      const double reference = largest_gap(a, pa, b, pb, random, 600, 3);
      row.search = std::max(
          {row.search, reference - ab, std::abs(ab - gap(a, pa, b, pb, out.front().normal))});
    }
  }
  row.nanoseconds = static_cast<double>(spent.count()) / asked;
  return row;
}

}  // namespace

int main() {
  const auto shapes = every_shape();
  std::mt19937_64 random(29);
  std::printf("| a | b | met of 60 | search, m | swapped, m | moved, m | time, us |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (std::size_t j = i; j < shapes.size(); ++j) {
      if (is_static(shapes[i]) && is_static(shapes[j])) continue;
      const Row r = measure(shapes[i], shapes[j], random);
      char search[32] = "";
      if (r.search >= 0) std::snprintf(search, sizeof search, "%.0e", r.search);
      std::printf("| %s | %s | %d | %s | %.0e | %.0e | %.2f |\n", name_of(shapes[i]).data(),
                  name_of(shapes[j]).data(), r.met, search, r.swapped, r.moved,
                  r.nanoseconds / 1000);
    }
}
