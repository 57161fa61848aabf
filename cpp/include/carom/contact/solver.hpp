// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "carom/contact/contact.hpp"
#include "carom/state/body_states.hpp"

namespace carom {

class Workers;  // threads that share the work of a step; numerics/workers.hpp

enum class SolverChoice : std::uint8_t {
  automatic,  ///< per island, by the sink it would have under the small-step solver
  small_steps,
  direct
};

struct SolverOptions {
  SolverChoice choice = SolverChoice::automatic;
  int substeps = 0;             ///< of the small-step solver; 0: 8 to 32, by the sink expected
  double tolerance = 1e-7;      ///< m/s, residual at which the direct solver stops
  double direct_budget = 2e-3;  ///< s, estimated, that a direct solve of a hard island may take
};

/// What one call did.
struct SolveOutcome {
  double residual = 0;    ///< m/s, worst point: change that Coulomb's law still asks for
  int iterations = 0;     ///< Newton steps and small steps of all islands
  int gave_up = 0;        ///< islands left above their tolerance
  double dissipated = 0;  ///< J taken from the bodies by contacts; negative where they add
  int islands = 0, direct_islands = 0, small_step_islands = 0;
  int direct_bodies = 0;
};

/// How bodies get from the start to the end of the step, where contacts decide it.
struct ContactMotion {
  std::vector<std::uint8_t> decided;  ///< 1 where the two rows below hold
  Array3 displacement;                ///< m, of the centre of mass
  Array3 turn;  ///< rad, rotation vector in addition to the free one at the new angular momentum
};

/// What the solver remembers from step to step, one entry per body. Plain arrays: save and restore
/// copy them.
struct SolverMemory {
  std::vector<std::uint16_t> newton;   ///< Newton steps of the last direct solve of its island
  std::vector<std::uint8_t> held_off;  ///< steps for which its island stays with small steps
  std::vector<std::uint8_t> direct;    ///< 1 where the last solve was direct
  std::vector<std::uint8_t> substeps;  ///< small steps of its island in the last solve, 0 without
  std::vector<std::int32_t> island;    ///< lowest row of its island in the last solve, -1 without

  void resize(int n);
  void erase(int i);
};

/// Contact impulses of a step: no point closes faster than its gap allows, friction stays in
/// Coulomb's cone, restitution acts on what hits.
///
/// Two solvers over one set of contacts. Bulk islands take soft small steps in lanes of four
/// contacts; islands whose soft contacts would sink by more than tolerance::soft_sink go to a
/// direct solver that knows no such sink. No allocation once warm.
class ContactSolver {
 public:
  ContactSolver();
  ~ContactSolver();
  ContactSolver(const ContactSolver&);
  ContactSolver& operator=(const ContactSolver&);
  ContactSolver(ContactSolver&&) noexcept;
  ContactSolver& operator=(ContactSolver&&) noexcept;

  /// Changes velocity and angular momentum of `states`, which hold the forces of the step already;
  /// the two arrays hold them without. Contacts ascend by (a, b). Same bits with any `workers`.
  SolveOutcome solve(BodyStates& states, const Array3& velocity_before,
                     const Array3& angular_momentum_before, std::span<Contact> contacts, double dt,
                     const SolverOptions& options = {}, Workers* workers = nullptr);

  [[nodiscard]] const ContactMotion& motion() const;  ///< of the last solve
  SolverMemory memory;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace carom
