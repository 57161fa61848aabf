// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "carom/contact/solver.hpp"

#include "contact/bulk.hpp"
#include "contact/islands.hpp"
#include "contact/scratch.hpp"
#include "numerics/workers.hpp"

namespace carom::contact {

/// Stiffness of soft contacts that goes with a number of small steps per step.
struct Softness {
  double frequency = 0;  ///< Hz, between moving bodies
  double damping_ratio = 0;
};

/// An eighth of the rate of the small steps: stiffer ones do not come to rest (measured).
[[nodiscard]] Softness softness(int substeps, double dt, bool against_static);

/// Bulk solver: soft contacts in small steps (Macklin et al. 2019, Catto's Solver2D), four patches
/// at a time. Patches that share a moving body never share a row of lanes.
class SmallSteps {
 public:
  void clear();
  void add(const Islands& islands, const Island& island);
  [[nodiscard]] bool empty() const { return patches_.empty(); }

  /// Solves what was added; writes impulses to the contacts, new velocities to the states and the
  /// way travelled to `motion`. Returns the residual, m/s, and adds to `dissipated`, J.
  double solve(BodyStates& states, const BodyFrames& frames, std::span<Contact> contacts,
               ContactMotion& motion, double dt, int substeps, double& dissipated,
               Workers* workers);

 private:
  void colour(const BodyStates& states);
  void place_bodies(const BodyStates& states, const BodyFrames& frames, int substeps);
  static bool is_ball(const BodyStates& states, const BodyFrames& frames, int row,
                      const Contact& contact);
  static bool goes_as_ball(const Patch& patch, const BodyStates& states, const BodyFrames& frames,
                           std::span<const Contact> contacts);
  void lay_rows(const BodyStates& states, const BodyFrames& frames,
                std::span<const Contact> contacts);
  void take_small_step(const BulkBatch& batch, double h, bool first, BulkPart part,
                       Workers* workers);
  void mark_felt(std::span<const Contact> contacts);
  [[nodiscard]] double take_back(BodyStates& states, const BodyFrames& frames,
                                 ContactMotion& motion, double dt, int substeps) const;
  [[nodiscard]] bool just_placed(const BodyFrames& frames, std::span<const Contact> contacts) const;
  void find_loads(const BulkBatch& batch, int substeps);
  void add_turn(int row, int lane, const Patch& patch, const BodyFrames& frames,
                std::span<const Contact> contacts);
  void resist_turning();
  void write_turns(std::span<Contact> contacts);

  /// Rolling and spinning resistance of a patch that asks for it. Few have it: no lanes.
  struct Turn {
    int row, lane, first_contact, count;
    double rolling, spinning;
    Eigen::Matrix3d inverse_a, inverse_b;
    Eigen::Vector3d normal;
    double roll_step, spin_step;     // kg m^2
    Eigen::Vector3d impulse, total;  // N m s of the small step, of the step
  };
  std::vector<Patch> patches_;
  std::vector<int> body_rows_;  // of the moving ones, in slot order; statics follow
  std::vector<int> static_rows_;
  std::vector<int> slot_;  // by row, -1 while unused
  std::vector<std::uint64_t> colours_used_;
  std::vector<std::vector<int>> colours_;  // patches of each colour; the last: those left over
  static constexpr int most_points = 4;    // of a manifold
  std::vector<int> by_size_[most_points + 1], list_;  // of the colour at hand; balls first
  std::vector<BulkBody> bodies_;
  std::vector<BulkFrame> frames_;
  std::vector<BulkKick> kicks_;
  std::vector<BulkRow> rows_;
  std::vector<BulkPoint> points_;
  std::vector<BulkBall> balls_;
  std::vector<BulkColour> stripes_;
  std::vector<Turn> turns_;
  std::vector<BulkBody> start_;
  std::vector<std::uint8_t> felt_;  // by slot: a contact pushed it in this step
  std::vector<double> residual_;    // of each thread
};

}  // namespace carom::contact
