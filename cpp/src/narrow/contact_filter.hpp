// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

namespace carom::narrow {

enum Verdict : std::uint8_t { verdict_miss, verdict_hit, verdict_undecided };

/// Decides most queries in doubles, with a proven bound on every rounding: a miss or a hit is
/// certain, undecided goes to exact_contact(). `queries`: count x 24 finite doubles. Queries whose
/// differences leave [2^-300, 2^300] come back undecided.
using ContactFilter = void (*)(const double* queries, std::size_t count, std::uint8_t* verdict,
                               double* time);

namespace portable {
void filter_point_triangle(const double*, std::size_t, std::uint8_t*, double*);
void filter_edge_edge(const double*, std::size_t, std::uint8_t*, double*);
}  // namespace portable

namespace avx2 {
void filter_point_triangle(const double*, std::size_t, std::uint8_t*, double*);
void filter_edge_edge(const double*, std::size_t, std::uint8_t*, double*);
}  // namespace avx2

}  // namespace carom::narrow
