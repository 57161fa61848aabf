// SPDX-License-Identifier: Apache-2.0
// One scalar momentum p (velocity u = p / inertia) under a constant force and a linear resistance,
// solved over a step. The same for a coordinate of a centre of mass and for a turn about an axis.
#pragma once
#include <cmath>

#include "carom/numerics/tolerance.hpp"

namespace carom {

struct Resisted {
  double after = 0;       ///< momentum at the end
  double mean = 0;        ///< its mean over the step
  double dissipated = 0;  ///< J
};

/// (1 - exp(-x)) / x and (x - 1 + exp(-x)) / x^2, x >= 0, without cancellation.
inline double mean_decay(double x) {
  return x > 0 ? -std::expm1(-x) / x : 1;
}
inline double mean_approach(double x) {
  if (x > tolerance::decay_series) return (1 - mean_decay(x)) / x;
  double term = 0.5, sum = term;
  for (int n = 3; n < 12; ++n) sum += term *= -x / n;
  return sum;
}

/// p' = force - rate p, the force being `impulse` / dt; inverse_inertia > 0.
/// Source: the exponential integrator of Hochbruck and Ostermann 2010, exact for this equation.
inline Resisted resisted(double p, double impulse, double rate, double inverse_inertia, double dt) {
  const double x = rate * dt;
  Resisted r;
  r.after = p * std::exp(-x) + impulse * mean_decay(x);
  r.mean = p * mean_decay(x) + impulse * mean_approach(x);
  // The work of the force that did not become kinetic energy.
  r.dissipated = inverse_inertia * (impulse * r.mean + 0.5 * (p - r.after) * (p + r.after));
  return r;
}

/// theta'' and p' = force - stiffness theta - damping u: the damped oscillator.
inline Resisted sprung(double p, double impulse, double theta, double stiffness, double damping,
                       double inverse_inertia, double dt) {
  const double rest = impulse / dt / stiffness;
  const double y0 = theta - rest, v0 = inverse_inertia * p;
  const double beta = 0.5 * damping * inverse_inertia, square = stiffness * inverse_inertia;
  const double d = beta * beta - square;
  double c, s;  // exp(-beta t) times cosh or cos, and times sinh or sin over the rate
  if (d > 0) {
    const double fast = beta + std::sqrt(d), slow = square / fast;
    const double e = std::exp(-slow * dt), gap = 2 * std::sqrt(d) * dt;
    c = 0.5 * e * (1 + std::exp(-gap));
    s = e * dt * mean_decay(gap);
  } else {
    const double w = std::sqrt(-d), e = std::exp(-beta * dt);
    c = e * std::cos(w * dt);
    s = e * (w > 0 ? std::sin(w * dt) / w : dt);
  }
  const double y1 = y0 * c + (v0 + beta * y0) * s;
  const double v1 = v0 * c - (square * y0 + beta * v0) * s;
  Resisted r;
  r.after = v1 / inverse_inertia;
  r.mean = (y1 - y0) / (inverse_inertia * dt);
  const auto energy = [&](double y, double v) {
    return 0.5 * (v * v / inverse_inertia + stiffness * y * y);
  };
  r.dissipated = energy(y0, v0) - energy(y1, v1);  // about the rest: the force is in it
  return r;
}

}  // namespace carom
