// SPDX-License-Identifier: Apache-2.0
// One step of each straight-line scheme, for D = double or a vector of doubles. A lane of a vector
// gives the bits a lone double gives. Templates on D only: a file compiled for one CPU level must
// not define a function that another file could link to.
#pragma once
#include <type_traits>

#include "carom/numerics/sincos.hpp"
#include "carom/step/integrators.hpp"

namespace carom::kernel {

/// Orientation q (principal frame to world), world angular momentum l, inverse moments a.
template <class D>
struct Spin {
  D qx, qy, qz, qw;
  D lx, ly, lz;
  D a1, a2, a3;
};

template <class D>
struct Vec {
  D x, y, z;
};

inline double root(double x) {
  return __builtin_sqrt(x);
}

template <class D>
inline D root(D v) {
  for (unsigned i = 0; i < sizeof(D) / sizeof(double); ++i) v[i] = __builtin_sqrt(v[i]);
  return v;
}

template <class M>
inline bool any(M mask) {
  if constexpr (std::is_same_v<M, bool>) {
    return mask;
  } else {
    auto found = mask[0];
    for (unsigned i = 1; i < sizeof(M) / sizeof(mask[0]); ++i) found |= mask[i];
    return found != 0;
  }
}

template <class D>
inline D absolute(D x) {
  return x < 0.0 ? -x : x;
}

template <class D>
inline D zero() {
  return D{};
}

/// sincos for every finite argument.
template <class D>
inline void sine_cosine(D x, D& s, D& c) {
  if (any(!(absolute(x) <= zero<D>() + sincos_limit))) [[unlikely]] {
    if constexpr (std::is_same_v<D, double>) {
      s = __builtin_sin(x), c = __builtin_cos(x);
    } else {
      D s1, c1;
      sincos(x, s1, c1);
      for (unsigned i = 0; i < sizeof(D) / sizeof(double); ++i) {
        const bool small = __builtin_fabs(x[i]) <= sincos_limit;
        s[i] = small ? s1[i] : __builtin_sin(x[i]);
        c[i] = small ? c1[i] : __builtin_cos(x[i]);
      }
    }
    return;
  }
  sincos(x, s, c);
}

// Components of l along the principal axes: columns of R(q) times l.
template <class D>
inline D along1(const Spin<D>& b) {
  return b.lx * (1.0 - 2.0 * (b.qy * b.qy + b.qz * b.qz)) +
         2.0 * (b.ly * (b.qx * b.qy + b.qw * b.qz) + b.lz * (b.qx * b.qz - b.qw * b.qy));
}
template <class D>
inline D along2(const Spin<D>& b) {
  return b.ly * (1.0 - 2.0 * (b.qx * b.qx + b.qz * b.qz)) +
         2.0 * (b.lx * (b.qx * b.qy - b.qw * b.qz) + b.lz * (b.qy * b.qz + b.qw * b.qx));
}
template <class D>
inline D along3(const Spin<D>& b) {
  return b.lz * (1.0 - 2.0 * (b.qx * b.qx + b.qy * b.qy)) +
         2.0 * (b.lx * (b.qx * b.qz + b.qw * b.qy) + b.ly * (b.qy * b.qz - b.qw * b.qx));
}

/// World angular velocity R diag(a) R^T l = l a1 + ... , by rotating with the quaternion.
template <class D>
inline Vec<D> angular_velocity(const Spin<D>& b) {
  const Vec<D> w{b.a1 * along1(b), b.a2 * along2(b), b.a3 * along3(b)};
  const Vec<D> t{2.0 * (b.qy * w.z - b.qz * w.y), 2.0 * (b.qz * w.x - b.qx * w.z),
                 2.0 * (b.qx * w.y - b.qy * w.x)};
  return {w.x + b.qw * t.x + (b.qy * t.z - b.qz * t.y),
          w.y + b.qw * t.y + (b.qz * t.x - b.qx * t.z),
          w.z + b.qw * t.z + (b.qx * t.y - b.qy * t.x)};
}

/// q = (v, s) q: a rotation about a world axis.
template <class D>
inline void turn_world(Spin<D>& b, const Vec<D>& v, D s) {
  const D x = s * b.qx + v.x * b.qw + (v.y * b.qz - v.z * b.qy);
  const D y = s * b.qy + v.y * b.qw + (v.z * b.qx - v.x * b.qz);
  const D z = s * b.qz + v.z * b.qw + (v.x * b.qy - v.y * b.qx);
  b.qw = s * b.qw - (v.x * b.qx + v.y * b.qy + v.z * b.qz);
  b.qx = x, b.qy = y, b.qz = z;
}

/// q = q (c + s j): a rotation about principal axis 2.
template <class D>
inline void turn_axis2(Spin<D>& b, D s, D c) {
  const D x = c * b.qx - s * b.qz, y = c * b.qy + s * b.qw, z = c * b.qz + s * b.qx;
  b.qw = c * b.qw - s * b.qy;
  b.qx = x, b.qy = y, b.qz = z;
}

/// q = q (c + s1 i + s3 k), where s1 or s3 is zero.
template <class D>
inline void turn_axis1_or_3(Spin<D>& b, D s1, D s3, D c) {
  const D x = c * b.qx + (s1 * b.qw + s3 * b.qy), y = c * b.qy + (s1 * b.qz - s3 * b.qx);
  const D z = c * b.qz + (s3 * b.qw - s1 * b.qy);
  b.qw = c * b.qw - (s1 * b.qx + s3 * b.qz);
  b.qx = x, b.qy = y, b.qz = z;
}

template <class D>
inline D norm_squared(const Spin<D>& b) {
  return (b.qx * b.qx + b.qy * b.qy) + (b.qz * b.qz + b.qw * b.qw);
}
template <class D>
inline void scale(Spin<D>& b, D f) {
  b.qx *= f, b.qy *= f, b.qz *= f, b.qw *= f;
}
/// -0 becomes 0: the one thing that a skipped turn by nothing leaves otherwise.
template <class D>
inline void drop_signs_of_zero(Spin<D>& b) {
  b.qx += 0.0, b.qy += 0.0, b.qz += 0.0, b.qw += 0.0;
}
/// One Newton step of 1/sqrt from 1: enough where only rounding took |q| off 1.
template <class D>
inline void tidy(Spin<D>& b) {
  scale(b, 1.5 - 0.5 * norm_squared(b));
}
template <class D>
inline void normalise(Spin<D>& b) {
  scale(b, 1.0 / root(norm_squared(b)));
}

/// q = exp(phi) q with the full rotation vector phi, rad, halved by the caller: half = phi / 2.
template <class D>
inline void turn_by_half_vector(Spin<D>& b, const Vec<D>& half) {
  const D angle = root((half.x * half.x + half.y * half.y) + half.z * half.z);
  D s, c;
  sine_cosine(angle, s, c);
  // angle 0 (or so small that its square is): s is 0 and so is the vector part
  const D f = s / (angle > 0.0 ? angle : zero<D>() + 1.0);
  turn_world(b, Vec<D>{f * half.x, f * half.y, f * half.z}, c);
}

// ---- the lecture's rows

template <class D>
inline void step_exponential(Spin<D>& b, D h) {
  const Vec<D> w = angular_velocity(b);
  const D f = 0.5 * h;
  turn_by_half_vector(b, Vec<D>{f * w.x, f * w.y, f * w.z});
  tidy(b);
}

template <class D>
inline void step_quaternion(Spin<D>& b, D h) {
  const Vec<D> w = angular_velocity(b);
  const D f = 0.5 * h;
  turn_world(b, Vec<D>{f * w.x, f * w.y, f * w.z}, zero<D>() + 1.0);
  normalise(b);
}

/// The form is real while |h w| <= 2 only; beyond, half a turn about the axis is the nearest it
/// has. Returns where it clamped.
template <class D>
inline auto step_quaternion_sqrt(Spin<D>& b, D h) {
  const Vec<D> w = angular_velocity(b);
  const D f = 0.5 * h;
  const Vec<D> v{f * w.x, f * w.y, f * w.z};
  const D square = (v.x * v.x + v.y * v.y) + v.z * v.z;
  const auto clamped = square > 1.0;
  const D g = clamped ? 1.0 / root(square) : zero<D>() + 1.0;
  const D c = clamped ? zero<D>() : root(clamped ? zero<D>() : 1.0 - square);
  turn_world(b, Vec<D>{g * v.x, g * v.y, g * v.z}, c);
  tidy(b);
  return clamped;
}

// ---- better ones

/// Explicit midpoint on the rotation group.
template <class D>
inline void step_midpoint(Spin<D>& b, D h) {
  Spin<D> middle = b;
  const Vec<D> w0 = angular_velocity(b);
  const D quarter = 0.25 * h, half = 0.5 * h;
  turn_by_half_vector(middle, Vec<D>{quarter * w0.x, quarter * w0.y, quarter * w0.z});
  const Vec<D> w = angular_velocity(middle);
  turn_by_half_vector(b, Vec<D>{half * w.x, half * w.y, half * w.z});
  tidy(b);
}

/// Kinetic energy as |l|^2 as/2 (a symmetric top's world part) + k ld^2/2 (its spin) + d l2^2/2
/// (what is left of asymmetry), l1..l3 along principal axes. The distinct axis is 1 or 3, whichever
/// has the other two inverse moments closest; what is left always turns about axis 2. Each part is
/// a rotation at a constant rate. Inverse moments: descending, or a null axis (0) first, or all 0.
template <class D>
struct TopSplit {
  D as, k1, k3, d;
};
template <class D>
inline TopSplit<D> split_top(const Spin<D>& b) {
  const auto first = absolute(b.a1 - b.a2) > absolute(b.a2 - b.a3);
  TopSplit<D> s;
  s.as = first ? b.a3 : b.a1;
  s.k1 = first ? b.a1 - b.a3 : zero<D>();
  s.k3 = first ? zero<D>() : b.a3 - b.a1;
  s.d = b.a2 - s.as;
  return s;
}

template <class D>
inline void turn_left_over(Spin<D>& b, D quarter_h_d) {
  D s, c;
  sine_cosine(quarter_h_d * along2(b), s, c);
  turn_axis2(b, s, c);
}

/// The symmetric top's own motion over h, exactly: spin about its axis, then precession about l.
template <class D>
inline void turn_symmetric(Spin<D>& b, const TopSplit<D>& t, D h) {
  const D half = 0.5 * h;
  const D angle = half * (t.k1 * along1(b) + t.k3 * along3(b));
  D s, c;
  sine_cosine(angle, s, c);
  const D s1 = t.k1 != 0.0 ? s : zero<D>();
  turn_axis1_or_3(b, s1, s - s1, c);
  const D f = half * t.as;
  turn_by_half_vector(b, Vec<D>{f * b.lx, f * b.ly, f * b.lz});
}

/// Strang splitting: half of the rest, the symmetric top, half of the rest.
template <class D>
inline void step_symmetric_top(Spin<D>& b, const TopSplit<D>& t, D h) {
  if (any(t.d != 0.0)) {
    const D quarter = 0.25 * h * t.d;
    turn_left_over(b, quarter);
    turn_symmetric(b, t, h);
    turn_left_over(b, quarter);
  } else {
    turn_symmetric(b, t, h);  // turns by nothing, in the other branch, give these very bits
  }
  tidy(b);
  drop_signs_of_zero(b);
}

/// Suzuki's composition of five; neighbouring halves of the rest are one turn.
template <class D>
inline void step_symmetric_top_4(Spin<D>& b, const TopSplit<D>& t, D h) {
  constexpr double p = 0.41449077179437573714;  // 1 / (4 - 4^(1/3))
  const D outer = (0.25 * p) * h * t.d, twice = (0.5 * p) * h * t.d;
  const D inner = (0.25 * (1 - 3 * p)) * h * t.d;  // half of p and half of 1 - 4p
  const D hp = p * h, hm = (1 - 4 * p) * h;
  turn_left_over(b, outer);
  turn_symmetric(b, t, hp);
  turn_left_over(b, twice);
  turn_symmetric(b, t, hp);
  turn_left_over(b, inner);
  turn_symmetric(b, t, hm);
  turn_left_over(b, inner);
  turn_symmetric(b, t, hp);
  turn_left_over(b, twice);
  turn_symmetric(b, t, hp);
  turn_left_over(b, outer);
  tidy(b);
}

/// Two terms of tan: the rotation is off by 4/15 x^5, where the plain Cayley form has 2/3 x^3. Any
/// odd function of a conserved rate gives a reversible, symplectic turn.
template <class D>
inline D cayley_tangent(D x) {
  return x + x * (x * x) * (1.0 / 3.0);
}

/// Rotations about axes 1, 2, 3, 2, 1 (Touma and Wisdom; Dullweber, Leimkuhler and McLachlan), each
/// the rational 1 + t e_k instead of a sine and cosine. Momentum in principal axes is turned along.
template <class D>
inline void step_cayley(Spin<D>& b, D h) {
  D l1 = along1(b), l2 = along2(b), l3 = along3(b);
  const D quarter = 0.25 * h;
  // Turning the body by +t about axis k turns the momentum seen from it by -t.
  const auto turn1 = [&](D t) {
    const D f = 2.0 / (1.0 + t * t);
    const D u = t * f * (l3 - t * l2), v = t * f * (l2 + t * l3);
    l2 += u, l3 -= v;
    const D x = b.qx + t * b.qw, y = b.qy + t * b.qz, z = b.qz - t * b.qy;
    b.qw = b.qw - t * b.qx;
    b.qx = x, b.qy = y, b.qz = z;
  };
  const auto turn2 = [&](D t) {
    const D f = 2.0 / (1.0 + t * t);
    const D u = t * f * (l1 - t * l3), v = t * f * (l3 + t * l1);
    l3 += u, l1 -= v;
    const D x = b.qx - t * b.qz, y = b.qy + t * b.qw, z = b.qz + t * b.qx;
    b.qw = b.qw - t * b.qy;
    b.qx = x, b.qy = y, b.qz = z;
  };
  turn1(cayley_tangent(quarter * b.a1 * l1));
  turn2(cayley_tangent(quarter * b.a2 * l2));
  {
    const D t = cayley_tangent(0.5 * h * b.a3 * l3);
    const D f = 2.0 / (1.0 + t * t);
    const D u = t * f * (l2 - t * l1), v = t * f * (l1 + t * l2);
    l1 += u, l2 -= v;
    const D x = b.qx + t * b.qy, y = b.qy - t * b.qx, z = b.qz + t * b.qw;
    b.qw = b.qw - t * b.qz;
    b.qx = x, b.qy = y, b.qz = z;
  }
  turn2(cayley_tangent(quarter * b.a2 * l2));
  {  // the momentum is not needed again
    const D t = cayley_tangent(quarter * b.a1 * l1);
    const D x = b.qx + t * b.qw, y = b.qy + t * b.qz, z = b.qz - t * b.qy;
    b.qw = b.qw - t * b.qx;
    b.qx = x, b.qy = y, b.qz = z;
  }
  normalise(b);
}

}  // namespace carom::kernel
