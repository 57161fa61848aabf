// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "carom/bodies/mesh_moments.hpp"
#include "carom/bodies/shells.hpp"
#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "bodies/near.hpp"
#include "box_mesh.hpp"

namespace carom {
namespace {

constexpr double u = tolerance::unit_roundoff;

struct Slab {
  const char* name;
  Eigen::Vector3d lower, upper;
};
class HardSlab : public testing::TestWithParam<Slab> {};

TEST_P(HardSlab, MeshHasTheMomentsOfTheBox) {
  const auto& [name, lower, upper] = GetParam();
  const Eigen::Vector3d e = upper - lower;  // exact: powers of two
  const MassProperties mesh = MassProperties::mesh(box_mesh(lower, upper), 1000);
  const MassProperties box = MassProperties::box(e, 1000);
  // 1e-12 is asked for; double-double sums leave the last roundings
  EXPECT_NEAR(mesh.mass, box.mass, 4 * u * box.mass);
  EXPECT_TRUE(near(mesh.com, 0.5 * (lower + upper), 2 * u * upper.norm()));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(mesh.inertia(k, k), box.inertia(k, k), 8 * u * box.inertia(k, k));
}

INSTANTIATE_TEST_SUITE_P(
    AllPlaces, HardSlab,
    testing::Values(Slab{"cube", {-1, -1, -1}, {1, 1, 1}}, Slab{"corner", {0, 0, 0}, {1, 2, 4}},
                    Slab{"needle", {0, 0, 0}, {0x1p-13, 0x1p-13, 1}},
                    Slab{"plate", {0, 0, 0}, {1, 1, 0x1p-20}},
                    Slab{"sliver", {0, 0, 0}, {0x1p-23, 1, 0x1p-3}},
                    Slab{"a_million_metres_away",
                         {0x1p20, 0x1p20, 0x1p20},
                         {0x1p20 + 1, 0x1p20 + 2, 0x1p20 + 0x1p-10}},
                    Slab{"thin_and_far", {0x1p20, 0, -0x1p20}, {0x1p20 + 1, 0x1p-20, -0x1p20 + 1}}),
    [](const auto& slab) { return std::string(slab.param.name); });

TEST(MeshMoments, UseDoubleDoubleOnlyWhereItIsCalledFor) {
  EXPECT_FALSE(volume_moments(box_mesh({-1, -1, -1}, {1, 1, 1})).extended);
  EXPECT_TRUE(volume_moments(box_mesh({0, 0, 0}, {1, 1, 0x1p-20})).extended);
}

TEST(MeshBody, WithACavityIsTheDifferenceOfTwoBoxes) {
  const TriangleMesh mesh =
      joined(box_mesh({0, 0, 0}, {2, 3, 4}), reversed(box_mesh({0.5, 0.5, 0.5}, {1.5, 2.5, 3.5})));
  const MassProperties body = MassProperties::mesh(mesh, 1);
  EXPECT_NEAR(body.mass, 24 - 6, 4 * u * 24);
  // same centre, so moments subtract: 24/12 (3^2 + 4^2) - 6/12 (2^2 + 3^2)
  EXPECT_NEAR(body.inertia(0, 0), 50 - 6.5, 8 * u * 50);
  ASSERT_EQ(body.warnings.size(), 1u);
  EXPECT_NE(body.warnings[0].find("1 cavity"), std::string::npos);
}

TEST(MeshBody, IsThatOfItsPartsAddedUp) {
  // Two boxes face to face as one mesh, and as a compound.
  const TriangleMesh a = box_mesh({0, 0, 0}, {1, 2, 3}), b = box_mesh({1, 0.5, 0.5}, {5, 1, 1});
  const MassProperties both = MassProperties::mesh(joined(a, b), 300);
  const MassProperties sum = MassProperties::mesh(a, 300) + MassProperties::mesh(b, 300);
  EXPECT_NEAR(both.mass, sum.mass, 8 * u * sum.mass);
  EXPECT_TRUE(near(both.com, sum.com, 8 * u * 5));
  EXPECT_TRUE(near(both.inertia, sum.inertia, 32 * u * sum.inertia.norm()));
}

TEST(MeshBody, RefusesWhatEnclosesNothing) {
  TriangleMesh lidless = box_mesh({0, 0, 0}, {1, 1, 1});
  lidless.faces.conservativeResize(10, 3);
  EXPECT_THROW((void)MassProperties::mesh(lidless, 1), InvalidInput);
  EXPECT_NO_THROW((void)shell::mesh(lidless, 1));
  EXPECT_THROW((void)MassProperties::mesh(box_mesh({0, 0, 0}, {1, 1, 0}), 1), InvalidInput);
  // two equal solids wound against each other enclose nothing
  const TriangleMesh a = box_mesh({0, 0, 0}, {1, 1, 1});
  TriangleMesh twice = joined(a, reversed(a));
  EXPECT_THROW((void)MassProperties::mesh(twice, 1), InvalidInput);
}

TEST(MeshBody, SaysWhenItsVolumeIsTiny) {
  const auto warnings = [](double z) {
    return MassProperties::mesh(box_mesh({0, 0, 0}, {1, 1, z}), 1).warnings;
  };
  // mean thickness is z, diagonal 1.41: the limit lies at z = 1.41e-6
  EXPECT_TRUE(warnings(3e-6).empty());
  ASSERT_EQ(warnings(1e-6).size(), 1u);
  EXPECT_NE(warnings(1e-6)[0].find("tiny volume"), std::string::npos);
}

TEST(MeshShell, OfABoxIsTheBoxShell) {
  const MassProperties mesh = shell::mesh(box_mesh({-0.5, -1, -1.5}, {0.5, 1, 1.5}), 7);
  const MassProperties box = shell::box({1, 2, 3}, 7);
  EXPECT_NEAR(mesh.mass, box.mass, 16 * u * box.mass);
  EXPECT_TRUE(near(mesh.inertia, box.inertia, 32 * u * box.inertia.norm()));
}

}  // namespace
}  // namespace carom
