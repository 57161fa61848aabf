// SPDX-License-Identifier: Apache-2.0
#include "contact/small_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include "carom/numerics/tolerance.hpp"

namespace carom::contact {
namespace {

constexpr int colour_count = 64;
constexpr int load_rounds = 16;  // loads travel about one layer per small step

double inverse_or_zero(double x) {
  return x > 0 ? 1 / x : 0;
}

BulkSoftness coefficients(int substeps, double dt) {
  BulkSoftness out;
  const double h = dt / substeps;
  for (const int fixed : {0, 1}) {
    const Softness soft = softness(substeps, dt, fixed == 1);
    const double omega = 2 * std::numbers::pi * soft.frequency;
    const double a1 = 2 * soft.damping_ratio + h * omega, a2 = h * omega * a1;
    out.bias_rate[fixed] = omega / a1;
    out.mass_scale[fixed] = a2 / (1 + a2);
    out.impulse_scale[fixed] = 1 / (1 + a2);
  }
  return out;
}

/// Contacts as the kernel sees them: a class of doubles, and of ints in pairs.
BulkContacts as_doubles(std::span<Contact> contacts) {
  static_assert(std::is_standard_layout_v<Contact> && sizeof(Contact) % sizeof(double) == 0);
  static_assert(offsetof(Contact, separation) == offsetof(Contact, position) + 3 * sizeof(double));
  const auto place = [](std::size_t bytes) {
    return static_cast<std::ptrdiff_t>(bytes / sizeof(double));
  };
  return {reinterpret_cast<double*>(contacts.data()), place(sizeof(Contact)),
          place(offsetof(Contact, normal)),           place(offsetof(Contact, position)),
          place(offsetof(Contact, friction)),         place(offsetof(Contact, impulse)),
          place(offsetof(Contact, impulse_at_end))};
}

/// Whether a sum of one kick per small step, each rounded, may be what one addition gave.
bool same_but_for_rounding(const Eigen::Vector3d& sum, const Eigen::Vector3d& once,
                           const Eigen::Vector3d& before, int kicks) {
  const double largest = std::max(once.cwiseAbs().maxCoeff(), before.cwiseAbs().maxCoeff());
  return (sum - once).cwiseAbs().maxCoeff() <= 2 * kicks * tolerance::unit_roundoff * largest;
}

}  // namespace

Softness softness(int substeps, double dt, bool against_static) {
  const double frequency = substeps / dt / 8;
  return against_static ? Softness{2 * frequency, 5} : Softness{frequency, 10};
}

void SmallSteps::clear() {
  for (const int row : body_rows_) slot_[row] = -1;
  for (const int row : static_rows_) slot_[row] = -1;
  patches_.clear(), body_rows_.clear(), static_rows_.clear();
}

void SmallSteps::add(const Islands& islands, const Island& island) {
  const auto first = islands.patches.begin() + island.first_patch;
  patches_.insert(patches_.end(), first, first + island.patches);
  const auto body = islands.bodies.begin() + island.first_body;
  body_rows_.insert(body_rows_.end(), body, body + island.bodies);
}

// Greedy: the lowest colour free at both bodies. A function of the patches alone, so nothing of it
// needs saving; it costs about 10 ns a patch.
void SmallSteps::colour(const BodyStates& states) {
  slot_.resize(states.size(), -1);
  int slots = 0;
  for (const int row : body_rows_) slot_[row] = slots++;
  for (const Patch& p : patches_)
    for (const int row : {p.a, p.b})
      if (!states.moves[row] && slot_[row] < 0) {
        slot_[row] = slots++;
        static_rows_.push_back(row);
      }
  colours_.resize(colour_count + 1);
  for (auto& c : colours_) c.clear();
  colours_used_.assign(slots, 0);
  for (int i = 0; i < static_cast<int>(patches_.size()); ++i) {
    const Patch& p = patches_[i];
    std::uint64_t none = 0;
    std::uint64_t& a = states.moves[p.a] ? colours_used_[slot_[p.a]] : none;
    std::uint64_t& b = states.moves[p.b] ? colours_used_[slot_[p.b]] : none;
    const int c = std::countr_one(a | b);  // 64 when none is free
    if (c < colour_count) a |= std::uint64_t{1} << c, b |= std::uint64_t{1} << c;
    colours_[c].push_back(i);
  }
}

void SmallSteps::place_bodies(const BodyStates& states, const BodyFrames& frames, int substeps) {
  const int moving = static_cast<int>(body_rows_.size());
  const int slots = moving + static_cast<int>(static_rows_.size());
  bodies_.assign(slots + 1, {});  // the last takes the empty lanes
  frames_.assign(slots + 1, {});
  kicks_.assign(moving, {});
  for (int s = 0; s < slots; ++s) {
    const bool moves = s < moving;
    const int row = moves ? body_rows_[s] : static_rows_[s - moving];
    BulkBody& body = bodies_[s];
    BulkFrame& frame = frames_[s];
    const Eigen::Vector3d v = moves ? frames.velocity_before[row] : states.velocity[row];
    const Eigen::Vector3d w = moves ? frames.omega_before[row] : frames.omega[row];
    const Eigen::Vector3d x = states.position[row];
    for (int k = 0; k < 3; ++k)
      body.velocity[k] = v[k], body.angular_velocity[k] = w[k], frame.position[k] = x[k];
    if (!moves) continue;
    body.inverse_mass = frame.inverse_mass = states.inverse_mass[row];
    const Eigen::Matrix3d& i = frames.inverse_inertia[row];
    const double six[6] = {i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)};
    std::copy(six, six + 6, frame.inertia);
    const Eigen::Vector3d dv = (frames.velocity[row] - frames.velocity_before[row]) / substeps;
    const Eigen::Vector3d dw = (frames.omega[row] - frames.omega_before[row]) / substeps;
    for (int k = 0; k < 3; ++k) kicks_[s].kick[k] = dv[k], kicks_[s].kick[4 + k] = dw[k];
  }
}

// Turns alike about all axes, or stands still, and no lever against the normal: to rounding.
bool SmallSteps::is_ball(const BodyStates& states, const BodyFrames& frames, int row,
                         const Contact& c) {
  if (!states.moves[row]) return states.velocity[row].isZero(0) && frames.omega[row].isZero(0);
  const double least = states.moments.x[row], most = states.moments.z[row];
  if (!(most - least <= tolerance::equal_moments * most)) return false;
  const Eigen::Vector3d arm = c.position - states.position[row];
  return arm.cross(c.normal).squaredNorm() <=
         tolerance::equal_moments * tolerance::equal_moments * arm.squaredNorm();
}

bool SmallSteps::goes_as_ball(const Patch& patch, const BodyStates& states,
                              const BodyFrames& frames, std::span<const Contact> contacts) {
  const Contact& c = contacts[patch.first];
  return patch.count == 1 && !(c.rolling_resistance > 0) && !(c.spinning_resistance > 0) &&
         is_ball(states, frames, patch.a, c) && is_ball(states, frames, patch.b, c);
}

void SmallSteps::lay_rows(const BodyStates& states, const BodyFrames& frames,
                          std::span<const Contact> contacts) {
  const int nobody = static_cast<int>(bodies_.size()) - 1;
  rows_.clear(), balls_.clear(), turns_.clear(), stripes_.clear();
  int points = 0;
  const auto lanes_of = [&](auto& row, const int* list, std::size_t taken) {
    for (std::size_t l = 0; l < 4; ++l) {
      row.a[l] = row.b[l] = nobody;
      row.contact[l] = -1;
      row.against_static.lane[l] = 0;
      if (l >= taken) continue;
      const Patch& p = patches_[list[l]];
      row.a[l] = slot_[p.a], row.b[l] = slot_[p.b];
      row.contact[l] = p.first;
      row.against_static.lane[l] = !states.moves[p.a] || !states.moves[p.b];
    }
  };
  for (int c = 0; c <= colour_count; ++c) {
    const int row_before = static_cast<int>(rows_.size());
    const int ball_before = static_cast<int>(balls_.size());
    // Patches of one size share rows, so that few lanes run empty.
    for (auto& list : by_size_) list.clear();
    for (const int i : colours_[c]) {
      const bool ball = c < colour_count && goes_as_ball(patches_[i], states, frames, contacts);
      by_size_[ball ? 0 : std::min(patches_[i].count, most_points)].push_back(i);
    }
    const std::size_t width = c < colour_count ? 4 : 1;
    for (std::size_t i = 0; i < by_size_[0].size(); i += 4)
      lanes_of(balls_.emplace_back(), &by_size_[0][i],
               std::min<std::size_t>(4, by_size_[0].size() - i));
    list_.clear();
    for (int size = most_points; size > 0; --size)
      list_.insert(list_.end(), by_size_[size].begin(), by_size_[size].end());
    for (std::size_t i = 0; i < list_.size(); i += width) {
      BulkRow& row = rows_.emplace_back();
      const std::size_t taken = std::min(width, list_.size() - i);
      lanes_of(row, &list_[i], taken);
      row.first = points, row.count = 0;
      for (std::size_t l = 0; l < 4; ++l) {
        row.lane_points[l] = l < taken ? patches_[list_[i + l]].count : 0;
        row.count = std::max(row.count, row.lane_points[l]);
        if (l < taken)
          add_turn(static_cast<int>(rows_.size()) - 1, static_cast<int>(l), patches_[list_[i + l]],
                   frames, contacts);
      }
      points += row.count;
    }
    const int rows = static_cast<int>(rows_.size()), balls = static_cast<int>(balls_.size());
    if (rows > row_before || balls > ball_before)
      stripes_.push_back({row_before, rows, ball_before, balls, c == colour_count});
  }
  points_.resize(points);
}

void SmallSteps::add_turn(int row, int lane, const Patch& patch, const BodyFrames& frames,
                          std::span<const Contact> contacts) {
  const Contact& c = contacts[patch.first];
  if (!(c.rolling_resistance > 0 || c.spinning_resistance > 0)) return;
  Turn t;
  t.row = row, t.lane = lane, t.first_contact = patch.first, t.count = patch.count;
  t.rolling = c.rolling_resistance, t.spinning = c.spinning_resistance;
  t.inverse_a = frames.inverse_inertia[patch.a], t.inverse_b = frames.inverse_inertia[patch.b];
  t.normal = c.normal;
  const Eigen::Matrix3d both = t.inverse_a + t.inverse_b;
  t.spin_step = inverse_or_zero(t.normal.dot(both * t.normal));
  // The trace of what is left bounds its largest eigenvalue.
  t.roll_step = inverse_or_zero(both.trace() - t.normal.dot(both * t.normal));
  t.impulse.setZero(), t.total.setZero();
  turns_.push_back(t);
}

void SmallSteps::resist_turning() {
  for (Turn& t : turns_) {
    const BulkRow& row = rows_[t.row];
    double load = 0;
    for (int k = 0; k < t.count; ++k) load += points_[row.first + k].impulse.lane[t.lane];
    Eigen::Map<Eigen::Vector3d> wa(bodies_[row.a[t.lane]].angular_velocity);
    Eigen::Map<Eigen::Vector3d> wb(bodies_[row.b[t.lane]].angular_velocity);
    const Eigen::Vector3d turning = wb - wa;
    const double spin_speed = t.normal.dot(turning);
    const double most_spin = t.spinning * load, most_roll = t.rolling * load;
    const double spin = std::clamp(-t.spin_step * spin_speed, -most_spin, most_spin);
    Eigen::Vector3d roll = -t.roll_step * (turning - spin_speed * t.normal);
    const double length = roll.norm();
    if (length > most_roll) roll *= most_roll / length;
    t.impulse = roll + spin * t.normal;
    const Eigen::Vector3d da = t.inverse_a * t.impulse, db = t.inverse_b * t.impulse;
    wa -= da, wb += db;
    t.total += t.impulse;
  }
}

void SmallSteps::write_turns(std::span<Contact> contacts) {
  for (const Turn& t : turns_)
    for (int k = 0; k < t.count; ++k)
      contacts[t.first_contact + k].turning_impulse = t.total / t.count;
}

void SmallSteps::take_small_step(const BulkBatch& batch, double h, bool first, BulkPart part,
                                 Workers* workers) {
  const BulkKernels& kernels = bulk_kernels();
  const auto meet = [&] {
    if (workers != nullptr) workers->meet();
  };
  const auto sweep = [&](auto kernel) {
    for (const BulkColour& colour : stripes_) kernel(batch, colour, part), meet();
  };
  kernels.begin(batch, part), meet();
  if (first) sweep(kernels.warm_start);
  sweep(kernels.press);
  kernels.move(batch, h, part), meet();
  if (!turns_.empty()) {
    if (part.index == 0) resist_turning();
    meet();
  }
  sweep(kernels.relax);
}

bool SmallSteps::just_placed(const BodyFrames& frames, std::span<const Contact> contacts) const {
  for (const int row : body_rows_)
    if (!frames.velocity_before[row].isZero(0) || !frames.omega_before[row].isZero(0)) return false;
  for (const Patch& p : patches_)
    for (int k = p.first; k < p.first + p.count; ++k)
      if (!contacts[k].impulse.isZero(0)) return false;
  return true;
}

// A scene set up at rest starts without impulses. Small steps that go nowhere find them first, or
// the heap would sag unevenly while they build up. Without push: a soft contact that does not sink
// bears too little.
void SmallSteps::find_loads(const BulkBatch& batch, int substeps) {
  const BulkKernels& kernels = bulk_kernels();
  start_.assign(bodies_.begin(), bodies_.end());
  for (int k = 0; k < load_rounds * substeps; ++k) {
    kernels.begin(batch, {});
    if (k == 0)
      for (const BulkColour& colour : stripes_) kernels.warm_start(batch, colour, {});
    for (const BulkColour& colour : stripes_) kernels.relax(batch, colour, {});
    for (BulkPoint& p : points_) p.impulse = p.relaxed;
    for (BulkRow& row : rows_) {
      std::ranges::copy(row.slip_relaxed, row.slip);
      row.twist = row.twist_relaxed;
    }
    for (BulkBall& row : balls_) {
      std::ranges::copy(row.slip_relaxed, row.slip);
      row.impulse = row.relaxed;
    }
    kernels.move(batch, 0, {});
    std::copy(start_.begin(), start_.end(), bodies_.begin());
  }
  for (BulkPoint& p : points_) p.total = Wide{};
  for (BulkRow& row : rows_) {
    row.twist_total = Wide{};
    for (Wide& w : row.slip_total) w = Wide{};
  }
  for (BulkBall& row : balls_) {
    row.total = Wide{};
    for (Wide& w : row.slip_total) w = Wide{};
  }
  for (Turn& t : turns_) t.total.setZero();
}

double SmallSteps::solve(BodyStates& states, const BodyFrames& frames, std::span<Contact> contacts,
                         ContactMotion& motion, double dt, int substeps, double& dissipated,
                         Workers* workers) {
  colour(states);
  place_bodies(states, frames, substeps);
  lay_rows(states, frames, contacts);
  const double h = dt / substeps;
  const BulkKernels& kernels = bulk_kernels();
  const BulkBatch batch{.bodies = bodies_.data(),
                        .frames = frames_.data(),
                        .kicks = kicks_.data(),
                        .rows = rows_.data(),
                        .points = points_.data(),
                        .balls = balls_.data(),
                        .colours = stripes_.data(),
                        .colour_count = static_cast<int>(stripes_.size()),
                        .row_count = static_cast<int>(rows_.size()),
                        .ball_count = static_cast<int>(balls_.size()),
                        .moving = static_cast<int>(body_rows_.size()),
                        .soft = coefficients(substeps, dt),
                        .substeps = static_cast<double>(substeps),
                        .h = h,
                        .inverse_h = 1 / h,
                        .push_speed = tolerance::push_speed,
                        .one_place = tolerance::one_place};
  const BulkContacts places = as_doubles(contacts);
  share(workers, [&](Part part) { kernels.prepare(batch, places, {part.index, part.count}); });
  const bool placed = just_placed(frames, contacts);
  if (placed) find_loads(batch, substeps);
  residual_.assign(workers != nullptr ? workers->count() : 1, 0);
  share(workers, [&](Part thread) {
    const BulkPart part{thread.index, thread.count};
    for (int k = 0; k < substeps; ++k) take_small_step(batch, h, k == 0 && !placed, part, workers);
    residual_[part.index] = kernels.residual(batch, part);
    kernels.write(batch, places, part);
  });
  write_turns(contacts);
  mark_felt(contacts);
  dissipated += take_back(states, frames, motion, dt, substeps);
  return std::ranges::max(residual_);
}

// What no contact pushed falls as if it were alone, not in small steps of first order.
void SmallSteps::mark_felt(std::span<const Contact> contacts) {
  felt_.assign(bodies_.size(), 0);
  for (const Patch& p : patches_)
    for (int k = p.first; k < p.first + p.count; ++k)
      if (!contacts[k].impulse.isZero(0)) felt_[slot_[p.a]] = felt_[slot_[p.b]] = 1;
}

double SmallSteps::take_back(BodyStates& states, const BodyFrames& frames, ContactMotion& motion,
                             double dt, int substeps) const {
  double dissipated = 0;
  const std::size_t moving = body_rows_.size();
  for (std::size_t i = 0; i < moving; ++i) {
    const int row = body_rows_[i];
    const BulkBody& body = bodies_[i];
    const Eigen::Vector3d v(body.velocity), w(body.angular_velocity);
    if (!felt_[i] &&
        same_but_for_rounding(v, frames.velocity[row], frames.velocity_before[row], substeps) &&
        same_but_for_rounding(w, frames.omega[row], frames.omega_before[row], substeps))
      continue;
    const Eigen::Quaterniond q = states.orientation[row];
    const Eigen::Vector3d twist = q.conjugate() * (w - frames.omega[row]);
    const Eigen::Vector3d gain = q * (states.moments[row].cwiseProduct(twist));  // kg m^2/s
    // Contact impulses times the mean velocity of the step: their work, whatever else acts.
    const Eigen::Vector3d push = states.mass[row] * (v - frames.velocity[row]);
    dissipated -=
        0.5 * (push.dot(v + frames.velocity_before[row]) + gain.dot(w + frames.omega_before[row]));
    states.velocity.set(row, v);
    states.angular_momentum.set(row, states.angular_momentum[row] + gain);
    motion.decided[row] = 1;
    motion.displacement.set(row, Eigen::Vector3d(body.displacement));
    motion.turn.set(row, Eigen::Vector3d(body.turn) - dt * w);
  }
  return dissipated;
}

}  // namespace carom::contact
