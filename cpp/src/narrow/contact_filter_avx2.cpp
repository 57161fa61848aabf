// SPDX-License-Identifier: Apache-2.0
#if defined(__AVX2__)
#define CAROM_TARGET avx2
#include "contact_filter_lanes.hpp"
#endif
