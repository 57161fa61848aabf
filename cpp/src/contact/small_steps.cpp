// SPDX-License-Identifier: Apache-2.0
#include "contact/small_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "carom/numerics/tolerance.hpp"

namespace carom::contact {
namespace {

constexpr int colour_count = 64;
constexpr int load_rounds = 16;  // loads travel about one layer per small step

void set(Wide (&w)[3], int lane, const Eigen::Vector3d& v) {
  for (int k = 0; k < 3; ++k) w[k].lane[lane] = v[k];
}

Eigen::Vector3d get(const Wide (&w)[3], int lane) {
  return {w[0].lane[lane], w[1].lane[lane], w[2].lane[lane]};
}

void set(Wide (&w)[6], int lane, const Eigen::Matrix3d& m) {
  w[0].lane[lane] = m(0, 0), w[1].lane[lane] = m(1, 1), w[2].lane[lane] = m(2, 2);
  w[3].lane[lane] = m(0, 1), w[4].lane[lane] = m(0, 2), w[5].lane[lane] = m(1, 2);
}

double inverse_or_zero(double x) {
  return x > 0 ? 1 / x : 0;
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

void SmallSteps::prepare(const BodyStates& states, const BodyFrames& frames,
                         std::span<const Contact> contacts, double dt, int substeps) {
  const int moving = static_cast<int>(body_rows_.size());
  const int slots = moving + static_cast<int>(static_rows_.size());
  bodies_.resize(slots + 1);  // the last takes the empty lanes
  kick_.resize(6 * static_cast<std::size_t>(moving));
  std::fill(bodies_.begin(), bodies_.end(), BulkBody{});
  for (int s = 0; s < slots; ++s) {
    const int row = s < moving ? body_rows_[s] : static_rows_[s - moving];
    BulkBody& body = bodies_[s];
    const bool moves = s < moving;
    const Eigen::Vector3d v = moves ? frames.velocity_before[row] : states.velocity[row];
    const Eigen::Vector3d w = moves ? frames.omega_before[row] : frames.omega[row];
    for (int k = 0; k < 3; ++k) body.velocity[k] = v[k], body.angular_velocity[k] = w[k];
    body.inverse_mass = states.inverse_mass[row];
    if (!moves) continue;
    const Eigen::Vector3d dv = (frames.velocity[row] - frames.velocity_before[row]) / substeps;
    const Eigen::Vector3d dw = (frames.omega[row] - frames.omega_before[row]) / substeps;
    for (int k = 0; k < 3; ++k) kick_[6 * s + k] = dv[k], kick_[6 * s + 3 + k] = dw[k];
  }

  lane_patch_.clear();
  turns_.clear();
  rows_.clear();
  std::size_t points = 0;
  for (int c = 0; c <= colour_count; ++c) {
    // Patches of one size share rows, so that few lanes run empty.
    auto& list = colours_[c];
    std::ranges::sort(list, [&](int i, int j) {
      return std::pair(-patches_[i].count, i) < std::pair(-patches_[j].count, j);
    });
    const std::size_t lanes = c < colour_count ? 4 : 1;
    for (std::size_t i = 0; i < list.size(); i += lanes) {
      BulkRow& row = rows_.emplace_back();
      row.first = static_cast<int>(points);
      row.count = patches_[list[i]].count;
      points += row.count;
      for (std::size_t l = 0; l < 4; ++l)
        lane_patch_.push_back(l < lanes && i + l < list.size() ? list[i + l] : -1);
    }
  }
  points_.resize(points);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    BulkRow& row = rows_[r];
    const int first = row.first, count = row.count;
    row = BulkRow{};
    row.first = first, row.count = count;
    for (int k = 0; k < count; ++k) points_[first + k] = BulkPoint{};
    for (int lane = 0; lane < 4; ++lane) {
      row.a[lane] = row.b[lane] = slots;
      const int patch = lane_patch_[4 * r + lane];
      if (patch < 0) continue;
      fill(row, lane, patches_[patch], states, frames, contacts, dt, substeps);
      add_turn(static_cast<int>(r), lane, patches_[patch], frames, contacts);
    }
  }
}

void SmallSteps::fill(BulkRow& row, int lane, const Patch& patch, const BodyStates& states,
                      const BodyFrames& frames, std::span<const Contact> contacts, double dt,
                      int substeps) {
  const std::span<const Contact> mine = contacts.subspan(patch.first, patch.count);
  const Eigen::Vector3d n = mine[0].normal;
  const Eigen::Vector3d xa = states.position[patch.a], xb = states.position[patch.b];
  const Eigen::Matrix3d &ia = frames.inverse_inertia[patch.a],
                        &ib = frames.inverse_inertia[patch.b];
  const double ma = states.inverse_mass[patch.a], mb = states.inverse_mass[patch.b];
  row.a[lane] = slot_[patch.a], row.b[lane] = slot_[patch.b];
  set(row.normal, lane, n);
  set(row.inertia_a, lane, ia);
  set(row.inertia_b, lane, ib);
  row.friction.lane[lane] = mine[0].friction;

  const bool against_static = !states.moves[patch.a] || !states.moves[patch.b];
  const Softness soft = softness(substeps, dt, against_static);
  const double h = dt / substeps, omega = 2 * std::numbers::pi * soft.frequency;
  const double a1 = 2 * soft.damping_ratio + h * omega, a2 = h * omega * a1;
  row.bias_rate.lane[lane] = omega / a1;
  row.mass_scale.lane[lane] = a2 / (1 + a2);
  row.impulse_scale.lane[lane] = 1 / (1 + a2);

  // The patch's centre: where the load was, so that the friction force has the right lever.
  double weight = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), slip = Eigen::Vector3d::Zero();
  for (const Contact& c : mine) {
    const double w = std::max(c.impulse.dot(n), 0.0);
    centre += w * c.position, weight += w;
  }
  if (weight > 0) {
    centre /= weight;
  } else {
    for (const Contact& c : mine) centre += c.position;
    centre /= patch.count;
  }
  double twist = 0;
  for (int k = 0; k < patch.count; ++k) {
    const Contact& c = mine[k];
    BulkPoint& p = points_[row.first + k];
    const Eigen::Vector3d ra = c.position - xa, rb = c.position - xb;
    const Eigen::Vector3d an = ra.cross(n), bn = rb.cross(n);
    const Eigen::Vector3d answer_a = ia * an, answer_b = ib * bn;
    set(p.arm_a, lane, an), set(p.arm_b, lane, bn);
    set(p.answer_a, lane, answer_a), set(p.answer_b, lane, answer_b);
    p.mass.lane[lane] = inverse_or_zero(ma + mb + an.dot(answer_a) + bn.dot(answer_b));
    p.separation.lane[lane] = c.separation;
    const double normal = std::max(c.impulse.dot(n), 0.0);
    p.impulse.lane[lane] = normal / substeps;
    const Eigen::Vector3d tangent = c.impulse - c.impulse.dot(n) * n;
    slip += tangent;
    const Eigen::Vector3d off = c.position - centre;
    twist += n.dot(off.cross(tangent));
    p.spread.lane[lane] = (off - n.dot(off) * n).norm();
  }
  const Eigen::Vector3d ra = centre - xa, rb = centre - xb;
  set(row.arm_a, lane, ra), set(row.arm_b, lane, rb);
  const Eigen::Matrix3d f = frame_about(n);
  const Eigen::Vector3d a1t = ra.cross(f.col(1)), a2t = ra.cross(f.col(2)),
                        b1t = rb.cross(f.col(1)), b2t = rb.cross(f.col(2));
  const double w11 = ma + mb + a1t.dot(ia * a1t) + b1t.dot(ib * b1t);
  const double w22 = ma + mb + a2t.dot(ia * a2t) + b2t.dot(ib * b2t);
  const double w12 = a1t.dot(ia * a2t) + b1t.dot(ib * b2t);
  // One step length for both directions: unequal ones have another fixed point than Coulomb's.
  const double largest = 0.5 * (w11 + w22) + std::hypot(0.5 * (w11 - w22), w12);
  row.tangent_step.lane[lane] = inverse_or_zero(largest);
  set(row.slip, lane, slip / substeps);
  if (patch.count > 1) {
    row.twist_mass.lane[lane] = inverse_or_zero(n.dot((ia + ib) * n));
    row.twist.lane[lane] = twist / substeps;
  }
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
    wa -= t.inverse_a * t.impulse, wb += t.inverse_b * t.impulse;
    t.total += t.impulse;
  }
}

void SmallSteps::write_turns(std::span<Contact> contacts) {
  for (const Turn& t : turns_)
    for (int k = 0; k < t.count; ++k)
      contacts[t.first_contact + k].turning_impulse = t.total / t.count;
}

// The patch's friction goes back to its points: the force in proportion to their loads, the twist
// about the centre of these loads, where it adds no force.
template <class NormalOf, class Assign>
void SmallSteps::spread(const BulkRow& row, int lane, const Patch& patch,
                        const Eigen::Vector3d& slip, double twist, NormalOf normal_of,
                        Assign assign) {
  const Eigen::Vector3d n = get(row.normal, lane), arm = get(row.arm_b, lane);
  const Eigen::Vector3d centre = arm - n.dot(arm) * n;
  const auto lever = [&](int k) -> Eigen::Vector3d {
    // (r x n) x n is minus the tangent part of r.
    return -get(points_[row.first + k].arm_b, lane).cross(n) - centre;
  };
  double load = 0, moment = 0, reach = 0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (int k = 0; k < patch.count; ++k) {
    const double normal = normal_of(points_[row.first + k]);
    load += normal, offset += normal * lever(k);
  }
  if (load > 0) offset /= load;
  for (int k = 0; k < patch.count; ++k) {
    const double normal = normal_of(points_[row.first + k]);
    const double d = (lever(k) - offset).norm();
    moment += normal * d * d, reach += normal * d;
  }
  const double most = row.friction.lane[lane] * reach;
  twist = std::clamp(twist - n.dot(offset.cross(slip)), -most, most);
  for (int k = 0; k < patch.count; ++k) {
    const double normal = normal_of(points_[row.first + k]);
    Eigen::Vector3d impulse = normal * n;
    if (load > 0) impulse += normal / load * slip;
    if (moment > 0) impulse += twist * normal / moment * n.cross(lever(k) - offset);
    assign(patch.first + k, impulse);
  }
}

void SmallSteps::write_impulses(std::span<Contact> contacts, int substeps) {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const BulkRow& row = rows_[r];
    for (int lane = 0; lane < 4; ++lane) {
      const int index = lane_patch_[4 * r + lane];
      if (index < 0) continue;
      const Patch& patch = patches_[index];
      spread(
          row, lane, patch, get(row.slip_total, lane), row.twist_total.lane[lane],
          [&](const BulkPoint& p) { return p.total.lane[lane]; },
          [&](int k, const Eigen::Vector3d& f) { contacts[k].impulse = f; });
      spread(
          row, lane, patch, substeps * get(row.slip, lane), substeps * row.twist.lane[lane],
          [&](const BulkPoint& p) { return substeps * p.impulse.lane[lane]; },
          [&](int k, const Eigen::Vector3d& f) { contacts[k].impulse_at_end = f; });
    }
  }
}

void SmallSteps::take_small_step(const BulkBatch& batch, double h) {
  const BulkKernels& kernels = bulk_kernels();
  const std::size_t moving = body_rows_.size();
  for (std::size_t i = 0; i < moving; ++i)
    for (int j = 0; j < 3; ++j) {
      bodies_[i].velocity[j] += kick_[6 * i + j];
      bodies_[i].angular_velocity[j] += kick_[6 * i + 3 + j];
    }
  kernels.warm_start(batch);
  kernels.press(batch);
  for (std::size_t i = 0; i < moving; ++i)
    for (int j = 0; j < 3; ++j) {
      bodies_[i].displacement[j] += h * bodies_[i].velocity[j];
      bodies_[i].turn[j] += h * bodies_[i].angular_velocity[j];
    }
  resist_turning();
  kernels.relax(batch);
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
// the heap would sag unevenly while they build up.
void SmallSteps::find_loads(const BulkBatch& batch, int substeps) {
  start_.assign(bodies_.begin(), bodies_.end());
  for (int k = 0; k < load_rounds * substeps; ++k) {
    take_small_step(batch, 0);
    std::copy(start_.begin(), start_.end(), bodies_.begin());
  }
  for (BulkPoint& p : points_) p.total = Wide{};
  for (BulkRow& row : rows_) {
    row.twist_total = Wide{};
    for (Wide& w : row.slip_total) w = Wide{};
  }
  for (Turn& t : turns_) t.total.setZero();
}

double SmallSteps::solve(BodyStates& states, const BodyFrames& frames, std::span<Contact> contacts,
                         ContactMotion& motion, double dt, int substeps, double& dissipated) {
  colour(states);
  prepare(states, frames, contacts, dt, substeps);
  const double h = dt / substeps;
  const BulkKernels& kernels = bulk_kernels();
  const BulkBatch batch{bodies_.data(), rows_.data(),
                        points_.data(), static_cast<int>(rows_.size()),
                        1 / h,          tolerance::push_speed};
  const std::size_t moving = body_rows_.size();
  if (just_placed(frames, contacts)) find_loads(batch, substeps);
  for (int k = 0; k < substeps; ++k) take_small_step(batch, h);
  const double residual = kernels.residual(batch);
  write_impulses(contacts, substeps);
  write_turns(contacts);

  for (std::size_t i = 0; i < moving; ++i) {
    const int row = body_rows_[i];
    const BulkBody& body = bodies_[i];
    const Eigen::Vector3d v(body.velocity), w(body.angular_velocity);
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
  return residual;
}

}  // namespace carom::contact
