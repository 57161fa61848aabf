// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace carom {

/// Ways to advance the orientation of a body while its world angular momentum L is constant.
/// Torque acts between two such drifts, as kicks of L. Lecture rows are there to be compared.
enum class Integrator : std::uint8_t {
  lecture_gram_schmidt,     ///< R += h w* R, then Gram-Schmidt: order 1, favours the first axis
  lecture_polar,            ///< R += h w* R, then the nearest rotation: order 1, no bias
  lecture_exponential,      ///< q = exp(h w) q: order 1; every lecture row drifts in energy
  lecture_quaternion,       ///< q += h/2 w q, normalised: order 1, angle atan(h w / 2)
  lecture_quaternion_sqrt,  ///< (sqrt(1 - |h w/2|^2), h w/2) q: order 1, clamped above |h w| = 2
  midpoint,                 ///< w taken at half a step: order 2, explicit, energy drifts
  implicit_midpoint,        ///< the same w at the true midpoint: order 2, reversible, iterates
  cayley,                   ///< splitting into three rational rotations: order 2, cheapest good row
  symmetric_top,            ///< the default: splitting round the nearest symmetric top: order 2,
                            ///< reversible, exact for symmetric bodies
  symmetric_top_4,          ///< five of them (Suzuki): order 4
  taylor,                   ///< Taylor series of order 16, chooses its own steps, tells its error
  exact,                    ///< Jacobi elliptic functions: any time jump at one price
};

/// Names as users type them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 12> METHODS = {"lecture_gram_schmidt",
                                                             "lecture_polar",
                                                             "lecture_exponential",
                                                             "lecture_quaternion",
                                                             "lecture_quaternion_sqrt",
                                                             "midpoint",
                                                             "implicit_midpoint",
                                                             "cayley",
                                                             "symmetric_top",
                                                             "symmetric_top_4",
                                                             "taylor",
                                                             "exact"};

/// @throws InvalidInput listing METHODS when there is no such name
[[nodiscard]] Integrator integrator_named(std::string_view name);
[[nodiscard]] constexpr std::string_view name_of(Integrator method) {
  return METHODS[static_cast<std::size_t>(method)];
}
/// Order of convergence in the step, 0 where the method has none: it controls its own error.
[[nodiscard]] int order_of(Integrator method);

}  // namespace carom
