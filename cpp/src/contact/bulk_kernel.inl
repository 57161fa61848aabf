// SPDX-License-Identifier: Apache-2.0
// Sweeps over rows of patches. The kernel source is compiled once per CPU level, into a namespace
// of its own.

struct Soft {
  V rate, mass_scale, impulse_scale;
};

inline Soft softness_of(const BulkSoftness& soft, const Wide& against_static) {
  const Mask fixed = load(against_static) > splat(0);
  return {fixed ? splat(soft.bias_rate[1]) : splat(soft.bias_rate[0]),
          fixed ? splat(soft.mass_scale[1]) : splat(soft.mass_scale[0]),
          fixed ? splat(soft.impulse_scale[1]) : splat(soft.impulse_scale[0])};
}

/// Impulse of a normal after one soft (pressing) or rigid (not) step at gap `s`, speed `u`.
inline V pressed(bool pressing, V s, V u, V before, V mass, const Soft& soft, V inverse_h,
                 V push_speed) {
  const V zero = splat(0), one = splat(1);
  const Mask apart = s > zero;
  if (pressing) {
    const V bias = apart ? s * inverse_h : maximum(soft.rate * s, push_speed);
    const V scale = apart ? one : soft.mass_scale, leak = apart ? zero : soft.impulse_scale;
    return maximum(before - mass * scale * (u + bias) - leak * before, zero);
  } else {
    return maximum(before - mass * (u + (apart ? s * inverse_h : zero)), zero);
  }
}

inline void push_normal(Speeds& a, Speeds& b, const V3& n, const BulkPoint& p, V impulse) {
  a.v = add_times(a.v, -(a.inverse_mass * impulse), n);
  b.v = add_times(b.v, b.inverse_mass * impulse, n);
  a.w = add_times(a.w, -impulse, load(p.answer_a));
  b.w = add_times(b.w, impulse, load(p.answer_b));
}

inline void push_tangent(Speeds& a, Speeds& b, const BulkRow& row, const V3& f) {
  a.v = add_times(a.v, -a.inverse_mass, f);
  b.v = add_times(b.v, b.inverse_mass, f);
  a.w = difference(a.w, multiply(row.inertia_a, cross(load(row.arm_a), f)));
  b.w = sum(b.w, multiply(row.inertia_b, cross(load(row.arm_b), f)));
}

inline void twist_both(Speeds& a, Speeds& b, const BulkRow& row, V twist) {
  a.w = add_times(a.w, -twist, load(row.turn_a));
  b.w = add_times(b.w, twist, load(row.turn_b));
}

inline V normal_speed(const Speeds& a, const Speeds& b, const V3& n, const BulkPoint& p) {
  return dot(n, difference(b.v, a.v)) + (dot(load(p.arm_b), b.w) - dot(load(p.arm_a), a.w));
}

inline V3 slip_speed(const Speeds& a, const Speeds& b, const BulkRow& row, const V3& n) {
  const V3 u =
      difference(sum(b.v, cross(b.w, load(row.arm_b))), sum(a.v, cross(a.w, load(row.arm_a))));
  return add_times(u, -dot(n, u), n);
}

/// Shortens `f` to the bound.
inline V3 within(const V3& f, V bound) {
  return times(minimum(splat(1), bound / maximum(magnitude(f), splat(tiny))), f);
}

/// How far and how much both sides of the lanes moved against each other since the step began.
struct Motion {
  V drift;
  V3 turned_a, turned_b;

  Motion(const BulkBatch& batch, const BulkRow& row, const V3& n) {
    V3 moved_a, moved_b;
    V unused;
    gather(batch.bodies, row.a, 2, moved_a, unused);
    gather(batch.bodies, row.b, 2, moved_b, unused);
    gather(batch.bodies, row.a, 3, turned_a, unused);
    gather(batch.bodies, row.b, 3, turned_b, unused);
    drift = dot(n, difference(moved_b, moved_a));
  }
  V gap(const BulkPoint& p) const {
    return load(p.separation) + drift +
           (dot(load(p.arm_b), turned_b) - dot(load(p.arm_a), turned_a));
  }
};

inline void warm_start_row(const BulkBatch& batch, const BulkRow& row) {
  Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
  const V3 n = load(row.normal);
  for (int k = 0; k < row.count; ++k) {
    const BulkPoint& p = batch.points[row.first + k];
    push_normal(a, b, n, p, load(p.impulse));
  }
  push_tangent(a, b, row, load(row.slip));
  twist_both(a, b, row, load(row.twist));
  scatter_speeds(batch, row.a, a);
  scatter_speeds(batch, row.b, b);
}

/// Friction of a patch. Pressing without it would let bodies slide on what presses them. Pressing
/// starts from what it ended with, never from the relaxed impulse: so its friction is the sum of
/// all slip that moved the bodies, a spring that holds them in place. Started from the relaxed one,
/// every small step slips a little and forgets it, and a heap creeps for ever.
template <bool pressing>
[[gnu::always_inline]] inline void rub(const BulkBatch& batch, BulkRow& row, const V3& n, Speeds& a,
                                       Speeds& b) {
  V bound = splat(0), twist_bound = splat(0);
  for (int k = 0; k < row.count; ++k) {
    const BulkPoint& p = batch.points[row.first + k];
    const V impulse = load(p.impulse);
    bound += impulse;
    twist_bound = multiply_add(impulse, load(p.spread), twist_bound);
  }
  const V mu = load(row.friction);
  bound *= mu, twist_bound *= mu;
  // One after the other: taken together the two overshoot where the patch lies off the centres.
  const V twist_before = load(row.twist);
  V twist = twist_before - load(row.twist_mass) * dot(n, difference(b.w, a.w));
  twist = maximum(-twist_bound, minimum(twist_bound, twist));
  twist_both(a, b, row, twist - twist_before);
  const V3 before = load(row.slip);
  const V3 after =
      within(add_times(before, -load(row.tangent_step), slip_speed(a, b, row, n)), bound);
  push_tangent(a, b, row, difference(after, before));
  if constexpr (pressing) {
    store(row.slip, after);
    store(row.twist, twist);
  } else {
    store(row.slip_relaxed, after);
    store(row.twist_relaxed, twist);
    store(row.slip_total, sum(load(row.slip_total), after));
    store(row.twist_total, load(row.twist_total) + twist);
  }
}

template <bool pressing>
inline void sweep_row(const BulkBatch& batch, BulkRow& row) {
  const V inverse_h = splat(batch.inverse_h), push_speed = splat(-batch.push_speed);
  Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
  const V3 n = load(row.normal);
  const Motion motion(batch, row, n);
  rub<pressing>(batch, row, n, a, b);
  const Soft soft = softness_of(batch.soft, row.against_static);
  for (int k = 0; k < row.count; ++k) {
    BulkPoint& p = batch.points[row.first + k];
    const V before = load(p.impulse);
    const V after = pressed(pressing, motion.gap(p), normal_speed(a, b, n, p), before, load(p.mass),
                            soft, inverse_h, push_speed);
    if constexpr (pressing) {
      store(p.impulse, after);
    } else {
      store(p.relaxed, after);
      store(p.total, load(p.total) + after);
    }
    push_normal(a, b, n, p, after - before);
  }
  scatter_speeds(batch, row.a, a);
  scatter_speeds(batch, row.b, b);
}

/// How far an impulse is from what its law asks for at the speed it meets, m/s; 0 without a mass.
inline V unmet_normal(V s, V u, V impulse, V mass, V inverse_h) {
  const V zero = splat(0);
  const V change = impulse - maximum(impulse - mass * (u + maximum(s, zero) * inverse_h), zero);
  const V speed = maximum(change, -change) / maximum(mass, splat(tiny));
  return mass > zero ? speed : zero;
}
inline V unmet_slip(const V3& slip, const V3& speed, V step, V bound) {
  const V3 d = difference(slip, within(add_times(slip, -step, speed), bound));
  return step > splat(0) ? magnitude(d) / maximum(step, splat(tiny)) : splat(0);
}

inline V unmet_row(const BulkBatch& batch, const BulkRow& row) {
  const V inverse_h = splat(batch.inverse_h);
  const Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
  const V3 n = load(row.normal);
  const Motion motion(batch, row, n);
  V worst = splat(0), bound = splat(0);
  for (int k = 0; k < row.count; ++k) {
    const BulkPoint& p = batch.points[row.first + k];
    const V impulse = load(p.relaxed);
    worst = maximum(worst, unmet_normal(motion.gap(p), normal_speed(a, b, n, p), impulse,
                                        load(p.mass), inverse_h));
    bound += impulse;
  }
  return maximum(worst, unmet_slip(load(row.slip_relaxed), slip_speed(a, b, row, n),
                                   load(row.tangent_step), bound * load(row.friction)));
}
