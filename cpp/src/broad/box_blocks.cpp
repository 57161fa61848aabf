// SPDX-License-Identifier: Apache-2.0
#include "broad/box_blocks.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace carom::broad {
namespace portable {
#include "broad/box_blocks.inl"
}

const BlockKernels& block_kernels() {
#if defined(__x86_64__) && !defined(CAROM_PORTABLE_KERNELS)
  static const bool fast = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (fast) return avx2::block_kernels;
#endif
  return portable::block_kernels;
}

}  // namespace carom::broad
