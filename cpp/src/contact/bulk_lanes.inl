// SPDX-License-Identifier: Apache-2.0
// Four doubles as one value. Included by the kernel source, once per CPU level, into a namespace of
// its own. GCC's vector types carry it: four doubles are one AVX register, or two of SSE2 or NEON.

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

inline V inverse_or_zero(V x) {
  const Mask some = x > splat(0);
  return some ? splat(1) / (some ? x : splat(1)) : splat(0);
}
inline V magnitude(const V3& v) {
  return square_root(dot(v, v));
}
/// Vectors shorter than what overflows an inverse count as none.
constexpr double tiny = 1e-300;

inline V3 multiply(const V (&m)[6], const V3& v) {
  return {multiply_add(m[0], v.x, multiply_add(m[3], v.y, m[4] * v.z)),
          multiply_add(m[3], v.x, multiply_add(m[1], v.y, m[5] * v.z)),
          multiply_add(m[4], v.x, multiply_add(m[5], v.y, m[2] * v.z))};
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

inline void scatter(BulkBody* const (&to)[4], int which, const V3& v, V fourth) {
  V a = v.x, b = v.y, c = v.z, d = fourth;
  transpose(a, b, c, d);
  *quad(to[0], 0, which) = a;
  *quad(to[1], 0, which) = b;
  *quad(to[2], 0, which) = c;
  *quad(to[3], 0, which) = d;
}

inline Speeds gather_speeds(BulkBody* bodies, const int (&index)[4]) {
  Speeds s;
  gather(bodies, index, 0, s.v, s.inverse_mass);
  gather(bodies, index, 1, s.w, s.unused);
  return s;
}

/// What stands still is not written: all rows on the ground share it, on all threads.
inline void scatter_speeds(const BulkBatch& batch, const int (&index)[4], const Speeds& s) {
  BulkBody still;
  BulkBody* to[4];
  for (int l = 0; l < 4; ++l) to[l] = index[l] < batch.moving ? batch.bodies + index[l] : &still;
  scatter(to, 0, s.v, s.inverse_mass);
  scatter(to, 1, s.w, s.unused);
}

/// 1 in lanes that have a k-th point.
inline V at_lane(const int (&count)[4], int k) {
  return V{k < count[0] ? 1.0 : 0.0, k < count[1] ? 1.0 : 0.0, k < count[2] ? 1.0 : 0.0,
           k < count[3] ? 1.0 : 0.0};
}
