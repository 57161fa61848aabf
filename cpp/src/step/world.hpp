// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "carom/broad/box_tree.hpp"
#include "carom/contact/solver.hpp"
#include "carom/geometry/frame.hpp"
#include "carom/narrow/contacts.hpp"
#include "carom/scene/scene.hpp"
#include "carom/state/body_states.hpp"
#include "carom/state/report.hpp"
#include "carom/step/plan.hpp"
#include "carom/step/simulation.hpp"

#include "contact/manifold_cache.hpp"
#include "numerics/workers.hpp"
#include "step/pair_filter.hpp"
#include "step/sweep.hpp"

namespace carom {

/// A force or an impulse asked for the next step, at the centre of mass, world axes.
struct Request {
  int row = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_impulse = Eigen::Vector3d::Zero();
};

/// Simulated time as whole steps since the length of a step last changed: a sum would lose dt in a
/// long run, and end a step early or late in a short one.
struct SimulatedClock {
  double base = 0, dt = 0;
  std::int64_t ticks = 0;

  void set(double time) { *this = {time, 0, 0}; }
  [[nodiscard]] double now() const { return base + static_cast<double>(ticks) * dt; }
  void tick(double step) {
    if (step != dt) *this = {now(), step, 0};
    ++ticks;
  }
};

/// For how long a body has stayed near a place. Measured by where it is, not by its speed: what
/// trembles in a heap comes to rest, what creeps on does not.
struct Still {
  double seconds = 0;
  std::array<double, 3> position{};     ///< m
  std::array<double, 4> orientation{};  ///< x y z w
};

/// A point that repulsion pushes apart.
struct Push {
  std::size_t contact = 0;
  double target = 0;    ///< m/s, change of the normal velocity
  double mobility = 0;  ///< 1/kg, along the normal
  double impulse = 0;   ///< N s
};

/// What contacts ask of a body, of all bodies side by side: the scene's own are far apart.
struct Touch {
  double friction = 0, restitution = 0, rolling_resistance = 0, spinning_resistance = 0;
};

/// What the stages of a step share. Scratch keeps its capacity: a warm step allocates nothing.
struct World {
  Scene scene;
  SimulationOptions options;
  std::unique_ptr<Workers> workers;  ///< none on one thread
  BodyStates states;
  Plan plan;
  bool plan_is_stale = true;
  std::vector<Request> requests;
  SimulatedClock clock;
  Report report;
  double dissipated = 0, work = 0, repulsion = 0;  ///< J since the start

  // of the step under way
  double dt = 0;
  Array3 velocity_before;          ///< before the forces: their mean is exact for constant forces
  Array3 angular_momentum_before;  ///< the same of rotation
  Array3 turning_momentum;         ///< scratch: the mean of both
  ContactSolver solver;
  Array3 mean_velocity;  ///< of rows whose drag knows it better
  Array3 mean_momentum;  ///< of rows whose drag or spring knows it better
  std::vector<std::uint8_t> has_mean_momentum;
  Array4 orientation_halfway;  ///< of rows with rotational drag
  contact::ManifoldCache manifold_cache;
  std::vector<std::uint8_t> asleep;      ///< by row; empty while nothing sleeps
  std::vector<std::int32_t> bed;         ///< by row: the island it fell asleep with
  std::vector<Still> still;              ///< by row
  std::vector<double> island_still;      ///< scratch: by lowest row
  std::vector<Contact> asleep_contacts;  ///< what they start from when they wake
  std::vector<Aabb> boxes;
  std::vector<std::uint8_t> boxed;    ///< by row: stands still, and has its box since the last plan
  std::vector<Touch> touch;           ///< by row
  std::vector<std::uint8_t> is_ball;  ///< by row
  std::vector<Frame> frames;          ///< of bodies in pairs, as the step began
  std::vector<Eigen::Quaterniond> turns;  ///< the same rotations
  std::vector<std::uint8_t> framed;
  std::vector<double> swing;        ///< m that turning can carry a point of one with a frame
  std::vector<double> reach;        ///< m a point of the body can travel in the step
  BoxTree box_tree;                 ///< keeps the pairs of the step
  PairFilter filter;                ///< of the scene's groups and named pairs
  std::span<const BodyPair> pairs;  ///< of the step: those that may meet
  std::vector<Manifold> manifolds;  ///< of the pair at hand
  std::vector<Contact> contacts, contacts_before;
  SweepWork sweep;
  std::vector<Push> pushes;  ///< scratch of the repulsion
};

/// Of all UniformGravity effects, m/s^2.
[[nodiscard]] Eigen::Vector3d gravity_of(const World& world);
/// How far a body may turn in the step, rad: |L| over its least moment, which no frame is needed
/// for and no tumbling exceeds.
[[nodiscard]] inline double turn_bound(const World& world, int row) {
  const BodyStates& s = world.states;
  return world.dt * s.angular_momentum[row].norm() * s.inverse_moments[row].maxCoeff();
}
/// Rotation vector of the spring's body from its rest, rad, world axes.
[[nodiscard]] Eigen::Vector3d twist_of(const World& world, const TorsionSpring& spring);

// The stages, one file each.
void run_gravity(World& world);
void run_applied_wrench(World& world);
void run_drag(World& world);
void run_torsion(World& world);
void run_pairs(World& world);
void run_contacts(World& world);
void run_repulsion(World& world);
void run_solve(World& world);
void run_integrate(World& world);
void run_sweep(World& world);

/// Lets islands sleep that have been still for long enough. After the step.
void fall_asleep(World& world);
/// Wakes the island the row sleeps with; every one for row -1.
void wake(World& world, int row);
/// Wakes what something awake may touch in this step. True when the pairs must be found again.
[[nodiscard]] bool wake_touched(World& world);

}  // namespace carom
