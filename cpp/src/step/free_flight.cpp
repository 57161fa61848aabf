// SPDX-License-Identifier: Apache-2.0
#include "carom/step/free_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"
#include "carom/state/body_states.hpp"
#include "carom/step/exact_top.hpp"
#include "carom/step/taylor_top.hpp"

#include "step/lone_schemes.hpp"
#include "step/rotation_kernel.hpp"

namespace carom {
namespace {
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A body in flight: its principal frame, and what does not change.
struct Flyer {
  Quaterniond q;       // principal frame to world
  Vector3d l, a;       // world angular momentum, inverse moments
  Quaterniond axes_b;  // principal frame to body frame
};

FlightStatus worse(FlightStatus a, FlightStatus b) {
  return std::max(a, b);
}

/// Gram-Schmidt and polar work on the matrix of the body's own frame: which axis is first matters.
template <class Repair>
Quaterniond fly_matrix(const Flyer& body, double h, std::int64_t steps, const Repair& repair) {
  const Matrix3d axes = body.axes_b.toRotationMatrix();
  const Matrix3d inverse = axes * body.a.asDiagonal() * axes.transpose();
  Matrix3d r = body.q.toRotationMatrix() * axes.transpose();
  for (std::int64_t i = 0; i < steps; ++i)
    r = repair(kernel::lecture_update(r, body.l, inverse, h));
  return Quaterniond(r) * body.axes_b;
}

template <class Step>
Quaterniond fly_spin(const Flyer& body, std::int64_t steps, const Step& step) {
  kernel::Spin<double> b{body.q.x(), body.q.y(), body.q.z(), body.q.w(), body.l.x(),
                         body.l.y(), body.l.z(), body.a.x(), body.a.y(), body.a.z()};
  for (std::int64_t i = 0; i < steps; ++i) step(b);
  return {b.qw, b.qx, b.qy, b.qz};
}

Quaterniond fly_fixed(const Flyer& body, double seconds, std::int64_t steps, Integrator method,
                      FlightStatus& status) {
  const double h = seconds / static_cast<double>(steps);
  using kernel::Spin;
  const auto t = kernel::split_top(Spin<double>{0, 0, 0, 1, body.l.x(), body.l.y(), body.l.z(),
                                                body.a.x(), body.a.y(), body.a.z()});
  switch (method) {
    case Integrator::lecture_gram_schmidt:
      return fly_matrix(body, h, steps, kernel::gram_schmidt);
    case Integrator::lecture_polar: {
      bool converged = true;
      const auto q = fly_matrix(
          body, h, steps, [&](const Matrix3d& m) { return kernel::polar_rotation(m, converged); });
      if (!converged) status = worse(status, FlightStatus::iteration_cap);
      return q;
    }
    case Integrator::implicit_midpoint: {
      bool converged = true;
      Quaterniond q = body.q;
      for (std::int64_t i = 0; i < steps; ++i)
        q = kernel::implicit_midpoint(q, body.l, body.a, h, converged);
      if (!converged) status = worse(status, FlightStatus::iteration_cap);
      return q;
    }
    case Integrator::lecture_exponential:
      return fly_spin(body, steps, [h](auto& b) { kernel::step_exponential(b, h); });
    case Integrator::lecture_quaternion:
      return fly_spin(body, steps, [h](auto& b) { kernel::step_quaternion(b, h); });
    case Integrator::lecture_quaternion_sqrt: {
      bool clamped = false;
      const auto q =
          fly_spin(body, steps, [&, h](auto& b) { clamped |= kernel::step_quaternion_sqrt(b, h); });
      if (clamped) status = worse(status, FlightStatus::clamped);
      return q;
    }
    case Integrator::midpoint:
      return fly_spin(body, steps, [h](auto& b) { kernel::step_midpoint(b, h); });
    case Integrator::cayley:
      return fly_spin(body, steps, [h](auto& b) { kernel::step_cayley(b, h); });
    case Integrator::symmetric_top_4:
      return fly_spin(body, steps, [&t, h](auto& b) { kernel::step_symmetric_top_4(b, t, h); });
    case Integrator::symmetric_top:
    default:
      return fly_spin(body, steps, [&t, h](auto& b) { kernel::step_symmetric_top(b, t, h); });
  }
}

/// Doubles the steps until two tries agree: the finer one's error is their difference divided by
/// 2^order - 1, once the steps are short enough for that law to hold.
Quaterniond fly_to_tolerance(const Flyer& body, double seconds, Integrator method, double allowed,
                             FreeFlight& out) {
  const double growth = std::ldexp(1.0, order_of(method)) - 1;
  FlightStatus status = FlightStatus::ok;
  Quaterniond coarse = fly_fixed(body, seconds, out.steps, method, status);
  out.error = std::numeric_limits<double>::infinity();
  int settled = 0;  // one agreement can be luck
  while (2 * out.steps <= tolerance::flight_steps) {
    status = FlightStatus::ok;
    out.steps *= 2;
    const Quaterniond fine = fly_fixed(body, seconds, out.steps, method, status);
    const double before = out.error;
    out.error = rotation_angle(coarse, fine) / growth;
    coarse = fine;
    settled = out.error <= allowed ? settled + 1 : 0;
    if (settled == 2) {
      out.status = status;
      return coarse;
    }
    const double rounding = tolerance::unit_roundoff * static_cast<double>(out.steps);
    if (out.error >= before && out.error <= rounding) {
      out.status = worse(status, FlightStatus::below_rounding);
      return coarse;
    }
  }
  out.status = worse(status, FlightStatus::step_cap);
  return coarse;
}

}  // namespace

std::string_view name_of(FlightStatus status) {
  constexpr std::array<std::string_view, 5> names = {"ok", "clamped", "iteration_cap", "step_cap",
                                                     "below_rounding"};
  return names[static_cast<std::size_t>(status)];
}

FreeFlight integrate_free(const MassProperties& body, const Quaterniond& orientation,
                          const Vector3d& angular_velocity, double seconds, std::int64_t steps,
                          Integrator method, std::optional<double> allowed) {
  require_finite(seconds, "seconds", "s");
  if (steps < 1) throw InvalidInput("steps", with_unit(steps, ""), "must be >= 1");
  if (allowed) require_positive(*allowed, "tolerance", "rad");
  for (int i = 0; i < 3; ++i) require_finite(angular_velocity[i], "angular_velocity", "rad/s");
  const Quaterniond q_wb = unit_quaternion(
      {orientation.x(), orientation.y(), orientation.z(), orientation.w()}, "orientation");

  BodyStates states;
  states.push_back(body, true, Pose{Vector3d::Zero(), q_wb}, Vector3d::Zero(), angular_velocity);
  const Flyer flyer{states.orientation[0], states.angular_momentum[0], states.inverse_moments[0],
                    states.axes_b[0]};

  FreeFlight out;
  out.steps = steps;
  Quaterniond q;
  if (method == Integrator::exact) {
    const ExactFlight flight = exact_flight(flyer.q, flyer.l, flyer.a, seconds);
    q = flight.orientation, out.error = flight.error, out.steps = 1;
    if (allowed && flight.error > *allowed) out.status = FlightStatus::below_rounding;
  } else if (method == Integrator::taylor) {
    const double aim = allowed.value_or(tolerance::taylor_default);
    const TaylorFlight flight = taylor_flight(flyer.q, flyer.l, flyer.a, seconds, aim, steps);
    q = flight.orientation, out.error = flight.error(), out.steps = flight.steps;
    if (flight.capped) {
      out.status = FlightStatus::step_cap;
    } else if (allowed && flight.error() > aim) {
      out.status = FlightStatus::below_rounding;
    }
  } else if (allowed) {
    q = fly_to_tolerance(flyer, seconds, method, *allowed, out);
  } else {
    q = fly_fixed(flyer, seconds, steps, method, out.status);
  }
  q.normalize();
  out.orientation = (q * flyer.axes_b.conjugate()).normalized();
  // A free axis (of a rod) carries no momentum: its spin is what nobody can know, and is 0.
  out.angular_velocity = q * flyer.a.cwiseProduct(q.conjugate() * flyer.l);
  return out;
}

}  // namespace carom
