// SPDX-License-Identifier: Apache-2.0
#if defined(__AVX2__)
#include <immintrin.h>
#include <type_traits>

#include "broad/wide_tree.hpp"

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed only within this file

namespace carom::broad {
namespace avx2 {
#include "broad/sah_build.inl"
#include "broad/wide_tree.inl"
}  // namespace avx2
}  // namespace carom::broad
#endif
