// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/rotation.hpp"

#include "step/stages/resisted.hpp"
#include "step/world.hpp"

namespace carom {

Eigen::Vector3d twist_of(const World& world, const TorsionSpring& spring) {
  const Eigen::Quaterniond at = world.states.pose(*world.scene.row(spring.body)).orientation;
  return rotation_logarithm(at * spring.rest.normalized().conjugate());
}

void run_torsion(World& world) {
  BodyStates& s = world.states;
  if (world.has_mean_momentum.empty()) {
    world.mean_momentum = s.angular_momentum;
    world.has_mean_momentum.assign(s.size(), 0);
  }
  for (const Effect& effect : world.scene.effects) {
    const auto* spring = std::get_if<TorsionSpring>(&effect);
    if (!spring) continue;
    const int i = *world.scene.row(spring->body);
    if (!s.moves[i]) continue;
    const Eigen::Quaterniond q = s.orientation[i];
    const Eigen::Vector3d a = s.inverse_moments[i];
    const Eigen::Vector3d theta = q.conjugate() * twist_of(world, *spring);
    const Eigen::Vector3d before = q.conjugate() * world.angular_momentum_before[i];
    const Eigen::Vector3d kick = q.conjugate() * s.angular_momentum[i] - before;
    Eigen::Vector3d after = before + kick, mean = before + 0.5 * kick;
    for (int k = 0; k < 3; ++k) {
      if (!(a[k] > 0)) continue;
      const Resisted w =
          sprung(before[k], kick[k], theta[k], spring->stiffness, spring->damping, a[k], world.dt);
      after[k] = w.after, mean[k] = w.mean;
      world.dissipated += w.dissipated;
      world.work += kick[k] * a[k] * (w.mean - (before[k] + 0.5 * kick[k]));
    }
    s.angular_momentum.set(i, q * after);
    world.mean_momentum.set(i, q * mean);
    world.has_mean_momentum[i] = 1;
  }
}

}  // namespace carom
