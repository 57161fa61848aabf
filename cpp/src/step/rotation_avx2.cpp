// SPDX-License-Identifier: Apache-2.0
#ifdef __AVX2__
#include <immintrin.h>

#include "step/rotation_cpu_levels.hpp"
#include "step/rotation_lanes.hpp"

namespace carom::kernel {

using Lanes4 = double __attribute__((vector_size(32)));  // used in this file alone

template <>
inline Lanes4 root<Lanes4>(Lanes4 v) {
  return _mm256_sqrt_pd(v);
}
using Mask4 = long long __attribute__((vector_size(32)));
template <>
inline bool any<Mask4>(Mask4 mask) {
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
}

bool advance_rotation_avx2(Integrator method, const RotationArrays& arrays, const int* rows,
                           int count, double dt, RotationReport& report) {
  return advance_in_lanes<Lanes4>(method, arrays, rows, count, dt, report);
}

}  // namespace carom::kernel
#endif
