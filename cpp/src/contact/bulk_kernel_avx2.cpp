// SPDX-License-Identifier: Apache-2.0
#include "contact/bulk.hpp"

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>

namespace carom::contact::avx2 {
namespace {
inline __m256d multiply_add(__m256d a, __m256d b, __m256d c) {
  return _mm256_fmadd_pd(a, b, c);
}
inline __m256d square_root(__m256d a) {
  return _mm256_sqrt_pd(a);
}

// clang-format off: in this order
#include "contact/bulk_lanes.inl"
#include "contact/bulk_kernel.inl"
#include "contact/bulk_balls.inl"
#include "contact/bulk_prepare.inl"
#include "contact/bulk_batch.inl"
// clang-format on
}  // namespace
extern const BulkKernels kernels;
const BulkKernels kernels = all_kernels;
}  // namespace carom::contact::avx2
#endif
