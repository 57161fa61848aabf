// SPDX-License-Identifier: Apache-2.0
#include "carom/scene/scene.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

namespace carom {
namespace {

struct BadBody {
  const char* case_name;
  BodyDefinition body;
  const char* field;
};
class Refused : public testing::TestWithParam<BadBody> {};

TEST_P(Refused, NamesTheFieldAndLeavesTheSceneAlone) {
  Scene scene;
  scene.add({.name = "taken", .shape = Sphere{1}});
  try {
    scene.add(GetParam().body);
    FAIL() << "was accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.field, GetParam().field) << error.what();
  }
  EXPECT_EQ(scene.bodies.size(), 1U);
}

const double nan = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    Bodies, Refused,
    testing::Values(
        BadBody{"taken_name", {.name = "taken", .shape = Sphere{1}}, "name"},
        BadBody{"bad_name", {.name = "1st", .shape = Sphere{1}}, "name"},
        BadBody{"zero_radius", {.name = "b", .shape = Sphere{0}}, "b.shape.radius"},
        BadBody{"nan_extent", {.name = "b", .shape = Box{{1, nan, 1}}}, "b.shape.extents"},
        BadBody{"negative_mass", {.name = "b", .shape = Sphere{1}, .mass = -2.0}, "b.mass"},
        BadBody{
            "two_ways", {.name = "b", .shape = Sphere{1}, .mass = 1.0, .density = 1.0}, "b.mass"},
        BadBody{"moving_plane", {.name = "b", .shape = Plane{}}, "b.shape"},
        BadBody{"nan_velocity",
                {.name = "b", .shape = Sphere{1}, .velocity = {0, nan, 0}},
                "b.velocity"},
        BadBody{
            "negative_friction", {.name = "b", .shape = Sphere{1}, .friction = -1}, "b.friction"},
        BadBody{"bouncy", {.name = "b", .shape = Sphere{1}, .restitution = 1.1}, "b.restitution"},
        BadBody{"moving_static",
                {.name = "b", .shape = Sphere{1}, .is_static = true, .velocity = {1, 0, 0}},
                "b.velocity"}),
    [](const auto& test) { return std::string(test.param.case_name); });

TEST(Scene, ComparesNoNamesToAddManyBodies) {
  // A scan would compare n (n - 1) / 2 = 2.1 million names. Hashes of 64 bits let two names meet by
  // chance once in 2^40 such scenes; four leave room for a poorer hash.
  constexpr int n = 2048;
  Scene scene;
  for (int i = 0; i < n; ++i) {
    std::string name = "b";  // "b" + a string sets a false -Wrestrict of g++ 12 off
    name += std::to_string(i);
    scene.add({.name = i % 2 == 0 ? "" : name, .shape = Sphere{1}});
  }
  EXPECT_LE(scene.names_compared(), 4);
  EXPECT_EQ(scene.find("body_1024")->value, 1024U);
  EXPECT_EQ(scene.find("b1025")->value, 1025U);
  EXPECT_THROW(scene.add({.name = "b1025", .shape = Sphere{1}}), InvalidInput);
}

TEST(Scene, FindsNamesAfterRemovalRenamingAndCopy) {
  Scene scene;
  const BodyId a = scene.add({.name = "a", .shape = Sphere{1}});
  const BodyId b = scene.add({.name = "b", .shape = Sphere{1}});
  scene.remove(a);
  EXPECT_FALSE(scene.find("a"));
  EXPECT_EQ(scene.find("b"), b);
  const BodyId again = scene.add({.name = "a", .shape = Sphere{1}});
  Scene copy = scene;
  EXPECT_EQ(copy.find("a"), again);
  EXPECT_THROW(copy.add({.name = "b", .shape = Sphere{1}}), InvalidInput);
  // Bodies are plain data: whatever is done to them, names are those they carry.
  copy.bodies[0].name = "c";
  EXPECT_EQ(copy.find("c"), b);
  EXPECT_FALSE(copy.find("b"));
  copy.bodies.erase(copy.bodies.begin());
  EXPECT_FALSE(copy.find("c"));
  EXPECT_NO_THROW(copy.add({.name = "c", .shape = Sphere{1}}));
  EXPECT_THROW(copy.add({.name = "c", .shape = Sphere{1}}), InvalidInput);
}

TEST(Scene, NeverUsesAnIdAgain) {
  Scene scene;
  const BodyId first = scene.add({.shape = Sphere{1}});
  const BodyId second = scene.add({.shape = Sphere{1}});
  scene.remove(first);
  EXPECT_EQ(scene.row(second), 0);
  EXPECT_EQ(scene.row(first), std::nullopt);
  EXPECT_GT(scene.add({.shape = Sphere{1}}).value, second.value);
  EXPECT_THROW(scene.remove(first), InvalidInput);
}

TEST(Scene, MassScalesTheInertiaOfTheShape) {
  const MassProperties p = mass_properties({.name = "b", .shape = Sphere{2}, .mass = 5.0});
  EXPECT_EQ(p.mass, 5);
  EXPECT_NEAR(p.inertia(0, 0), 0.4 * 5 * 4, 1e-14 * 8);  // a handful of rounded products
}

}  // namespace
}  // namespace carom
