// SPDX-License-Identifier: Apache-2.0
// The kernel source, compiled once per CPU level into a namespace of its own. GCC's vector types
// carry it: four doubles are one AVX register, or two of SSE2 or NEON.

using V = double __attribute__((vector_size(32)));
using Mask = long long __attribute__((vector_size(32)));

struct V3 {
  V x, y, z;
};

inline V load(const Wide& w) {
  return *reinterpret_cast<const V*>(w.lane);
}
inline V3 load(const Wide (&w)[3]) {
  return {load(w[0]), load(w[1]), load(w[2])};
}
inline void store(Wide& w, V v) {
  *reinterpret_cast<V*>(w.lane) = v;
}
inline void store(Wide (&w)[3], const V3& v) {
  store(w[0], v.x), store(w[1], v.y), store(w[2], v.z);
}
inline V splat(double x) {
  return V{x, x, x, x};
}
inline V maximum(V a, V b) {
  return a > b ? a : b;
}
inline V minimum(V a, V b) {
  return a < b ? a : b;
}
inline V dot(const V3& a, const V3& b) {
  return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z));
}
inline V3 sum(const V3& a, const V3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline V3 difference(const V3& a, const V3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline V3 times(V s, const V3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// y + s a
inline V3 add_times(const V3& y, V s, const V3& a) {
  return {multiply_add(s, a.x, y.x), multiply_add(s, a.y, y.y), multiply_add(s, a.z, y.z)};
}
inline V3 cross(const V3& a, const V3& b) {
  return {multiply_add(a.y, b.z, -(a.z * b.y)), multiply_add(a.z, b.x, -(a.x * b.z)),
          multiply_add(a.x, b.y, -(a.y * b.x))};
}
inline V3 multiply(const Wide (&m)[6], const V3& v) {
  const V xy = load(m[3]), xz = load(m[4]), yz = load(m[5]);
  return {multiply_add(load(m[0]), v.x, multiply_add(xy, v.y, xz * v.z)),
          multiply_add(xy, v.x, multiply_add(load(m[1]), v.y, yz * v.z)),
          multiply_add(xz, v.x, multiply_add(yz, v.y, load(m[2]) * v.z))};
}

/// Four quadruples to four lanes, and back: the same exchange both ways.
inline void transpose(V& a, V& b, V& c, V& d) {
  const V ab0 = __builtin_shuffle(a, b, Mask{0, 4, 2, 6});
  const V ab1 = __builtin_shuffle(a, b, Mask{1, 5, 3, 7});
  const V cd0 = __builtin_shuffle(c, d, Mask{0, 4, 2, 6});
  const V cd1 = __builtin_shuffle(c, d, Mask{1, 5, 3, 7});
  a = __builtin_shuffle(ab0, cd0, Mask{0, 1, 4, 5});
  b = __builtin_shuffle(ab1, cd1, Mask{0, 1, 4, 5});
  c = __builtin_shuffle(ab0, cd0, Mask{2, 3, 6, 7});
  d = __builtin_shuffle(ab1, cd1, Mask{2, 3, 6, 7});
}

inline V* quad(BulkBody* bodies, int i, int which) {
  return reinterpret_cast<V*>(bodies[i].velocity) + which;
}

struct Speeds {
  V3 v, w;
  V inverse_mass, unused;
};

inline void gather(BulkBody* bodies, const int (&index)[4], int which, V3& out, V& fourth) {
  V a = *quad(bodies, index[0], which), b = *quad(bodies, index[1], which),
    c = *quad(bodies, index[2], which), d = *quad(bodies, index[3], which);
  transpose(a, b, c, d);
  out = {a, b, c};
  fourth = d;
}

inline void scatter(BulkBody* bodies, const int (&index)[4], int which, const V3& v, V fourth) {
  V a = v.x, b = v.y, c = v.z, d = fourth;
  transpose(a, b, c, d);
  *quad(bodies, index[0], which) = a;
  *quad(bodies, index[1], which) = b;
  *quad(bodies, index[2], which) = c;
  *quad(bodies, index[3], which) = d;
}

inline Speeds gather_speeds(BulkBody* bodies, const int (&index)[4]) {
  Speeds s;
  gather(bodies, index, 0, s.v, s.inverse_mass);
  gather(bodies, index, 1, s.w, s.unused);
  return s;
}

inline void scatter_speeds(BulkBody* bodies, const int (&index)[4], const Speeds& s) {
  scatter(bodies, index, 0, s.v, s.inverse_mass);
  scatter(bodies, index, 1, s.w, s.unused);
}

inline void push_normal(Speeds& a, Speeds& b, const V3& n, const BulkPoint& p, V impulse) {
  a.v = add_times(a.v, -(a.inverse_mass * impulse), n);
  b.v = add_times(b.v, b.inverse_mass * impulse, n);
  a.w = add_times(a.w, -impulse, load(p.answer_a));
  b.w = add_times(b.w, impulse, load(p.answer_b));
}

inline void push_tangent(Speeds& a, Speeds& b, const BulkRow& row, const V3& n, const V3& f,
                         V twist) {
  a.v = add_times(a.v, -a.inverse_mass, f);
  b.v = add_times(b.v, b.inverse_mass, f);
  const V3 twisted = times(twist, n);
  a.w = difference(a.w, multiply(row.inertia_a, sum(cross(load(row.arm_a), f), twisted)));
  b.w = sum(b.w, multiply(row.inertia_b, sum(cross(load(row.arm_b), f), twisted)));
}

inline V normal_speed(const Speeds& a, const Speeds& b, const V3& n, const BulkPoint& p) {
  return dot(n, difference(b.v, a.v)) + (dot(load(p.arm_b), b.w) - dot(load(p.arm_a), a.w));
}

inline V3 slip_speed(const Speeds& a, const Speeds& b, const BulkRow& row, const V3& n) {
  const V3 u =
      difference(sum(b.v, cross(b.w, load(row.arm_b))), sum(a.v, cross(a.w, load(row.arm_a))));
  return add_times(u, -dot(n, u), n);
}

void warm_start(const BulkBatch& batch) {
  for (int r = 0; r < batch.row_count; ++r) {
    BulkRow& row = batch.rows[r];
    Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
    const V3 n = load(row.normal);
    for (int k = 0; k < row.count; ++k) {
      const BulkPoint& p = batch.points[row.first + k];
      push_normal(a, b, n, p, load(p.impulse));
    }
    push_tangent(a, b, row, n, load(row.slip), load(row.twist));
    scatter_speeds(batch.bodies, row.a, a);
    scatter_speeds(batch.bodies, row.b, b);
  }
}

template <bool pressing>
void sweep(const BulkBatch& batch) {
  const V zero = splat(0), one = splat(1), inverse_h = splat(batch.inverse_h);
  const V push_speed = splat(-batch.push_speed), tiny = splat(1e-300);
  for (int r = 0; r < batch.row_count; ++r) {
    BulkRow& row = batch.rows[r];
    Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
    V3 moved_a, moved_b, turned_a, turned_b;
    V unused;
    gather(batch.bodies, row.a, 2, moved_a, unused);
    gather(batch.bodies, row.b, 2, moved_b, unused);
    gather(batch.bodies, row.a, 3, turned_a, unused);
    gather(batch.bodies, row.b, 3, turned_b, unused);
    const V3 n = load(row.normal);

    if constexpr (!pressing) {
      V bound = zero, twist_bound = zero;
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
      const V3 turned = times(twist - twist_before, n);
      a.w = difference(a.w, multiply(row.inertia_a, turned));
      b.w = sum(b.w, multiply(row.inertia_b, turned));
      const V3 before = load(row.slip);
      V3 after = add_times(before, -load(row.tangent_step), slip_speed(a, b, row, n));
      const V length = square_root(dot(after, after));
      after = times(minimum(one, bound / maximum(length, tiny)), after);
      push_tangent(a, b, row, n, difference(after, before), zero);
      store(row.slip, after);
      store(row.twist, twist);
      store(row.slip_total, sum(load(row.slip_total), after));
      store(row.twist_total, load(row.twist_total) + twist);
    }

    const V drift = dot(n, difference(moved_b, moved_a));
    const V rate = load(row.bias_rate), mass_scale = load(row.mass_scale),
            impulse_scale = load(row.impulse_scale);
    for (int k = 0; k < row.count; ++k) {
      BulkPoint& p = batch.points[row.first + k];
      const V s = load(p.separation) + drift +
                  (dot(load(p.arm_b), turned_b) - dot(load(p.arm_a), turned_a));
      const Mask apart = s > zero;
      const V before = load(p.impulse);
      V bias, scale, leak;
      if constexpr (pressing) {
        bias = apart ? s * inverse_h : maximum(rate * s, push_speed);
        scale = apart ? one : mass_scale;
        leak = apart ? zero : impulse_scale;
      } else {
        bias = apart ? s * inverse_h : zero;
        scale = one;
        leak = zero;
      }
      const V u = normal_speed(a, b, n, p) + bias;
      const V after = maximum(before - load(p.mass) * scale * u - leak * before, zero);
      store(p.impulse, after);
      if constexpr (!pressing) store(p.total, load(p.total) + after);
      push_normal(a, b, n, p, after - before);
    }
    scatter_speeds(batch.bodies, row.a, a);
    scatter_speeds(batch.bodies, row.b, b);
  }
}

double residual(const BulkBatch& batch) {
  const V zero = splat(0), one = splat(1), inverse_h = splat(batch.inverse_h);
  V worst = zero;
  for (int r = 0; r < batch.row_count; ++r) {
    const BulkRow& row = batch.rows[r];
    const Speeds a = gather_speeds(batch.bodies, row.a), b = gather_speeds(batch.bodies, row.b);
    V3 moved_a, moved_b, turned_a, turned_b;
    V unused;
    gather(batch.bodies, row.a, 2, moved_a, unused);
    gather(batch.bodies, row.b, 2, moved_b, unused);
    gather(batch.bodies, row.a, 3, turned_a, unused);
    gather(batch.bodies, row.b, 3, turned_b, unused);
    const V3 n = load(row.normal);
    const V drift = dot(n, difference(moved_b, moved_a));
    V bound = zero;
    for (int k = 0; k < row.count; ++k) {
      const BulkPoint& p = batch.points[row.first + k];
      const V s = load(p.separation) + drift +
                  (dot(load(p.arm_b), turned_b) - dot(load(p.arm_a), turned_a));
      const V u = normal_speed(a, b, n, p) + maximum(s, zero) * inverse_h;
      const V m = load(p.mass), l = load(p.impulse);
      const V change = l - maximum(l - m * u, zero);  // N s; per mass it is a speed
      const V speed = maximum(change, -change) / maximum(m, splat(1e-300));
      worst = maximum(worst, m > zero ? speed : zero);
      bound += l;
    }
    const V step = load(row.tangent_step);
    const V3 f = load(row.slip);
    V3 after = add_times(f, -step, slip_speed(a, b, row, n));
    const V length = square_root(dot(after, after));
    after = times(minimum(one, bound * load(row.friction) / maximum(length, splat(1e-300))), after);
    const V3 d = difference(f, after);
    const V speed = square_root(dot(d, d)) / maximum(step, splat(1e-300));
    worst = maximum(worst, step > zero ? speed : zero);
  }
  double most = 0;
  for (int i = 0; i < 4; ++i) most = worst[i] > most ? worst[i] : most;
  return most;
}

extern const BulkKernels kernels;
const BulkKernels kernels = {warm_start, sweep<true>, sweep<false>, residual};
