// SPDX-License-Identifier: Apache-2.0
#include "broad/wide_tree.hpp"

#include <type_traits>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed only within this file

namespace carom::broad {
namespace portable {
#include "broad/sah_build.inl"
#include "broad/wide_tree.inl"
}  // namespace portable

const WideKernels& wide_kernels() {
#if defined(__x86_64__) && !defined(CAROM_PORTABLE_KERNELS)
  static const bool fast = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (fast) return avx2::wide_kernels;
#endif
  return portable::wide_kernels;
}

}  // namespace carom::broad
