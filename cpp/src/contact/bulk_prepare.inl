// SPDX-License-Identifier: Apache-2.0
// From contacts to rows of lanes, and from their impulses back to contacts.

/// Zeros to read where a lane is empty; never written.
alignas(32) constexpr double nothing[64] = {};

struct Quad {
  V x, y, z, w;
};

inline V load_from(const double* p) {
  V v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

inline Quad gather_quads(const double* const (&from)[4], std::ptrdiff_t at) {
  Quad q{load_from(from[0] + at), load_from(from[1] + at), load_from(from[2] + at),
         load_from(from[3] + at)};
  transpose(q.x, q.y, q.z, q.w);
  return q;
}
inline V3 three(const Quad& q) {
  return {q.x, q.y, q.z};
}

/// The contacts of the lanes' k-th points.
inline void contacts_at(const BulkContacts& contacts, const int (&first)[4], const int (&count)[4],
                        int k, const double* (&out)[4]) {
  for (int l = 0; l < 4; ++l)
    out[l] = k < count[l] ? contacts.first + (first[l] + k) * contacts.stride : nothing;
}

struct Fixed {
  V3 position;
  V inverse_mass;
  V inertia[6];

  Fixed(const BulkBatch& batch, const int (&slot)[4]) {
    const double* from[4];
    for (int l = 0; l < 4; ++l) from[l] = batch.frames[slot[l]].position;
    const Quad x = gather_quads(from, 0), i = gather_quads(from, 4), j = gather_quads(from, 8);
    position = three(x), inverse_mass = x.w;
    inertia[0] = i.x, inertia[1] = i.y, inertia[2] = i.z;
    inertia[3] = i.w, inertia[4] = j.x, inertia[5] = j.y;
  }
};

inline void store(Wide (&w)[6], const V (&m)[6]) {
  for (int k = 0; k < 6; ++k) store(w[k], m[k]);
}

/// Two directions that span the plane of a unit normal. Duff et al. 2017.
inline void tangents(const V3& n, V3& t1, V3& t2) {
  const V one = splat(1);
  const V sign = n.z < splat(0) ? -one : one;
  const V a = -one / (sign + n.z), b = n.x * n.y * a;
  t1 = {one + sign * n.x * n.x * a, sign * b, -sign * n.x};
  t2 = {b, sign + n.y * n.y * a, -n.y};
}

/// Largest eigenvalue of the tangent mobility: one step length for both directions, as unequal ones
/// have another fixed point than Coulomb's.
inline V largest_mobility(const Fixed& a, const Fixed& b, const V3& ra, const V3& rb, const V3& n) {
  V3 t1, t2;
  tangents(n, t1, t2);
  const V3 a1 = cross(ra, t1), a2 = cross(ra, t2), b1 = cross(rb, t1), b2 = cross(rb, t2);
  const V3 ia2 = multiply(a.inertia, a2), ib2 = multiply(b.inertia, b2);
  const V both = a.inverse_mass + b.inverse_mass;
  const V w11 = both + dot(a1, multiply(a.inertia, a1)) + dot(b1, multiply(b.inertia, b1));
  const V w22 = both + dot(a2, ia2) + dot(b2, ib2);
  const V w12 = dot(a1, ia2) + dot(b1, ib2);
  const V half = splat(0.5), d = half * (w11 - w22);
  return half * (w11 + w22) + square_root(multiply_add(d, d, w12 * w12));
}

inline void prepare_row(const BulkBatch& batch, const BulkContacts& contacts, BulkRow& row) {
  const V zero = splat(0), share = splat(1 / batch.substeps);
  const Fixed a(batch, row.a), b(batch, row.b);
  const double* at[4];
  contacts_at(contacts, row.contact, row.lane_points, 0, at);
  const V3 n = three(gather_quads(at, contacts.normal));
  store(row.normal, n);
  store(row.friction, gather_quads(at, contacts.friction).x);
  store(row.inertia_a, a.inertia), store(row.inertia_b, b.inertia);

  // The patch's centre: where the load was, so that the friction force has the right lever.
  V weight = zero, number = zero;
  V3 loaded{zero, zero, zero}, plain = loaded, slip = loaded;
  for (int k = 0; k < row.count; ++k) {
    contacts_at(contacts, row.contact, row.lane_points, k, at);
    const Quad where = gather_quads(at, contacts.position);
    const V3 impulse = three(gather_quads(at, contacts.impulse));
    const V along = dot(impulse, n), normal = maximum(along, zero);
    loaded = add_times(loaded, normal, three(where)), weight += normal;
    plain = sum(plain, three(where)), number += at_lane(row.lane_points, k);
    slip = sum(slip, add_times(impulse, -along, n));
    BulkPoint& p = batch.points[row.first + k];
    store(p.impulse, normal * share);
    store(p.total, zero);
    store(p.separation, where.w);
  }
  const Mask has_load = weight > zero;
  const V3 centre = times(splat(1) / (has_load ? weight : maximum(number, splat(1))),
                          {has_load ? loaded.x : plain.x, has_load ? loaded.y : plain.y,
                           has_load ? loaded.z : plain.z});
  V twist = zero;
  for (int k = 0; k < row.count; ++k) {
    contacts_at(contacts, row.contact, row.lane_points, k, at);
    const V3 where = three(gather_quads(at, contacts.position));
    const V3 impulse = three(gather_quads(at, contacts.impulse));
    const V3 off = difference(where, centre);
    twist += dot(n, cross(off, impulse));
    BulkPoint& p = batch.points[row.first + k];
    store(p.spread, magnitude(add_times(off, -dot(n, off), n)));
    const V3 arm_a = cross(difference(where, a.position), n);
    const V3 arm_b = cross(difference(where, b.position), n);
    const V3 answer_a = multiply(a.inertia, arm_a), answer_b = multiply(b.inertia, arm_b);
    store(p.arm_a, arm_a), store(p.arm_b, arm_b);
    store(p.answer_a, answer_a), store(p.answer_b, answer_b);
    const V mobility =
        a.inverse_mass + b.inverse_mass + dot(arm_a, answer_a) + dot(arm_b, answer_b);
    store(p.mass, at_lane(row.lane_points, k) * inverse_or_zero(mobility));
  }
  const V3 ra = difference(centre, a.position), rb = difference(centre, b.position);
  store(row.arm_a, ra), store(row.arm_b, rb);
  const V taken = at_lane(row.lane_points, 0);
  store(row.tangent_step, taken * inverse_or_zero(largest_mobility(a, b, ra, rb, n)));
  store(row.slip, times(share, slip));
  const V several = at_lane(row.lane_points, 1);
  const V3 turn_a = multiply(a.inertia, n), turn_b = multiply(b.inertia, n);
  store(row.turn_a, turn_a), store(row.turn_b, turn_b);
  const V spin = dot(n, sum(turn_a, turn_b));
  store(row.twist_mass, several * inverse_or_zero(spin));
  store(row.twist, several * twist * share);
  store(row.slip_total, {zero, zero, zero});
  store(row.twist_total, zero);
}

inline void prepare_ball(const BulkBatch& batch, const BulkContacts& contacts, BulkBall& row) {
  const V zero = splat(0), share = splat(1 / batch.substeps);
  const Fixed a(batch, row.a), b(batch, row.b);
  int taken[4];
  for (int l = 0; l < 4; ++l) taken[l] = row.contact[l] >= 0;
  const double* at[4];
  contacts_at(contacts, row.contact, taken, 0, at);
  const V3 n = three(gather_quads(at, contacts.normal));
  const Quad where = gather_quads(at, contacts.position);
  const V3 impulse = three(gather_quads(at, contacts.impulse));
  store(row.normal, n);
  store(row.friction, gather_quads(at, contacts.friction).x);
  const V lever_a = dot(n, difference(three(where), a.position));
  const V lever_b = dot(n, difference(three(where), b.position));
  store(row.lever_a, lever_a), store(row.lever_b, lever_b);
  store(row.inertia_a, a.inertia[0]), store(row.inertia_b, b.inertia[0]);
  const V both = a.inverse_mass + b.inverse_mass;
  const V turning = multiply_add(lever_a * lever_a, a.inertia[0], lever_b * lever_b * b.inertia[0]);
  store(row.mass, at_lane(taken, 0) * inverse_or_zero(both));
  store(row.tangent_step, at_lane(taken, 0) * inverse_or_zero(both + turning));
  store(row.separation, where.w);
  const V along = dot(impulse, n);
  store(row.impulse, maximum(along, zero) * share);
  store(row.slip, times(share, add_times(impulse, -along, n)));
  store(row.total, zero);
  store(row.slip_total, {zero, zero, zero});
}

inline void scatter_vectors(const BulkContacts& contacts, const int (&first)[4],
                            const int (&count)[4], int k, std::ptrdiff_t at, const V3& v) {
  V x = v.x, y = v.y, z = v.z, unused = splat(0);
  transpose(x, y, z, unused);
  const V lanes[4] = {x, y, z, unused};
  for (int l = 0; l < 4; ++l)
    if (k < count[l])
      __builtin_memcpy(contacts.first + (first[l] + k) * contacts.stride + at, &lanes[l],
                       3 * sizeof(double));
}

/// From the centre, in the tangent plane: (r x n) x n is minus the tangent part of r.
inline V3 lever(const BulkPoint& p, const V3& n, const V3& centre) {
  return difference(cross(n, load(p.arm_b)), centre);
}

/// The patch's friction goes back to its points: the force in proportion to their loads, the twist
/// about the centre of these loads, where it adds no force. `impulse`: the member that holds the
/// normal impulses, `scale` what they are to be taken times.
inline void write_patch(const BulkBatch& batch, const BulkContacts& contacts, const BulkRow& row,
                        const V3& slip, V twist, std::ptrdiff_t to, Wide BulkPoint::* impulse,
                        V scale) {
  const V zero = splat(0);
  const V3 n = load(row.normal), arm = load(row.arm_b);
  const V3 centre = add_times(arm, -dot(n, arm), n);
  V total = zero, moment = zero, reach = zero;
  V3 offset{zero, zero, zero};
  for (int k = 0; k < row.count; ++k) {
    const BulkPoint& p = batch.points[row.first + k];
    const V normal = scale * load(p.*impulse);
    total += normal, offset = add_times(offset, normal, lever(p, n, centre));
  }
  const V per_load = inverse_or_zero(total);
  offset = times(per_load, offset);
  // Where one point carries all, its distance from the centre of the loads is rounding, and a twist
  // over it would be a friction force of any direction.
  const V nearest = splat(batch.one_place * batch.one_place) * dot(arm, arm);
  for (int k = 0; k < row.count; ++k) {
    const BulkPoint& p = batch.points[row.first + k];
    const V3 off = difference(lever(p, n, centre), offset);
    const V distance = dot(off, off), square = distance > nearest ? distance : zero;
    moment = multiply_add(scale * load(p.*impulse), square, moment);
    reach = multiply_add(scale * load(p.*impulse), square_root(square), reach);
  }
  const V most = load(row.friction) * reach;
  twist = maximum(-most, minimum(most, twist - dot(n, cross(offset, slip))));
  const V per_moment = twist * inverse_or_zero(moment);
  for (int k = 0; k < row.count; ++k) {
    const BulkPoint& p = batch.points[row.first + k];
    const V normal = scale * load(p.*impulse);
    const V3 off = difference(lever(p, n, centre), offset);
    const V3 f = add_times(add_times(times(normal, n), normal * per_load, slip),
                           normal * per_moment, cross(n, off));
    scatter_vectors(contacts, row.contact, row.lane_points, k, to, f);
  }
}

inline void write_row(const BulkBatch& batch, const BulkContacts& contacts, const BulkRow& row) {
  write_patch(batch, contacts, row, load(row.slip_total), load(row.twist_total), contacts.impulse,
              &BulkPoint::total, splat(1));
  const V all = splat(batch.substeps);
  write_patch(batch, contacts, row, times(all, load(row.slip)), all * load(row.twist),
              contacts.impulse_at_end, &BulkPoint::impulse, all);
}

inline void write_ball(const BulkBatch& batch, const BulkContacts& contacts, const BulkBall& row) {
  int taken[4];
  for (int l = 0; l < 4; ++l) taken[l] = row.contact[l] >= 0;
  const V3 n = load(row.normal);
  scatter_vectors(contacts, row.contact, taken, 0, contacts.impulse,
                  add_times(load(row.slip_total), load(row.total), n));
  scatter_vectors(contacts, row.contact, taken, 0, contacts.impulse_at_end,
                  times(splat(batch.substeps), add_times(load(row.slip), load(row.impulse), n)));
}
