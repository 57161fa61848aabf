// SPDX-License-Identifier: Apache-2.0
#if defined(__AVX2__)
#include <immintrin.h>

#include "broad/box_blocks.hpp"

namespace carom::broad::avx2 {
#include "broad/box_blocks.inl"
}
#endif
