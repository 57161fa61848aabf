// SPDX-License-Identifier: Apache-2.0
// Bodies thinner than contacts look ahead: their upper corners are within reach as well as the
// lower ones, and it is the lower ones they lie on.
#include <gtest/gtest.h>

#include "contact/stage.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

struct Thin {
  Vector3d extents;
  Ccd ccd;
};

class ThinBodies : public ::testing::TestWithParam<Thin> {};

TEST_P(ThinBodies, ComeToRestFlat) {
  const auto& [extents, ccd] = GetParam();
  for (const bool mesh_floor : {false, true}) {
    Scene scene = stage::ground(0.3);
    if (mesh_floor) {
      scene.bodies[0].shape = Box{{10, 10, 1}};
      scene.bodies[0].pose.position.z() = -0.5;
    }
    BodyDefinition body = stage::box({0, 0, 0.3}, 1);
    body.shape = Box{extents};
    body.friction = 0.3;
    body.velocity.x() = 1;
    body.pose.orientation = Eigen::Quaterniond(0.95, 0.3, 0.1, 0).normalized();
    body.ccd = ccd;
    scene.add(body);
    Simulation simulation(scene);
    simulation.advance(3);
    const Pose pose = simulation.states().pose(1);
    double deepest = 0;
    for (const Contact& c : simulation.contacts()) deepest = std::min(deepest, c.separation);
    // One of its axes stands upright, and half of that edge is how high it lies. 1e-6: the solver
    // leaves 1e-7 m/s, ten steps of it.
    const Vector3d up = pose.orientation.conjugate() * Vector3d::UnitZ();
    int axis;
    EXPECT_NEAR(up.cwiseAbs().maxCoeff(&axis), 1, 1e-6);
    EXPECT_NEAR(pose.position.z(), 0.5 * extents[axis], 1e-6);
    EXPECT_GT(deepest, -1e-6);
    EXPECT_LT(simulation.states().velocity[1].norm(), 1e-4);
    EXPECT_GE(simulation.contacts().size(), 4u);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ThinBodies,
                         ::testing::Values(Thin{{0.2, 0.2, 0.01}, Ccd::never},
                                           Thin{{0.2, 0.2, 0.01}, Ccd::automatic},
                                           Thin{{0.2, 0.2, 0.001}, Ccd::automatic},
                                           Thin{{0.01, 0.01, 0.01}, Ccd::automatic},
                                           Thin{{0.2, 0.2, 0.01}, Ccd::always}));

}  // namespace
}  // namespace carom
