// SPDX-License-Identifier: Apache-2.0
#include "contact/direct.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom::contact {
namespace {

constexpr int outer_cap = 30;
constexpr int line_cap = 30;
constexpr int idle_cap = 8;
constexpr double series_most = 0.99;  // mu = 5 on a ball; nearer 1 the sum is rounding

/// Adds X_a S X_b^T with X = [1; arm x]: what a 3x3 stiffness at a point is to two bodies.
void add_stiffness(Matrix6& h, const Eigen::Matrix3d& s, const Eigen::Matrix3d& arm_a,
                   const Eigen::Matrix3d& arm_b, double sign) {
  const Eigen::Matrix3d right = -s * arm_b;  // S [b]^T
  h.topLeftCorner<3, 3>() += sign * s;
  h.topRightCorner<3, 3>() += sign * right;
  h.bottomLeftCorner<3, 3>() += sign * (arm_a * s);
  h.bottomRightCorner<3, 3>() += sign * (arm_a * right);
}

Eigen::Vector3d clamp_turn(const Eigen::Vector3d& z, double roll, double spin) {
  Eigen::Vector3d out = z;
  out.x() = std::clamp(z.x(), -spin, spin);
  const double r = std::hypot(z.y(), z.z());
  if (r > roll) out.tail<2>() *= roll / r;
  return out;
}

Eigen::Matrix3d turn_derivative(const Eigen::Vector3d& z, double roll, double spin) {
  Eigen::Matrix3d d = Eigen::Matrix3d::Identity();
  if (std::abs(z.x()) > spin) d(0, 0) = 0;
  const double r = std::hypot(z.y(), z.z());
  if (r > roll) {
    const Eigen::Vector2d along = z.tail<2>() / r;
    d.block<2, 2>(1, 1) = roll / r * (Eigen::Matrix2d::Identity() - along * along.transpose());
  }
  return d;
}

}  // namespace

void DirectSolver::clear() {
  bodies.clear();
  points.clear();
  turns.clear();
  edges.clear();
}

Eigen::Vector3d DirectSolver::slip(const DirectPoint& p, std::span<const Vector6> v) const {
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  if (p.b >= 0) u += v[p.b].head<3>() + v[p.b].tail<3>().cross(p.arm_b);
  if (p.a >= 0) u -= v[p.a].head<3>() + v[p.a].tail<3>().cross(p.arm_a);
  return p.frame.transpose() * u;
}

Eigen::Vector3d DirectSolver::turning(const DirectTurn& t, std::span<const Vector6> v) const {
  const DirectPoint& p = points[t.point];
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  if (p.b >= 0) w += v[p.b].tail<3>();
  if (p.a >= 0) w -= v[p.a].tail<3>();
  return p.frame.transpose() * w;
}

void DirectSolver::project() {
  for (std::size_t i = 0; i < points.size(); ++i) {
    Work& w = work_[i];
    const ConeProjection p = project_on_cone(w.z, points[i].mu);
    w.value = p.value;
    w.branch = p.branch;
  }
  for (TurnWork& w : turn_work_) w.value = clamp_turn(w.z, w.roll_bound, w.spin_bound);
}

void DirectSolver::add_impulses(std::span<Vector6> to, double sign) const {
  const auto act = [&](int body, const Eigen::Vector3d& arm, const Eigen::Vector3d& f) {
    if (body < 0) return;
    to[body].head<3>() += f;
    const Eigen::Vector3d torque = arm.cross(f);
    to[body].tail<3>() += bodies[body].resists_all ? torque : bodies[body].resists * torque;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const DirectPoint& p = points[i];
    if (work_[i].branch == Branch::open) continue;
    const Eigen::Vector3d f = sign * (p.frame * work_[i].value);
    act(p.b, p.arm_b, f);
    act(p.a, p.arm_a, -f);
  }
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const DirectPoint& p = points[turns[i].point];
    const Eigen::Vector3d t = sign * (p.frame * turn_work_[i].value);
    if (p.b >= 0) to[p.b].tail<3>() += bodies[p.b].resists * t;
    if (p.a >= 0) to[p.a].tail<3>() -= bodies[p.a].resists * t;
  }
}

// Gradient of the augmented Lagrangian at v_; returns its size as a velocity, m/s.
double DirectSolver::gradient() {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const DirectBody& body = bodies[k];
    gradient_[k].head<3>() = body.mass * (v_[k] - body.free).head<3>();
    gradient_[k].tail<3>() = body.inertia * (v_[k] - body.free).tail<3>();
  }
  add_impulses(gradient_, -1);
  double worst = 0, sum = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const DirectBody& body = bodies[k];
    worst = std::max(worst, body.inverse_mass * gradient_[k].head<3>().norm());
    worst = std::max(worst, body.radius * (body.inverse_inertia * gradient_[k].tail<3>()).norm());
    sum += gradient_[k].squaredNorm();
  }
  // A maximum loses what is not a number; a sum keeps it.
  return std::isfinite(sum) ? worst : std::numeric_limits<double>::infinity();
}

bool DirectSolver::factor() {
  cholesky_.set_zero();
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    Matrix6& h = cholesky_.diagonal(static_cast<int>(k));
    h.topLeftCorner<3, 3>().diagonal().array() += bodies[k].mass;
    h.bottomRightCorner<3, 3>() += bodies[k].inertia;
  }
  // An axis that resists nothing takes no part: its rows of every stiffness are projected out.
  const auto mask = [&](Matrix6& h, int row, int column) {
    if (!bodies[row].resists_all) h.bottomRows<3>() = bodies[row].resists * h.bottomRows<3>();
    if (!bodies[column].resists_all) h.rightCols<3>() = h.rightCols<3>() * bodies[column].resists;
  };
  const auto add = [&](const DirectPoint& p, const auto& fill) {
    Matrix6 h;
    if (p.a >= 0) {
      h.setZero(), fill(h, p.arm_a, p.arm_a, 1.0), mask(h, p.a, p.a);
      cholesky_.diagonal(p.a) += h;
    }
    if (p.b >= 0) {
      h.setZero(), fill(h, p.arm_b, p.arm_b, 1.0), mask(h, p.b, p.b);
      cholesky_.diagonal(p.b) += h;
    }
    if (p.a >= 0 && p.b >= 0) {
      h.setZero(), fill(h, p.arm_a, p.arm_b, -1.0), mask(h, p.a, p.b);
      cholesky_.add(p.edge, h);
    }
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Work& w = work_[i];
    factored_[i] = w.branch;
    if (w.branch == Branch::open) continue;
    const DirectPoint& p = points[i];
    const Eigen::Matrix3d s =
        w.rho * (w.branch == Branch::stick
                     ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                     : Eigen::Matrix3d(p.frame * cone_derivative(w.z, p.mu, w.branch) *
                                       p.frame.transpose()));
    add(p, [&](Matrix6& h, const Eigen::Vector3d& x, const Eigen::Vector3d& y, double sign) {
      add_stiffness(h, s, skew(x), skew(y), sign);
    });
  }
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const TurnWork& w = turn_work_[i];
    const DirectPoint& p = points[turns[i].point];
    const Eigen::Matrix3d s =
        w.rho * p.frame * turn_derivative(w.z, w.roll_bound, w.spin_bound) * p.frame.transpose();
    add(p, [&](Matrix6& h, const Eigen::Vector3d&, const Eigen::Vector3d&, double sign) {
      h.bottomRightCorner<3, 3>() += sign * s;
    });
  }
  return cholesky_.factor();
}

bool DirectSolver::same_branches() const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (work_[i].branch != factored_[i] || work_[i].branch == Branch::slide) return false;
  return turns.empty();
}

// The scalar function along the step is convex with a piecewise smooth, increasing slope: regula
// falsi kept honest by bisection (Illinois would do as well) finds where it vanishes.
double DirectSolver::line_search(double slope_at_0) {
  double quadratic = 0, linear = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const DirectBody& body = bodies[k];
    Vector6 m;
    m.head<3>() = body.mass * step_[k].head<3>();
    m.tail<3>() = body.inertia * step_[k].tail<3>();
    quadratic += step_[k].dot(m);
    linear += (v_[k] - body.free).dot(m);
  }
  for (std::size_t i = 0; i < points.size(); ++i) work_[i].along = slip(points[i], step_);
  for (std::size_t i = 0; i < turns.size(); ++i) turn_work_[i].along = turning(turns[i], step_);
  const auto slope = [&](double a) {
    double s = linear + a * quadratic;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Work& w = work_[i];
      s -= project_on_cone(w.z - a * w.rho * w.along, points[i].mu).value.dot(w.along);
    }
    for (const TurnWork& w : turn_work_)
      s -= clamp_turn(w.z - a * w.rho * w.along, w.roll_bound, w.spin_bound).dot(w.along);
    return s;
  };
  double low = 0, f_low = slope_at_0, high = 1, f_high = slope(1);
  const double enough = 0.1 * std::abs(slope_at_0);
  if (std::abs(f_high) <= enough) return 1;
  for (int k = 0; k < line_cap && f_high < 0; ++k)
    low = high, f_low = f_high, high *= 2, f_high = slope(high);
  for (int k = 0; k < line_cap; ++k) {
    double a = low - f_low * (high - low) / (f_high - f_low);
    const double width = high - low;
    a = std::clamp(a, low + 0.1 * width, high - 0.1 * width);
    const double f = slope(a);
    if (std::abs(f) <= enough) return a;
    if (f < 0)
      low = a, f_low = f;
    else
      high = a, f_high = f;
  }
  return low > 0 ? low : high;
}

DirectResult DirectSolver::solve(double enough, double slow_enough, int newton_cap) {
  const std::size_t n = bodies.size();
  cholesky_.analyse(static_cast<int>(n), edges);
  work_.resize(points.size());
  factored_.resize(points.size());
  turn_work_.resize(turns.size());
  v_.resize(n), gradient_.resize(n), step_.resize(n);

  double stiffness = tolerance::direct_stiffness_sticking;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const DirectPoint& p = points[i];
    Work& w = work_[i];
    w.start = clamp_coulomb(p.impulse, p.mu);
    w.shift = w.slip = w.shift_change = 0;
    const double tangent = w.start.tail<2>().norm();
    if (w.start.x() > 0 && tangent >= p.mu * w.start.x() * tolerance::direct_slides)
      stiffness = tolerance::direct_stiffness_sliding;
    w.value = w.start;
    w.branch = w.start.isZero(0) ? Branch::open : Branch::stick;
  }
  for (std::size_t i = 0; i < turns.size(); ++i) {
    TurnWork& w = turn_work_[i];
    const double normal = work_[turns[i].point].start.x();
    w.roll_bound = turns[i].rolling * normal, w.spin_bound = turns[i].spinning * normal;
    w.start = w.value = clamp_turn(turns[i].impulse, w.roll_bound, w.spin_bound);
  }
  const auto set_stiffness = [&](double c) {
    for (std::size_t i = 0; i < points.size(); ++i) work_[i].rho = c / points[i].mobility;
    for (std::size_t i = 0; i < turns.size(); ++i) turn_work_[i].rho = c / turns[i].mobility;
  };
  set_stiffness(stiffness);

  // Where last step's impulses would take the bodies.
  std::fill(step_.begin(), step_.end(), Vector6::Zero());
  add_impulses(step_, 1);
  for (std::size_t k = 0; k < n; ++k) {
    v_[k] = bodies[k].free;
    v_[k].head<3>() += bodies[k].inverse_mass * step_[k].head<3>();
    v_[k].tail<3>() += bodies[k].inverse_inertia * step_[k].tail<3>();
  }

  // What slid goes on sliding: the shift that Coulomb's law asks for at these velocities.
  for (std::size_t i = 0; i < points.size(); ++i) {
    Work& w = work_[i];
    const double tangent = w.start.tail<2>().norm();
    if (w.start.x() > 0 && tangent >= points[i].mu * w.start.x() * tolerance::direct_slides)
      w.shift = points[i].mu * (slip(points[i], v_) + points[i].drive).tail<2>().norm();
  }
  const auto evaluate = [&] {
    for (std::size_t i = 0; i < points.size(); ++i) {
      Work& w = work_[i];
      Eigen::Vector3d u = slip(points[i], v_) + points[i].drive;
      w.slip = u.tail<2>().norm();
      w.normal_speed = u.x() + points[i].gap_speed;
      u.x() = w.normal_speed + w.shift;
      w.z = w.start - w.rho * u;
    }
    for (std::size_t i = 0; i < turns.size(); ++i) {
      TurnWork& w = turn_work_[i];
      w.z = w.start - w.rho * (turning(turns[i], v_) + turns[i].drive);
    }
    project();
  };

  DirectResult result;
  double residual = std::numeric_limits<double>::infinity(), proximal = residual;
  for (int outer = 0; outer < outer_cap; ++outer) {
    const double inner_tolerance =
        std::max(0.1 * enough, outer > 0 ? 0.05 * std::min(residual, 1.0) : 0.0);
    bool have_factor = false;
    double size_before = std::numeric_limits<double>::infinity();
    evaluate();
    double size = gradient(), least = size;
    int idle = 0;
    while (size > inner_tolerance) {
      if (result.newton >= newton_cap) return result;
      if (!have_factor || !same_branches() || !(size < 0.3 * size_before)) {
        if (!factor()) return result;
        have_factor = true;
      }
      ++result.newton;
      for (std::size_t k = 0; k < n; ++k) step_[k] = -gradient_[k];
      cholesky_.solve(step_);
      double slope = 0;
      for (std::size_t k = 0; k < n; ++k) slope += step_[k].dot(gradient_[k]);
      if (!(slope < 0)) break;  // rounding has eaten the descent: what is reached stands
      const double a = line_search(slope);
      for (std::size_t k = 0; k < n; ++k) v_[k] += a * step_[k];
      size_before = size;
      evaluate();
      size = gradient();
      // Rounding sets a floor; the residual below counts what is left.
      idle = size < 0.5 * least || size > slow_enough ? 0 : idle + 1;
      least = std::min(least, size);
      if (idle >= idle_cap) break;
    }

    const double residual_before = residual, proximal_before = proximal;
    residual = size;
    proximal = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Work& w = work_[i];
      proximal = std::max(proximal, (w.value - w.start).norm() / w.rho);
      // The change of the shift is part of what is not settled yet. An open point is shifted too,
      // or it would close and open for ever; it must only not overlap.
      const double shift = points[i].mu * w.slip;
      residual = std::max(residual,
                          w.branch == Branch::open ? -w.normal_speed : std::abs(shift - w.shift));
      // Under a fast slip each round leaves a share mu^2 k / (1 + mu^2 k) of the last one's change
      // (k: tangential over normal mobility): every third round sums that series.
      const double change = shift - w.shift, ratio = change / w.shift_change;
      w.shift = shift;
      if (outer % 3 == 2 && ratio > 0.3 && ratio < series_most)
        w.shift += change * ratio / (1 - ratio);
      w.shift_change = change;
      w.start = w.value;
    }
    for (std::size_t i = 0; i < turns.size(); ++i) {
      TurnWork& w = turn_work_[i];
      const double normal = work_[turns[i].point].value.x();
      const double roll = turns[i].rolling * normal, spin = turns[i].spinning * normal;
      const double moved =
          (w.value - w.start).norm() / w.rho +
          turns[i].mobility * (std::abs(roll - w.roll_bound) + std::abs(spin - w.spin_bound));
      residual = std::max(
          residual,
          moved * bodies[std::max(points[turns[i].point].a, points[turns[i].point].b)].radius);
      w.roll_bound = roll, w.spin_bound = spin;
      w.start = w.value;
    }
    result.residual = residual = std::max(residual, proximal);
    // Sliding on more points than a plane has leaves a slow tail of no consequence.
    const bool slow = residual > 0.3 * residual_before;
    if (residual <= enough || (slow && residual <= slow_enough)) {
      result.converged = true;
      break;
    }
    if (proximal > 0.3 * proximal_before && stiffness < tolerance::direct_stiffness_most) {
      stiffness *= 10;
      set_stiffness(stiffness);
    }
  }
  // A cold start under a heavy load may need more rounds than one step gives it; the next step goes
  // on from here.
  result.converged |= result.residual <= 10 * slow_enough;
  for (std::size_t k = 0; k < n; ++k) bodies[k].v = v_[k];
  for (std::size_t i = 0; i < points.size(); ++i) points[i].impulse = work_[i].value;
  for (std::size_t i = 0; i < turns.size(); ++i) turns[i].impulse = turn_work_[i].value;
  return result;
}

}  // namespace carom::contact
