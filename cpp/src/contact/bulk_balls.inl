// SPDX-License-Identifier: Apache-2.0
// The same sweeps over rows of balls: single points with no lever against their normal.

inline void push_ball(Speeds& a, Speeds& b, const BulkBall& row, const V3& n, const V3& f) {
  a.v = add_times(a.v, -a.inverse_mass, f);
  b.v = add_times(b.v, b.inverse_mass, f);
  const V3 about = cross(n, f);
  a.w = add_times(a.w, -(load(row.inertia_a) * load(row.lever_a)), about);
  b.w = add_times(b.w, load(row.inertia_b) * load(row.lever_b), about);
}

inline V3 slip_speed(const Speeds& a, const Speeds& b, const BulkBall& row, const V3& n) {
  const V3 turning = difference(times(load(row.lever_b), b.w), times(load(row.lever_a), a.w));
  const V3 u = sum(difference(b.v, a.v), cross(turning, n));
  return add_times(u, -dot(n, u), n);
}

inline V gap(const BulkBatch& batch, const BulkBall& row, const V3& n) {
  V3 moved_a, moved_b;
  V unused;
  gather(batch.bodies, row.a, 2, moved_a, unused);
  gather(batch.bodies, row.b, 2, moved_b, unused);
  return load(row.separation) + dot(n, difference(moved_b, moved_a));
}

inline void warm_start_ball(const BulkBatch& batch, const BulkBall& row) {
  Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
  const V3 n = load(row.normal);
  push_ball(a, b, row, n, add_times(load(row.slip), load(row.impulse), n));
  scatter_speeds(batch, row.a, a);
  scatter_speeds(batch, row.b, b);
}

template <bool pressing>
inline void sweep_ball(const BulkBatch& batch, BulkBall& row) {
  Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
  const V3 n = load(row.normal);
  const V s = gap(batch, row, n), before = load(row.impulse);
  const Soft soft = softness_of(batch.soft, row.against_static);
  const V3 slip = load(row.slip);
  const V3 slip_after = within(add_times(slip, -load(row.tangent_step), slip_speed(a, b, row, n)),
                               before * load(row.friction));
  // Friction is tangential, so the normal speed is what it was before it.
  const V u = dot(n, difference(b.v, a.v));
  const V after = pressed(pressing, s, u, before, load(row.mass), soft, splat(batch.inverse_h),
                          splat(-batch.push_speed));
  push_ball(a, b, row, n, add_times(difference(slip_after, slip), after - before, n));
  if constexpr (pressing) {
    store(row.slip, slip_after);
    store(row.impulse, after);
  } else {
    store(row.slip_relaxed, slip_after);
    store(row.relaxed, after);
    store(row.total, load(row.total) + after);
    store(row.slip_total, sum(load(row.slip_total), slip_after));
  }
  scatter_speeds(batch, row.a, a);
  scatter_speeds(batch, row.b, b);
}

inline V unmet_ball(const BulkBatch& batch, const BulkBall& row) {
  const Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
  const V3 n = load(row.normal);
  const V impulse = load(row.relaxed);
  const V normal = unmet_normal(gap(batch, row, n), dot(n, difference(b.v, a.v)), impulse,
                                load(row.mass), splat(batch.inverse_h));
  return maximum(normal, unmet_slip(load(row.slip_relaxed), slip_speed(a, b, row, n),
                                    load(row.tangent_step), impulse * load(row.friction)));
}
