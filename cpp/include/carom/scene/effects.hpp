// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "carom/bodies/ids.hpp"

namespace carom {

/// Constant acceleration of every moving body. F = m g; potential energy -m g . x of the centre of
/// mass.
struct UniformGravity {
  Eigen::Vector3d acceleration{0, 0, -9.81};  ///< m/s^2, world axes
};

/// Wrench held on one body until replaced or until its time is over. Its power is F . v + T . omega
/// and is booked as work.
struct AppliedWrench {
  BodyId body{};
  Eigen::Vector3d force = Eigen::Vector3d::Zero();         ///< N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();        ///< N m
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();       ///< m from the centre of mass, body axes
  bool in_body_axes = false;                               ///< force and torque turn with the body
  double until = std::numeric_limits<double>::infinity();  ///< s of simulated time, to a step
};

/// Resistance of the air (or oil) to motion relative to it: F = -coefficient (v - wind) at the
/// centre of mass, T = -angular_coefficient omega. Stokes' sphere has 6 pi mu r and 8 pi mu r^3.
///
/// Solved, not stepped: with other forces constant over the step speeds and path are exact for any
/// coefficient; of the torque, second order for a tumbling body and never unstable. The air takes
/// coefficient |v - wind|^2 + angular_coefficient |omega|^2, booked as dissipated; the wind's part,
/// F . wind, is booked as work.
struct LinearDrag {
  double coefficient = 0;                          ///< kg/s, >= 0
  double angular_coefficient = 0;                  ///< N m s, >= 0
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  ///< m/s, world axes
  std::optional<BodyId> body{};                    ///< of every moving body where none is named
};

/// Spring that turns a body back to `rest`: T = -stiffness theta - damping omega, theta the
/// shortest rotation vector from rest, world axes; energy stiffness |theta|^2 / 2.
///
/// Each step solves the damped oscillator about the body's axes as they stand, so that no stiffness
/// is too stiff: exact for turns about one principal axis, at any step.
struct TorsionSpring {
  BodyId body{};
  double stiffness = 0;                                      ///< N m/rad, > 0
  double damping = 0;                                        ///< N m s, >= 0
  Eigen::Quaterniond rest = Eigen::Quaterniond::Identity();  ///< body frame to world
};

/// The lecture's way out of overlap: contact points that overlap get the speed depth / dt along
/// their normal, with friction, so that a step parts them. It puts energy in, which the ledger
/// shows (Energy::repulsion). Bounded, a point gets only what it lacks of that speed, and never
/// leaves faster than `cap`; a small cap is the lecture's very weak repulsion. Without this effect
/// overlaps are undone by moving bodies, which adds no speed.
///
/// Balls and particles whose centres lie in a distance grid get their normal from the chain
/// gradient, swept hit, velocity (see interior_normal); which was used is counted in the report.
/// Source: lecture notes, "Use a repulsion impulse", "So use very weak repulsions".
struct Repulsion {
  bool bounded = true;
  double cap = 3.0;              ///< m/s, > 0: the speed of the push that needs no such effect
  bool interior_normals = true;  ///< false: the plain gradient, right or wrong
};

/// A closed set of values: they compare, print, serialise and bind for free, and a new one makes
/// the compiler list each place that must answer for it.
using Effect = std::variant<UniformGravity, AppliedWrench, LinearDrag, TorsionSpring, Repulsion>;

/// What the effects table, the command line and scene files say of an effect.
struct EffectInfo {
  std::string_view name;     ///< as in scene files, "UniformGravity"
  std::string_view stage;    ///< of the plan, "gravity"
  std::string_view formula;  ///< of the force
  std::string_view energy;   ///< potential or power
  std::string_view units;    ///< of the parameters
};

/// One row per alternative of Effect, in its order.
[[nodiscard]] std::span<const EffectInfo> effects_table();
[[nodiscard]] const EffectInfo& info_of(const Effect& effect);

/// The one body an effect acts on, where it names one.
[[nodiscard]] std::optional<BodyId> body_of(const Effect& effect);

/// @throws InvalidInput naming `field` and the parameter that is not finite or out of its range
void require_valid(const Effect& effect, std::string_view field);

}  // namespace carom
