// SPDX-License-Identifier: Apache-2.0
#include "carom/step/plan.hpp"

#include <gtest/gtest.h>

namespace carom {
namespace {

std::string running(const Scene& scene) {
  std::string names;
  for (const Stage& stage : compile(scene).stages)
    if (stage.on) names += std::string(name_of(stage.kind)) + ' ';
  return names;
}

const Stage& stage(const Plan& plan, StageKind kind) {
  for (const Stage& s : plan.stages)
    if (s.kind == kind) return s;
  throw std::logic_error("no such stage");
}

TEST(Plan, AnEmptySceneRunsNothing) {
  EXPECT_EQ(running(Scene{}), "");
}

TEST(Plan, ALoneBodyInSpaceOnlyIntegrates) {
  Scene scene;
  scene.add({.name = "brick", .shape = Box{{1, 2, 3}}});
  EXPECT_EQ(running(scene), "integrate ");
  EXPECT_NE(
      stage(compile(scene), StageKind::integrate).reason.find("gyroscopic term on: 1 body has"),
      std::string::npos);
}

TEST(Plan, ASphereHasNoGyroscopicTerm) {
  Scene scene;
  scene.add({.shape = Sphere{1}});
  scene.add({.shape = Box{{2, 2, 2}}});  // a cube's tensor is a sphere's
  EXPECT_NE(stage(compile(scene), StageKind::integrate).reason.find("gyroscopic term off"),
            std::string::npos);
}

TEST(Plan, GravityAloneNeedsNoPairs) {
  Scene scene;
  scene.add({.shape = Sphere{1}});
  scene.effects.emplace_back(UniformGravity{});
  EXPECT_EQ(running(scene), "gravity integrate ");
}

TEST(Plan, AGroundUnderABallCallsForContacts) {
  Scene scene;
  scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
  EXPECT_EQ(running(scene), "");  // nothing moves
  scene.add({.shape = Sphere{1}});
  EXPECT_EQ(running(scene), "pairs contacts solve integrate sweep ");
}

TEST(Plan, NobodyIsFollowedWhereAllMayPass) {
  Scene scene;
  scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
  scene.add({.shape = Sphere{1}, .ccd = Ccd::never});
  EXPECT_EQ(running(scene), "pairs contacts solve integrate ");
}

TEST(Plan, SaysWhyEachStageIsOff) {
  for (const Stage& s : compile(Scene{}).stages) {
    EXPECT_FALSE(s.on);
    EXPECT_FALSE(s.reason.empty()) << name_of(s.kind);
  }
}

TEST(Plan, IsPure) {
  Scene scene;
  scene.add({.shape = Box{}});
  EXPECT_EQ(compile(scene).to_string(), compile(scene).to_string());
}

}  // namespace
}  // namespace carom
