// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "contact/bulk.hpp"

namespace carom::contact {
namespace portable {
namespace {
using Four = double __attribute__((vector_size(32)));
inline Four multiply_add(Four a, Four b, Four c) {
  return a * b + c;
}
inline Four square_root(Four a) {
  return Four{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
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
}  // namespace portable

const BulkKernels& bulk_kernels() {
#if defined(__x86_64__)
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (wide) return avx2::kernels;
#endif
  return portable::kernels;
}

}  // namespace carom::contact
