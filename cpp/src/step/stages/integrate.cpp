// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"
#include "carom/step/rotation.hpp"

#include "step/world.hpp"

namespace carom {
namespace {

bool is_lost(const BodyStates& s, int i) {
  return !(s.velocity[i].cwiseAbs().maxCoeff() < tolerance::lost_state) ||
         !(s.angular_momentum[i].cwiseAbs().maxCoeff() < tolerance::lost_state);
}

/// Holds the body where it was last seen: a lost state must not spread.
void freeze(World& world, int i) {
  Scene::Body& body = world.scene.bodies[i];
  body.is_static = true;
  world.states.velocity.set(i, Eigen::Vector3d::Zero());
  world.states.angular_momentum.set(i, Eigen::Vector3d::Zero());
  world.states.moves[i] = 0;
  world.states.mass[i] = world.states.inverse_mass[i] = 0;
  world.states.inverse_moments.set(i, Eigen::Vector3d::Zero());
  world.report.frozen.push_back(body.id);
  world.plan_is_stale = true;
}

/// One coordinate. The mean velocity is exact under constant forces, or drag knows it; where
/// contacts act, they tell the way.
void move(double* x, const double* v, const double* before, const double* mean, double dt,
          const std::vector<int>& rows, const std::uint8_t* pushed, const double* displacement) {
  for (const int i : rows) {
    const double free = dt * (mean ? mean[i] : 0.5 * (v[i] + before[i]));
    x[i] += pushed && pushed[i] ? displacement[i] : free;
  }
}

/// The mean of the momentum before and after the torques: a drift between two half kicks.
const Array3& turning_momentum(World& world, const std::uint8_t* pushed) {
  const Array3& now = world.states.angular_momentum;
  const bool resisted = !world.has_mean_momentum.empty();
  // Without a torque it did not change but by contacts, and those tell how they turned the body.
  if (!resisted && !world.plan.runs(StageKind::applied_wrench)) return now;
  world.turning_momentum = now;
  for (const int i : world.plan.movers)
    if (!pushed || !pushed[i])
      world.turning_momentum.set(i, resisted && world.has_mean_momentum[i]
                                        ? world.mean_momentum[i]
                                        : 0.5 * (now[i] + world.angular_momentum_before[i]));
  return world.turning_momentum;
}

/// Turns the body by `angle` on top of its free motion, as contacts told. A body of unequal moments
/// takes its angular momentum along: left in the world it would point along other axes of the body,
/// and of a rod's transverse spin 1e-2 rad more or less make thousands of times its energy.
void turn_more(BodyStates& s, int i, const Eigen::Vector3d& angle) {
  if (angle.isZero(0)) return;
  const Eigen::Quaterniond turn = rotation_exponential(angle);
  s.orientation.set(i, (turn * s.orientation[i]).normalized());
  const Eigen::Vector3d moments = s.moments[i];
  if (moments.maxCoeff() - moments.minCoeff() > tolerance::equal_moments * moments.maxCoeff())
    s.angular_momentum.set(i, turn * s.angular_momentum[i]);
}

}  // namespace

void run_integrate(World& world) {
  BodyStates& s = world.states;
  for (const int i : world.plan.movers)
    if (is_lost(s, i)) freeze(world, i);
  if (!world.report.frozen.empty())
    std::erase_if(world.plan.movers, [&](int i) { return !s.moves[i]; });
  const std::vector<int>& rows = world.plan.movers;
  const std::uint8_t* pushed =
      world.plan.runs(StageKind::solve) ? world.solver.motion().decided.data() : nullptr;

  const bool dragged = world.plan.runs(StageKind::drag);
  const Array3& way = world.solver.motion().displacement;
  for (auto axis : {&Array3::x, &Array3::y, &Array3::z})
    move((s.position.*axis).data(), (s.velocity.*axis).data(), (world.velocity_before.*axis).data(),
         dragged ? (world.mean_velocity.*axis).data() : nullptr, world.dt, rows, pushed,
         (way.*axis).data());

  const Array3& l = turning_momentum(world, pushed);
  const Array3& a = s.inverse_moments;
  Array4& q = s.orientation;
  advance_rotation(world.options.integrator,
                   {q.x.data(), q.y.data(), q.z.data(), q.w.data(), l.x.data(), l.y.data(),
                    l.z.data(), a.x.data(), a.y.data(), a.z.data()},
                   rows, world.dt, world.report.rotation);
  if (pushed)
    for (const int i : rows)
      if (pushed[i]) turn_more(s, i, world.solver.motion().turn[i]);
}

}  // namespace carom
