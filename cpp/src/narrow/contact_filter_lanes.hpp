// SPDX-License-Identifier: Apache-2.0
// Included once per CPU level, with CAROM_TARGET naming it: four queries per register on the whole
// step [0, 1], then one at a time on what is left. Only doubles and built-ins here: nothing from
// the standard library may be instantiated under a wider instruction set.
//
// The polygon V_i(t), f and c_i are those of exact_contact.cpp, in Bernstein form on a cell [s, e]:
//   f   definite                                      -> no contact in the cell
//   c_i of both signs, on one axis, all over the cell -> no contact in the cell
//   f changes sign and on one axis all c_i have one sign all over the cell -> contact in the cell
//
// Rounding. u = 2^-53; v bounds |V_i|, w bounds |edge_i| by component (computed, hence within a
// factor 1 + u); second-order terms go into the rounded-up constants. A corner, or an edge (from
// the input, not from corners), is one rounded subtraction.
//   c_i = V_i x edge_i: |c| <= 2vw; ends 4 roundings deep, the middle one 5: error <= 10u vw.
//     On a subcell: two nested x + t (y - x), each 5u (2vw):       error <= 30u vw.
//   f = V_0 . (edge_0 x edge_1): normal 5 deep, |.| <= 2w^2; dot product, sum and third 7 deeper;
//     |f| <= 6 v w^2: error <= 72u v w^2. Each halving of the cell nests 3 averages: + 18u v w^2.
//     At one point: 3 nested interpolations of 5u (6 v w^2) each:  + 90u v w^2.
// Underflow: with v, w >= 2^-300 the bounds exceed 2^-953; an underflow adds below 2^-1050.
#include "contact_filter.hpp"

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors only pass between static functions

namespace carom::narrow::CAROM_TARGET {
namespace {

using Lane4 = double __attribute__((vector_size(32)));
using Mask4 = decltype(Lane4{} < Lane4{});
using Index4 = long long __attribute__((vector_size(32)));

constexpr double u = 0x1p-53;
constexpr double cross_error = 12 * u, cross_cell_error = 36 * u;
constexpr double cubic_error = 76 * u, cubic_level_error = 19 * u, cubic_point_error = 96 * u;
constexpr double smallest = 0x1p-300, largest = 0x1p300;
constexpr int max_depth = 10, max_cells = 40;
// Half-width of the bracket around a root, in time: as small as the error of f allows, and never so
// wide that the time returned is off by 1e-9 of the step (2 * 2^-32 = 4.7e-10).
constexpr double narrow_bracket = 0x1p-42, wide_bracket = 0x1p-32;

inline Lane4 absolute(Lane4 x) {
  return (Lane4)((Index4)x & (Index4{} + 0x7fffffffffffffffLL));
}
inline Lane4 larger(Lane4 a, Lane4 b) {
  return a > b ? a : b;
}
inline Lane4 smaller(Lane4 a, Lane4 b) {
  return a < b ? a : b;
}
inline double magnitude(double x) {
  return __builtin_fabs(x);
}

inline int bits(Mask4 m) {
#if defined(__AVX2__)
  return __builtin_ia32_movmskpd256((Lane4)m);
#else
  return static_cast<int>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}

inline Lane4 load(const double* p) {
  Lane4 r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}

inline void load_transposed(const double* const q[4], Lane4 x[24]) {
  for (int b = 0; b < 24; b += 4) {
    const Lane4 r0 = load(q[0] + b), r1 = load(q[1] + b), r2 = load(q[2] + b), r3 = load(q[3] + b);
    const Index4 even{0, 4, 2, 6}, odd{1, 5, 3, 7}, low{0, 1, 4, 5}, high{2, 3, 6, 7};
    const Lane4 e01 = __builtin_shuffle(r0, r1, even), o01 = __builtin_shuffle(r0, r1, odd);
    const Lane4 e23 = __builtin_shuffle(r2, r3, even), o23 = __builtin_shuffle(r2, r3, odd);
    x[b] = __builtin_shuffle(e01, e23, low);
    x[b + 1] = __builtin_shuffle(o01, o23, low);
    x[b + 2] = __builtin_shuffle(e01, e23, high);
    x[b + 3] = __builtin_shuffle(o01, o23, high);
  }
}

inline void cross(const Lane4 a[3], const Lane4 b[3], Lane4 out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

// Bernstein coefficients of a(t) x b(t), both linear
inline void cross_quadratic(const Lane4 a[2][3], const Lane4 b[2][3], Lane4 out[3][3]) {
  Lane4 p[3], q[3];
  cross(a[0], b[0], out[0]);
  cross(a[1], b[1], out[2]);
  cross(a[0], b[1], p);
  cross(a[1], b[0], q);
  for (int k = 0; k < 3; ++k) out[1][k] = (p[k] + q[k]) * 0.5;
}

inline Lane4 dot(const Lane4 a[3], const Lane4 b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <int Corners>
struct Block {
  Lane4 f[4];
  Lane4 c[Corners * 3][3];  // [corner, axis][Bernstein index]
  Lane4 f_unit, c_unit;     // v w^2, v w
};

template <int Corners>
inline void differences(const Lane4 x[24], Lane4 corner[Corners][2][3], Lane4 edge[Corners][2][3]) {
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < 3; ++k) {
      const Lane4* p = x + 12 * end + k;
      const Lane4 p0 = p[0], p1 = p[3], p2 = p[6], p3 = p[9];
      if constexpr (Corners == 3) {
        corner[0][end][k] = p1 - p0;
        corner[1][end][k] = p2 - p0;
        corner[2][end][k] = p3 - p0;
        edge[0][end][k] = p2 - p1;
        edge[1][end][k] = p3 - p2;
        edge[2][end][k] = p1 - p3;
      } else {
        corner[0][end][k] = p0 - p2;
        corner[1][end][k] = p1 - p2;
        corner[2][end][k] = p1 - p3;
        corner[3][end][k] = p0 - p3;
        edge[0][end][k] = p1 - p0;
        edge[1][end][k] = p2 - p3;
        edge[2][end][k] = p0 - p1;
        edge[3][end][k] = p3 - p2;
      }
    }
}

// Four queries on the whole step. Returns the lanes that miss; `out_of_range` lanes are undecided.
template <int Corners>
inline int screen(const Lane4 x[24], Block<Corners>& block, int& out_of_range) {
  Lane4 corner[Corners][2][3], edge[Corners][2][3];
  differences<Corners>(x, corner, edge);
  Mask4 miss = Lane4{} > Lane4{};
  Lane4 v{}, w{};
  for (int k = 0; k < 3; ++k) {
    Lane4 low = corner[0][0][k], high = low;
    for (int i = 0; i < Corners; ++i)
      for (int end = 0; end < 2; ++end) {
        low = smaller(low, corner[i][end][k]);
        high = larger(high, corner[i][end][k]);
        // the opposite edges of a parallelogram are negatives of each other
        if (i < 3 - (Corners - 3)) w = larger(w, absolute(edge[i][end][k]));
      }
    miss |= (low > 0.0) | (high < 0.0);  // a difference of doubles has its exact sign
    v = larger(v, larger(absolute(low), absolute(high)));
  }
  out_of_range = ~bits((v >= smallest) & (v <= largest) & (w >= smallest) & (w <= largest)) & 15;
  if (bits(miss) == 15) return 15;

  const Lane4 third = Lane4{} + 1.0 / 3;
  Lane4 normal[3][3];
  cross_quadratic(edge[0], edge[1], normal);
  const auto& a = corner[0];
  Lane4* f = block.f;
  f[0] = dot(a[0], normal[0]);
  f[1] = (dot(a[1], normal[0]) + 2.0 * dot(a[0], normal[1])) * third;
  f[2] = (dot(a[0], normal[2]) + 2.0 * dot(a[1], normal[1])) * third;
  f[3] = dot(a[1], normal[2]);
  block.c_unit = v * w;
  block.f_unit = block.c_unit * w;
  const Lane4 bound = cubic_error * block.f_unit;
  miss |= (smaller(smaller(f[0], f[1]), smaller(f[2], f[3])) > bound) |
          (larger(larger(f[0], f[1]), larger(f[2], f[3])) < -bound);
  if (bits(miss) == 15) return 15;

  const Lane4 c_bound = cross_error * block.c_unit;
  Mask4 positive[3] = {}, negative[3] = {};
  for (int i = 0; i < Corners; ++i) {
    Lane4 q[3][3];
    cross_quadratic(corner[i], edge[i], q);
    for (int k = 0; k < 3; ++k) {
      for (int b = 0; b < 3; ++b) block.c[3 * i + k][b] = q[b][k];
      positive[k] |= smaller(smaller(q[0][k], q[1][k]), q[2][k]) > c_bound;
      negative[k] |= larger(larger(q[0][k], q[1][k]), q[2][k]) < -c_bound;
    }
  }
  for (int k = 0; k < 3; ++k) miss |= positive[k] & negative[k];
  return bits(miss);
}

inline double mix(double x, double y, double t) {
  return x + t * (y - x);
}

enum class Inside { no, yes, unknown };

// The signs of all c_i over the cell [s, e].
template <int Corners>
inline Inside inside(const Block<Corners>& block, int lane, double s, double e) {
  const double bound = cross_cell_error * block.c_unit[lane];
  bool yes = false;
  for (int k = 0; k < 3; ++k) {
    int positive = 0, negative = 0;
    for (int i = 0; i < Corners; ++i) {
      const Lane4* q = block.c[3 * i + k];
      const double q0 = q[0][lane], q1 = q[1][lane], q2 = q[2][lane];
      const double ss0 = mix(q0, q1, s), ss1 = mix(q1, q2, s);
      const double b0 = mix(ss0, ss1, s), b1 = mix(ss0, ss1, e);
      const double b2 = mix(mix(q0, q1, e), mix(q1, q2, e), e);
      positive += (b0 > bound) & (b1 > bound) & (b2 > bound);
      negative += (b0 < -bound) & (b1 < -bound) & (b2 < -bound);
    }
    if (positive > 0 && negative > 0) return Inside::no;
    yes |= positive == Corners || negative == Corners;
  }
  return yes ? Inside::yes : Inside::unknown;
}

struct Cell {
  double b[4];
  double start, width;
  int depth;
};

inline int sign_beyond(double x, double bound) {
  return (x > bound) - (x < -bound);
}

inline double value_at(const double b[4], double t) {
  const double p = mix(b[0], b[1], t), q = mix(b[1], b[2], t), r = mix(b[2], b[3], t);
  return mix(mix(p, q, t), mix(q, r, t), t);
}

// A bracket [low, high] (in time) of the cell's only root, its ends' signs proven: f there has the
// sign of the cell's end, and a second root between is excluded. False when rounding forbids it.
inline bool bracket_root(const Cell& cell, int first_sign, double bound, double& low,
                         double& high) {
  const double* b = cell.b;
  const double a1 = 3 * (b[1] - b[0]), a2 = 3 * (b[0] - 2 * b[1] + b[2]);
  const double a3 = b[3] - b[0] + 3 * (b[1] - b[2]);
  double left = 0, right = 1, x = b[0] / (b[0] - b[3]), slope = 0;
  for (int i = 0; i < 48; ++i) {  // Newton, bisection where it leaves the bracket
    const double value = b[0] + x * (a1 + x * (a2 + x * a3));
    slope = a1 + x * (2 * a2 + x * (3 * a3));
    ((value > 0) == (first_sign > 0) ? left : right) = x;
    double next = x - value / slope;
    if (!(next >= left && next <= right)) next = 0.5 * (left + right);
    const double step = magnitude(next - x);
    x = next;
    if (step < 0x1p-26) break;  // quadratic convergence: the next error is of order 2^-52
  }
  double reach = narrow_bracket;
  const double needed = 4 * bound / magnitude(slope) * cell.width;
  if (needed > reach) reach = needed;
  const double root = cell.start + cell.width * x, end = cell.start + cell.width;
  for (; reach <= wide_bracket; reach *= 16) {
    low = root - reach;
    high = root + reach;
    if (!(low > cell.start)) low = cell.start;
    if (!(high < end)) high = end;
    // exact: start is a multiple of width, a power of two (Sterbenz, or start = 0)
    const double t_low = (low - cell.start) / cell.width;
    const double t_high = (high - cell.start) / cell.width;
    const bool low_proven = t_low == 0 || sign_beyond(value_at(b, t_low), bound) == first_sign;
    const bool high_proven = t_high == 1 || sign_beyond(value_at(b, t_high), bound) == -first_sign;
    if (low_proven && high_proven) return true;
  }
  return false;
}

// One query, cells in order of time, so the first contact found is the first there is.
template <int Corners>
Verdict search(const Block<Corners>& block, int lane, double& time) {
  const double unit = block.f_unit[lane];
  Cell stack[max_depth + 2];
  int size = 1;
  for (int i = 0; i < 4; ++i) stack[0].b[i] = block.f[i][lane];
  stack[0].start = 0;
  stack[0].width = 1;
  stack[0].depth = 0;
  for (int visited = 0; size > 0; ++visited) {
    const Cell cell = stack[--size];
    const double bound = (cubic_error + cubic_level_error * cell.depth) * unit;
    int sign[4];
    for (int i = 0; i < 4; ++i) sign[i] = sign_beyond(cell.b[i], bound);
    if (sign[0] != 0 && sign[0] == sign[1] && sign[0] == sign[2] && sign[0] == sign[3]) continue;
    if (sign[0] * sign[3] < 0 && (sign[1] == sign[0] || sign[2] == sign[3])) {
      // exactly one sign variation whatever the uncertain middle is: one root (Descartes)
      double low, high;
      if (!bracket_root(cell, sign[0], bound + cubic_point_error * unit, low, high))
        return verdict_undecided;
      const Inside in = inside(block, lane, low, high);
      if (in == Inside::unknown) return verdict_undecided;
      if (in == Inside::no) continue;
      time = low;
      return verdict_hit;
    }
    if (visited > 0 || cell.depth > 0) {
      const Inside in = inside(block, lane, cell.start, cell.start + cell.width);
      if (in == Inside::no) continue;
      // inside, and f too near 0 at an end: only exact arithmetic can tell touching from not
      if (in == Inside::yes && (sign[0] == 0 || sign[3] == 0)) return verdict_undecided;
    }
    const bool flat = (sign[0] | sign[1] | sign[2] | sign[3]) == 0;
    if (cell.depth >= (flat ? max_depth / 3 : max_depth) || visited >= max_cells)
      return verdict_undecided;
    Cell &right = stack[size], &left = stack[size + 1];
    size += 2;
    const double m01 = (cell.b[0] + cell.b[1]) * 0.5, m12 = (cell.b[1] + cell.b[2]) * 0.5;
    const double m23 = (cell.b[2] + cell.b[3]) * 0.5;
    const double l = (m01 + m12) * 0.5, r = (m12 + m23) * 0.5, m = (l + r) * 0.5;
    const double half = cell.width * 0.5;
    left = {{cell.b[0], m01, l, m}, cell.start, half, cell.depth + 1};
    right = {{m, r, m23, cell.b[3]}, cell.start + half, half, cell.depth + 1};
  }
  return verdict_miss;
}

template <int Corners>
void filter(const double* queries, std::size_t count, std::uint8_t* verdict, double* time) {
  for (std::size_t first = 0; first < count; first += 4) {
    const int lanes = count - first < 4 ? static_cast<int>(count - first) : 4;
    const double* q[4];
    for (int l = 0; l < 4; ++l) q[l] = queries + 24 * (first + (l < lanes ? l : 0));
    Lane4 x[24];
    load_transposed(q, x);
    Block<Corners> block;
    int out_of_range = 0;
    const int miss = screen<Corners>(x, block, out_of_range);
    for (int l = 0; l < lanes; ++l) {
      time[first + l] = 1;
      // signs of differences, hence that part of `miss`, would survive; v and w do not
      if (out_of_range >> l & 1)
        verdict[first + l] = verdict_undecided;
      else if (miss >> l & 1)
        verdict[first + l] = verdict_miss;
      else
        verdict[first + l] = search(block, l, time[first + l]);
    }
  }
}

}  // namespace

void filter_point_triangle(const double* queries, std::size_t count, std::uint8_t* verdict,
                           double* time) {
  filter<3>(queries, count, verdict, time);
}

void filter_edge_edge(const double* queries, std::size_t count, std::uint8_t* verdict,
                      double* time) {
  filter<4>(queries, count, verdict, time);
}

}  // namespace carom::narrow::CAROM_TARGET
