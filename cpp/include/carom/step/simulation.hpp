// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "carom/contact/solver.hpp"
#include "carom/scene/scene.hpp"
#include "carom/state/body_states.hpp"
#include "carom/state/report.hpp"
#include "carom/step/integrators.hpp"
#include "carom/step/plan.hpp"

namespace carom {

struct World;  // what the stages share; step/world.hpp

struct SimulationOptions {
  double dt = 1.0 / 60;                               ///< s, > 0; the largest step taken
  Integrator integrator = Integrator::symmetric_top;  ///< of rotations
  SolverOptions contact{};
  /// s, for which all bodies of an island must be slower than `sleep_speed` on average before they
  /// rest without cost until touched; infinite: never.
  double sleep_after = std::numeric_limits<double>::infinity();
  /// After each step looks at all ways again with the exact predicates of moving corners and edges:
  /// no core of a body has passed through a surface. Slow; the report counts what it finds.
  bool verify = false;
  /// 1 to 1024 threads share the contact solver's work; the same bits with any number. A step
  /// without many contacts is no faster by it.
  int threads = 1;
  double sleep_speed = 0.01;  ///< m/s, of the fastest point; 1 cm/s is what eyes take for rest
};

/// Runs the plan of a scene, step by step. Row i of every array is body i in the order added.
class Simulation {
 public:
  explicit Simulation(Scene scene, SimulationOptions options = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Exactly one step of dt seconds (the option's where none is given); 0 changes nothing.
  /// @throws InvalidInput for dt < 0 or not finite
  void step(std::optional<double> dt = {});
  /// Advances by exactly `seconds`, in equal steps no longer than the option dt.
  Report advance(double seconds);

  [[nodiscard]] int size() const;
  [[nodiscard]] double time() const;  ///< s, simulated
  [[nodiscard]] double dt() const;
  [[nodiscard]] const Scene& scene() const;  ///< as it stands: what was added and removed included
  [[nodiscard]] const Plan& plan() const;
  [[nodiscard]] const BodyStates& states() const;
  /// Since the simulation began: the same fields as advance returns, summed.
  [[nodiscard]] const Report& report() const;
  [[nodiscard]] std::span<const Contact> contacts() const;  ///< of the last step
  [[nodiscard]] Energy energy() const;
  [[nodiscard]] Eigen::Vector3d momentum() const;          ///< kg m/s, of all moving bodies
  [[nodiscard]] Eigen::Vector3d angular_momentum() const;  ///< kg m^2/s, about the world origin

  /// Rows x y z qx qy qz qw of the body frames; `out` holds 7 size() doubles.
  void poses(std::span<double> out) const;
  /// Rows vx vy vz wx wy wz: velocity of the body frame's origin, angular velocity, world axes.
  void twists(std::span<double> out) const;

  /// Body handling between steps. @throws InvalidInput; nothing has changed then
  BodyId add(BodyDefinition body);
  void remove(BodyId id);
  void set_state(BodyId id, const Pose& pose, const Eigen::Vector3d& velocity,
                 const Eigen::Vector3d& angular_velocity);

  /// For the next step only, world axes; a force without a point acts at the centre of mass.
  void apply_force(BodyId id, const Eigen::Vector3d& force,
                   const std::optional<Eigen::Vector3d>& point = {});
  void apply_torque(BodyId id, const Eigen::Vector3d& torque);
  void apply_impulse(BodyId id, const Eigen::Vector3d& impulse,
                     const std::optional<Eigen::Vector3d>& point = {});
  void apply_angular_impulse(BodyId id, const Eigen::Vector3d& impulse);
  /// Held until replaced or its time is over; all zeros clears it. One per body.
  void hold_wrench(const AppliedWrench& wrench);

  /// All that steps depend on, as bytes for this same build; restore gives the same bits from there
  /// on.
  [[nodiscard]] std::string save() const;
  void restore(const std::string& bytes);
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  std::unique_ptr<World> world_;
};

}  // namespace carom
