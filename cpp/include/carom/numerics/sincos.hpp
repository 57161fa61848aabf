// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

namespace carom {

/// Sine and cosine in one go, of a double or of a GCC vector of doubles; every lane gives the bits
/// that a lone double gives, at any CPU level: only single IEEE operations, no fused ones.
///
/// Absolute error below 2 u = 2.2e-16 for |x| <= sincos_limit: the quadrant is exact, the reduced
/// argument is off by at most u |r| + k u^2 (two of three parts of pi/2 have 33 bits, so k times
/// them is exact), and the polynomials, fdlibm's, add less than one ulp. The caller keeps |x| below
/// sincos_limit; see sincos_any.
/// Source: W. J. Cody and W. Waite, Software Manual for the Elementary Functions, 1980; polynomials
/// of fdlibm's k_sin.c and k_cos.c.
inline constexpr double sincos_limit = 1647099.0;  // 2^20 pi/2: k has 20 bits, 20 + 33 = 53

namespace detail {

template <class D>
struct BitsOf {
  using type = decltype(D{} < D{});  // for a vector of doubles: of integers as wide
};
template <>
struct BitsOf<double> {
  using type = std::int64_t;
};

template <class D>
inline typename BitsOf<D>::type bits(D x) {
  return std::bit_cast<typename BitsOf<D>::type>(x);
}

/// The low bits of x + round_magic hold the nearest integer to x, for |x| < 2^51.
inline constexpr double round_magic = 6755399441055744.0;  // 1.5 * 2^52

}  // namespace detail

template <class D>
inline void sincos(const D x, D& sine, D& cosine) {
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
  constexpr double part1 = 0x1.921fb544p+0, part2 = 0x1.0b4611a6p-34, part3 = 0x1.3198a2e037073p-69;

  const D shifted = x * two_over_pi + detail::round_magic;
  const D k = shifted - detail::round_magic;
  const auto quadrant = detail::bits(shifted);
  const D r = ((x - k * part1) - k * part2) - k * part3;

  const D z = r * r;
  const D s =
      r + r * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 +
                                                                z * 1.58969099521155010221e-10)))));
  const D tail =
      z * (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  // 1 - z/2 loses bits; what it lost, exactly, goes back in.
  const D half = 0.5 * z;
  const D head = 1.0 - half;
  const D c = head + (((1.0 - head) - half) + z * tail);

  const auto odd = (quadrant & 1) != 0;
  const auto sine_sign = (quadrant & 2) != 0;
  const auto cosine_sign = ((quadrant + 1) & 2) != 0;
  const D s1 = odd ? c : s;
  const D c1 = odd ? s : c;
  sine = sine_sign ? -s1 : s1;
  cosine = cosine_sign ? -c1 : c1;
}

/// The same for any finite double; beyond sincos_limit the C library reduces the argument.
inline void sincos_any(double x, double& sine, double& cosine) {
  if (std::abs(x) <= sincos_limit) [[likely]] {
    sincos(x, sine, cosine);
  } else {
    sine = std::sin(x), cosine = std::cos(x);
  }
}

}  // namespace carom
