// SPDX-License-Identifier: Apache-2.0
// The soft small-step solver's data: plain numbers in lanes of four contacts that share no body, so
// that one kernel source serves every CPU level. No Eigen type crosses this border.
#pragma once
#include <cstddef>

namespace carom::contact {

struct alignas(32) Wide {
  double lane[4];
};

/// What the kernel moves: one cache line of velocities, one of displacements since the step began.
struct alignas(128) BulkBody {
  double velocity[3], inverse_mass;
  double angular_velocity[3], unused_0;
  double displacement[3], unused_1;
  double turn[3], unused_2;
};

/// One point of four patches.
struct BulkPoint {
  Wide arm_a[3], arm_b[3];        ///< m, r x n
  Wide answer_a[3], answer_b[3];  ///< I^-1 (r x n)
  Wide mass;                      ///< kg, of the point along the normal; 0 in an empty lane
  Wide separation;                ///< m at the start of the step
  Wide impulse;                   ///< N s of the substep under way
  Wide total;                     ///< N s since the step began
  Wide spread;                    ///< m from the patch's centre, in the tangent plane
};

/// Four patches: friction acts once per patch, at its centre, as a force and a twist.
struct BulkRow {
  int a[4], b[4];
  int first, count;  ///< points
  Wide normal[3];
  Wide arm_a[3], arm_b[3];          ///< m, from the centres of mass to the patch's centre
  Wide inertia_a[6], inertia_b[6];  ///< inverse, xx yy zz xy xz yz
  Wide friction;
  Wide tangent_step;  ///< kg, 1 / largest eigenvalue of the tangent mobility
  Wide twist_mass;    ///< kg m^2; 0 for single points
  Wide slip[3];       ///< N s of the substep, tangential
  Wide twist;         ///< N m s of the substep, about the normal
  Wide slip_total[3], twist_total;
  Wide bias_rate, mass_scale, impulse_scale;  ///< of the soft contact
};

struct BulkBatch {
  BulkBody* bodies;
  BulkRow* rows;
  BulkPoint* points;
  int row_count;
  double inverse_h;   ///< 1/s
  double push_speed;  ///< m/s, most an overlap may add
};

struct BulkKernels {
  void (*warm_start)(const BulkBatch&);
  void (*press)(const BulkBatch&);       ///< soft normals
  void (*relax)(const BulkBatch&);       ///< friction, then normals without push
  double (*residual)(const BulkBatch&);  ///< m/s, natural map of Coulomb's law
};

/// The widest kernels this CPU runs.
[[nodiscard]] const BulkKernels& bulk_kernels();

namespace portable {
extern const BulkKernels kernels;
}
namespace avx2 {
extern const BulkKernels kernels;
}

}  // namespace carom::contact
