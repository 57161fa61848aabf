// SPDX-License-Identifier: Apache-2.0
#include "step/rotation_cpu_levels.hpp"
#include "step/rotation_lanes.hpp"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace carom::kernel {

using Lanes2 = double __attribute__((vector_size(16)));  // SSE2 and NEON registers alike

#ifdef __SSE2__
template <>
inline Lanes2 root<Lanes2>(Lanes2 v) {
  return _mm_sqrt_pd(v);
}
using Mask2 = long long __attribute__((vector_size(16)));
template <>
inline bool any<Mask2>(Mask2 mask) {
  return _mm_movemask_pd(reinterpret_cast<__m128d>(mask)) != 0;
}
#endif

bool advance_rotation_portable(Integrator method, const RotationArrays& arrays, const int* rows,
                               int count, double dt, RotationReport& report) {
  return advance_in_lanes<Lanes2>(method, arrays, rows, count, dt, report);
}

}  // namespace carom::kernel
