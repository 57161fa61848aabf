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

/// What stays of a body through the step.
struct alignas(32) BulkFrame {
  double position[3], inverse_mass;
  double inertia[8];  ///< inverse, xx yy zz xy xz yz, two unused
};

/// Changes of velocity, linear and angular, each with an unused fourth.
struct alignas(64) BulkKick {
  double kick[8];   ///< of the forces in one small step
  double push[8];   ///< of the contacts as they pressed last: what they start the next one with
  double start[8];  ///< velocities as the small step began
};

/// One point of four patches.
struct BulkPoint {
  Wide arm_a[3], arm_b[3];        ///< m, r x n
  Wide answer_a[3], answer_b[3];  ///< I^-1 (r x n)
  Wide mass;                      ///< kg, of the point along the normal; 0 in an empty lane
  Wide separation;                ///< m at the start of the step
  Wide impulse;                   ///< N s of the small step, pressing: what moves the bodies
  Wide relaxed;                   ///< N s of the small step, without push: what their speeds keep
  Wide total;                     ///< N s since the step began
  Wide spread;                    ///< m from the patch's centre, in the tangent plane
};

/// Four patches: friction acts once per patch, at its centre, as a force and a twist.
struct BulkRow {
  int a[4], b[4];      ///< slots
  int contact[4];      ///< first of the patch, -1 in an empty lane
  int lane_points[4];  ///< of each patch, at most `count`
  int first, count;    ///< points
  Wide normal[3];
  Wide arm_a[3], arm_b[3];          ///< m, from the centres of mass to the patch's centre
  Wide inertia_a[6], inertia_b[6];  ///< inverse, xx yy zz xy xz yz
  Wide friction;
  Wide against_static;                  ///< 1 or 0
  Wide tangent_step;                    ///< kg, 1 / largest eigenvalue of the tangent mobility
  Wide twist_mass;                      ///< kg m^2; 0 for single points
  Wide turn_a[3], turn_b[3];            ///< what a unit twist does to both: I^-1 n
  Wide slip[3];                         ///< N s of the small step, tangential, pressing
  Wide twist;                           ///< N m s of the small step, about the normal, pressing
  Wide slip_relaxed[3], twist_relaxed;  ///< without push
  Wide slip_total[3], twist_total;
};

/// Four single points whose arms lie along the normal, between bodies that turn alike about all
/// axes: balls. The normal impulse turns nothing and friction turns both about one axis.
struct BulkBall {
  int a[4], b[4];
  int contact[4];  ///< -1 in an empty lane
  Wide normal[3];
  Wide lever_a, lever_b;      ///< m, from the centres along the normal
  Wide inertia_a, inertia_b;  ///< inverse
  Wide friction;
  Wide against_static;
  Wide mass, tangent_step;  ///< kg
  Wide separation, impulse, relaxed, total;
  Wide slip[3], slip_relaxed[3], slip_total[3];
};

/// Rows of one colour: no two of their lanes share a moving body, but in the last colour, which
/// takes what is left over.
struct BulkColour {
  int rows_begin, rows_end, balls_begin, balls_end;
  bool left_over;
};

/// Where contacts keep what the kernel reads and writes, as places within an array of doubles.
struct BulkContacts {
  double* first;
  std::ptrdiff_t stride;
  std::ptrdiff_t normal, position, friction, impulse, impulse_at_end;  ///< a gap follows position
};

/// Of a soft contact: 0 between moving bodies, 1 against a static one.
struct BulkSoftness {
  double bias_rate[2], mass_scale[2], impulse_scale[2];
};

struct BulkBatch {
  BulkBody* bodies;
  const BulkFrame* frames;
  BulkKick* kicks;
  BulkRow* rows;
  BulkPoint* points;
  BulkBall* balls;
  const BulkColour* colours;
  int colour_count, row_count, ball_count, moving;
  BulkSoftness soft;
  double substeps;
  double h, inverse_h;  ///< s, 1/s
  double push_speed;    ///< m/s, most an overlap may add
  double one_place;     ///< points nearer than this, over their lever, are one
};

/// The index-th of `count` nearly equal shares.
struct BulkPart {
  int index = 0, count = 1;
};

/// Each does its share of the bodies, of the rows, or of the rows of one colour: threads may work
/// on one of these at a time, and it makes no difference which does what.
struct BulkKernels {
  void (*prepare)(const BulkBatch&, const BulkContacts&, BulkPart);
  void (*warm_start)(const BulkBatch&, const BulkColour&, BulkPart);  ///< the contacts' first push
  void (*begin)(const BulkBatch&, BulkPart);  ///< forces, and the push of the small step before
  void (*press)(const BulkBatch&, const BulkColour&, BulkPart);  ///< friction, then soft normals
  void (*move)(const BulkBatch&, double h,
               BulkPart);  ///< by the speeds as pressed: it remembers them
  void (*relax)(const BulkBatch&, const BulkColour&, BulkPart);  ///< friction, normals without push
  double (*residual)(const BulkBatch&, BulkPart);  ///< m/s, natural map of Coulomb's law
  void (*write)(const BulkBatch&, const BulkContacts&, BulkPart);  ///< impulses to the contacts
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
