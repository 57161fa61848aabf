// SPDX-License-Identifier: Apache-2.0
// A program outside the tree that links the library alone.
#include <carom/carom.hpp>
#include <cmath>
#include <iostream>

int main() {
  carom::Scene scene;
  scene.add({.name = "ground", .shape = carom::Plane{}, .is_static = true});
  scene.add({.name = "crate",
             .shape = carom::Box{{0.2, 0.2, 0.2}},
             .mass = 2.0,
             .pose = {.position = {0, 0, 1}}});
  scene.effects.emplace_back(carom::UniformGravity{});

  carom::Simulation simulation(scene);
  const carom::Report report = simulation.advance(2.0);
  const double height = simulation.states().pose(1).position.z();
  std::cout << "crate rests at " << height << " m after " << report.steps << " steps\n";
  return std::abs(height - 0.1) < 1e-3 ? 0 : 1;
}
