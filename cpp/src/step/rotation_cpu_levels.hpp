// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "carom/step/rotation.hpp"

namespace carom::kernel {

// Each returns false for a method that does not run in lanes.
bool advance_rotation_portable(Integrator method, const RotationArrays& arrays, const int* rows,
                               int count, double dt, RotationReport& report);
bool advance_rotation_avx2(Integrator method, const RotationArrays& arrays, const int* rows,
                           int count, double dt, RotationReport& report);

}  // namespace carom::kernel
