// SPDX-License-Identifier: Apache-2.0
// A crate falls on the ground, is pushed, and slides to rest.
#include <cstdio>

#include "carom/carom.hpp"

int main() {
  carom::Scene scene;
  scene.add({.name = "ground", .shape = carom::Plane{}, .is_static = true});
  const carom::BodyId crate = scene.add({.name = "crate",
                                         .shape = carom::Box{{0.2, 0.2, 0.2}},
                                         .mass = 2.0,
                                         .pose = {.position = {0, 0, 1}}});
  scene.effects.emplace_back(carom::UniformGravity{{0, 0, -9.81}});

  carom::Simulation simulation(scene);
  std::printf("%s\n", simulation.plan().to_string().c_str());

  simulation.advance(1.0);
  simulation.apply_impulse(crate, {4, 0, 0});  // 4 N s on 2 kg: 2 m/s
  const carom::Report report = simulation.advance(1.0);

  const int row = *simulation.scene().row(crate);
  const Eigen::Vector3d p = simulation.states().pose(row).position;
  const carom::Energy energy = simulation.energy();
  std::printf("crate at (%.3f, %.3f, %.3f) m after %.1f s\n", p.x(), p.y(), p.z(),
              simulation.time());
  std::printf("%lld steps took %.2g s; %.2f J went into friction and impact\n",
              static_cast<long long>(report.steps), report.wall_seconds, energy.dissipated);
  // v^2 / (2 mu g) with mu = sqrt(0.5 * 0.5)
  return p.x() > 0.35 && p.x() < 0.45 ? 0 : 1;
}
