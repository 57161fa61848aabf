// SPDX-License-Identifier: Apache-2.0
// Every literal tolerance of the library, with its unit and where it comes from. Nothing else holds
// one.
#pragma once
#include <cstddef>
#include <limits>

namespace carom::tolerance {

/// Half an ulp of 1: the relative error of one rounded operation, 2^-53.
inline constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

/// A quaternion given from outside may be this far from unit length, relative, and is normalised;
/// more is refused. Choice: single-precision senders carry 6e-8 per component, typed ones three
/// digits.
inline constexpr double quaternion_norm = 1e-3;

// Contact geometry.

/// A triangle whose double area is at most this times its longest edge squared has no normal worth
/// the name: the cross product is off by 4 u longest^2, so its direction would be wrong by more
/// than 4 u / 1e-12 = 4e-4 rad.
inline constexpr double flat_triangle = 1e-12;

/// Sine of the angle up to which two neighbouring mesh faces count as one plane. Single-precision
/// files carry 6e-8 of the coordinate, 1e-5 of an edge 1/200 as long; over a 1 m face a bend of
/// 1e-5 lifts a corner by 10 um.
inline constexpr double flat_bend = 1e-5;

/// Points this far outside a polygon, relative to its size, count as inside: the rounding of a
/// point carried through two frames is 16 u = 2e-15 of its coordinates, which may be 100 polygon
/// sizes.
inline constexpr double inside_polygon = 1e-12;

/// Of two separating axes whose gaps differ by less than this times the size of the shapes, the
/// face is preferred to the edge pair and a's face to b's, so that rounding cannot switch the
/// choice.
inline constexpr double axis_preference = 1e-10;

/// Cosine above which a supporting face counts as facing the contact and gives a patch, not a
/// point: 5 degrees.
inline constexpr double facing = 0.9962;

/// Points of a patch within this fraction of its size of the deepest count as equally deep when
/// points are picked, so that the pick, and with it the warm start, does not follow rounding.
inline constexpr double equally_deep = 1e-6;

/// Rad: directions nearer than this are one; the gap along them differs by less than its rounding.
inline constexpr double same_direction = 4 * unit_roundoff;

/// Sine below which an edge direction counts as perpendicular to a normal: rounding of a product of
/// two unit vectors through two frames is about 16 u; the rest is room for meshes in single
/// precision.
inline constexpr double normal_cone = 1e-7;

/// Where two parallel edges meet, the contact's direction turns from one face's normal to the
/// other's over this share of the size of the bodies: 0.2 mm of a metre, what soft contacts sink.
inline constexpr double edge_on_edge = 1e-4;

/// Sine of the angle below which two edges count as parallel and have no crossing: the direction of
/// their cross product would be off by 4 u / 1e-7 = 4e-9 rad.
inline constexpr double parallel_edges = 1e-7;

/// Points whose normals differ by no more than this angle, rad, share a manifold and its normal:
/// over a patch of 1 m the gap is then off by 1e-10 m.
inline constexpr double same_normal = 1e-10;

/// Support points a simplex search may ask for. Polyhedra end in about ten; curved bodies gain a
/// digit in three and are refined afterwards, which needs four digits.
inline constexpr int gjk_iterations = 64;

/// The search ends when the gap could shrink by no more than this, relative: the refinement squares
/// it for curved bodies, and polyhedra end exactly, on a known corner.
inline constexpr double gjk_gain = 1e-13;

/// Cores nearer than this times their size overlap as far as a direction between them can be told:
/// u / 1e-13 = 1e-3 rad is left of it.
inline constexpr double touching_core = 1e-13;

/// Faces an expanding polytope may add. A curved face halves in three points and its error is the
/// square of its width: 128 points reach 1e-10 of the size.
inline constexpr int expand_iterations = 128;

/// The expansion ends when a face could move out by no more than this times the size of the bodies.
inline constexpr double expand_gain = 1e-12;

/// Directions within this angle, rad, of a crease of a support function are tried on it: ten times
/// the direction error of a search that ended 1e-6 from the surface, sqrt(2e-6).
inline constexpr double crease = 0.02;

/// Steps of Newton's method for a direction: four double the digits of 1e-2 to 1e-16.
inline constexpr int newton_iterations = 12;

/// Steps of Newton's method for the point of an ellipsoid next to another: 1.5^90 leads out of u.
inline constexpr int ellipsoid_iterations = 100;

/// Points nearer to a face of their hull than this times its size are not made corners: twenty
/// times the rounding of a plane through three of them when they are 1e-4 of the size apart.
inline constexpr double hull_plane = 1e-10;

/// Samples a distance grid may hold: 800 MB. Choice.
inline constexpr double sdf_samples = 1e8;

/// Rad: points over a distance grid whose normals agree this well share a manifold. Choice: 5
/// degrees, the angle of `facing`.
inline constexpr double similar_normal = 0.0872;

/// Places where a grid lies on another body that are searched for one by one, nearest first. A body
/// stands on three; what bends more often is held by the vertices next to it as well. Choice.
inline constexpr int sdf_supports = 8;

/// Length of an interpolated distance gradient (1 on the true one) below which its direction is not
/// trusted: the mean of two gradients more than 120 degrees apart is shorter than this.
inline constexpr double sdf_gradient = 0.5;

/// Projections to and fro between a body and a distance grid, and the movement, in cells, at which
/// they end. From one cell out they close by half a step at curvatures up to one cell.
inline constexpr int projections = 60;
inline constexpr double sdf_settled = 1e-9;

/// A step that led uphill is taken again at this share; one that met no curve is followed by one so
/// many times as long. Choice.
inline constexpr double stride_back = 0.25;
inline constexpr double stride_on = 4;

/// Doublings of the distance that a field claims within which its level is looked for: at a crease
/// of a cubic field it is off by less than twice.
inline constexpr int level_doublings = 4;

/// Cosine by which a gradient inside a body must oppose the motion to be taken without asking where
/// the path came in: 60 degrees. At a corner of faces it is about 0, and the samples around reach
/// over the ridge and tilt it; where a flat wall is met at a slant, the other answer is the same.
inline constexpr double opposing = 0.5;

/// Sweeps over the pushes of a step, and the change, relative to the largest speed asked for, at
/// which they end. Four corners of a box on a plane close by half a sweep, so 1e-9 takes about 30;
/// a pile takes more than anyone waits for, and the next step goes on.
inline constexpr int repulsion_sweeps = 64;
inline constexpr double repulsion_settled = 1e-9;

/// Casts end this near the surface, m (rays: times the size of the shape), and after so many steps.
/// A grazing cast that ends by the cap reports a hit: short of the surface, never beyond it.
inline constexpr double cast_gap = 1e-10;
inline constexpr int cast_steps = 64;

/// Pairs of edges up to which separating axes are tried one by one: at 5 ns each they cost what the
/// search by support points does, 10 us.
inline constexpr std::size_t edge_pairs = 2048;

/// A principal moment at or below this share of the largest counts as zero: nothing resists about
/// that axis. Eigenvalues of a 3x3 tensor are off by a few u of the largest; 64 u leaves room for
/// the sums that made the tensor, and a rod as thin as 1e-7 of its length still has a moment above
/// it.
inline constexpr double inertia_rank = 64 * unit_roundoff;

/// Principal moments this close, relative, have no gyroscopic term: it would turn the body by less
/// than rounding does in one step, since |omega x I omega| <= this |omega| |L|.
inline constexpr double equal_moments = 16 * unit_roundoff;

/// Shapes nearer than this get contact points before they touch, m. Choice: the fall of one step at
/// 60 Hz, g dt^2, is 3 mm; seven times that keeps resting patches alive through a wobble.
inline constexpr double contact_margin = 0.02;

/// Motion of a pair against itself, over the smaller body's radius and in rad, up to which its
/// manifold is carried along instead of found again. Choice: at 2e-3 a point's lever is off by 0.2
/// % at most while its gap stays exact to second order, 2e-6 of the radius.
inline constexpr double recycle_motion = 2e-3;

/// Overlap a soft contact may have at rest before its island goes to a better solver, m. Its sink
/// is force / (mass (2 pi f)^2) in closed form, so this is the rule, not a guess; 0.4 mm leaves a
/// fifth of the 0.5 mm that piles are held to.
inline constexpr double soft_sink = 4e-4;

/// Speed at which overlaps are pushed apart at most, m/s. Choice: the fall of 0.46 m; a body
/// spawned inside another leaves at a walking pace instead of flying off.
inline constexpr double push_speed = 3.0;

/// Points of a patch nearer to the centre of its loads than this, over their distance from the
/// body's centre, lie in it and bear no twist: places are known to u of coordinates that may be 1e6
/// times that distance, and a twist over less is beyond any use.
inline constexpr double one_place = 1e-9;

/// Share of an overlap that one step of the direct solver takes out. Choice: 0.2 halves it in three
/// steps, and five points of one face that are all pushed as if alone still do not overshoot.
inline constexpr double push_share = 0.2;

/// Overlaps below this are left alone by the direct solver, m: no eye sees them and no force comes
/// of them, and a push that acts on rounding would keep a pile from being still.
inline constexpr double push_from = 1e-7;

/// Stiffness of the direct solver's proximal term over the mobility of a point. One outer iteration
/// divides the error by it: 1e4 takes gravity's 0.16 m/s of a 60 Hz step to 1e-5 in one and to 1e-9
/// in two. Sliding contacts make the inner problem curved, where 1e2 saves Newton steps (measured).
/// Beyond 1e8 the factor loses what is left of 16 digits after the mass ratio.
inline constexpr double direct_stiffness_sticking = 1e4;
inline constexpr double direct_stiffness_sliding = 1e2;
inline constexpr double direct_stiffness_most = 1e8;

/// Residual the direct solver settles for once it falls by less than a third per round, m/s: 0.2 um
/// in a 60 Hz step. Sliding patches get there; sticking ones reach their tolerance first.
inline constexpr double direct_residual_slow = 1e-5;

/// A contact that starts within this share of its friction bound is taken as sliding.
inline constexpr double direct_slides = 1 - 1e-9;

/// Residual of the push that undoes overlaps, m/s: a correction of positions, whose error costs no
/// energy and is corrected again in the next step.
inline constexpr double push_residual = 1e-5;

/// Residual of a single hit over its approach speed. Rounding of the solve is the stiffness of 1e4
/// times u times a few operations, 1e-12; ten times that is always reached, and a thousand hits of
/// an elastic ball still keep eight digits of its energy.
inline constexpr double hit_residual = 1e-11;

/// Speeds whose squares would leave the range of a double, m/s or kg m^2/s: the state is lost.
inline constexpr double lost_state = 1e150;

/// What bounding spheres and oriented boxes are widened by, relative to the coordinates met: their
/// tests are at most about 60 rounded operations, 2^-47 in all; eight times that. Errs towards
/// looking closer.
inline constexpr double volume_guard = 512 * unit_roundoff;

/// And absolutely, m: squares of lengths below 1.5e-154 leave the range of normal doubles.
inline constexpr double volume_tiny = 1e-150;

/// Relative widening of the parameters t = (bound - start) / step at which a segment crosses the
/// planes of a box: three rounded operations each (two differences, of which one is the step, and a
/// quotient) are at most 3.1 u; eight also covers its own application. Errs towards naming the box.
inline constexpr double slab_widening = 8 * unit_roundoff;

/// Moments this close, relative to the larger, count as equal: a symmetric top. 64 u: what a few
/// products and one eigenvalue solve leave between moments that are equal. The turn so ignored is
/// 7e-15 of the rotation.
inline constexpr double symmetric_moments = 64 * unit_roundoff;

/// rad. A rotation sub-step of the methods that are no splitting may turn a body by no more: their
/// errors of a step are of the cube of the turn.
inline constexpr double rotation_per_substep = 0.5;

/// Largest relative error in the energy of rotation that the sub-steps of a splitting leave; it
/// swings and never drifts.
inline constexpr double rotation_energy = 2e-3;

/// rad. The spin of a nearly symmetric top per sub-step. At pi the kicks of the asymmetry come once
/// per half turn, in the top's own rhythm, and add up; 2 keeps clear of it by a third.
inline constexpr double top_spin_per_substep = 2.0;

/// The most rotation sub-steps of one body in a step: a step of one such body then costs 10 us, as
/// much as 500 slow ones. Reached above about 8000 rad/s at 60 Hz; reported.
inline constexpr double rotation_substeps = 256;

/// A Newton iteration whose last change was this small is done: the next would be its square, below
/// u. sqrt(u) / 4.
inline constexpr double newton_last_change = 2.6e-9;

/// Iterations of the polar decomposition. R + h w* R has singular values sqrt(1 + |h w|^2): each
/// iteration halves large ones, then squares the error: |h w| = 1e6 needs 25.
inline constexpr int polar_iterations = 40;

/// Iterations of the implicit midpoint rule. It gains about |h w|^2 / 12 per iteration: 4 to 6 at
/// |h w| = 0.5; one that needs more than 40 is not going to.
inline constexpr int implicit_iterations = 40;

/// Carlson's series are summed once all arguments are within this of their mean, relative: the
/// first term left out is below (3/8) x^6, so x = (8 u / 3)^(1/6) / 1.2.
inline constexpr double carlson_series = 2.1e-3;

/// In units of the elliptic argument: spans up to this are integrated by Gauss's 10-point rule.
/// 1 + nu sn^2 has no zero nearer the real axis than pi/4, so the rule errs by r^-20 with
/// r = x + sqrt(x^2 + 1), x = (pi/4) / (span/2): 9e-18 at 0.45.
inline constexpr double gauss_span = 0.45;

/// The most steps of one adaptive flight: some seconds of work; each turns the body by about a
/// radian.
inline constexpr long taylor_steps = 1'000'000;

/// How often an adaptive flight is flown again. The truncation error is linear in what a step is
/// allowed, so the second pass nearly always meets the tolerance.
inline constexpr int taylor_passes = 5;

/// rad. What the adaptive method aims at where nobody says: about the rounding of 1e3 turns.
inline constexpr double taylor_default = 1e-12;

/// rad. What it aims at in each step of a simulation: ten roundings, so 1e6 steps err by 1e-9.
inline constexpr double taylor_step_error = 1e-15;

/// The most steps of a fixed-step flight that chooses its number of steps: a few seconds of work.
inline constexpr long flight_steps = 1L << 24;

/// A contact time of linear corner motion is early by at most this, fraction of the step, and never
/// late. What callers are promised; the two brackets below stay inside it.
inline constexpr double contact_time = 1e-9;

/// The exact stage brackets a contact this tightly, fraction of the step: 2^-40, 9.1e-13, a
/// thousand times inside contact_time; each comparison costs the same at any width down to its grid
/// of 2^-60.
inline constexpr double exact_time_bracket = 0x1p-40;

/// A root of a cubic is bracketed this tightly by default, fraction of [0, 1]: 16 u, a few spacings
/// of doubles near 1, below which bisection only walks along rounding.
inline constexpr double root_width = 16 * unit_roundoff;

/// With thickness > 0 a hit is reported only where the least distance is below thickness + this *
/// (thickness + largest corner difference). Distances in doubles carry about 1e2 u = 1e-14 of those
/// lengths; a factor 100 lets a tangent approach stop dividing its time early.
inline constexpr double thickness_slack = 1e-12;

/// A sweep of rigid bodies calls a gap this small a contact, m. Choice: a micrometre is invisible
/// to a reader of poses and needs only sqrt(r / (8e-6 m / 4)) intervals per radian at radius r.
inline constexpr double sweep_gap = 1e-6;

/// The longest interval of a sweep, rad of turn: an eighth of a turn. Up to there a chord stays
/// within 8 % of its radius; the bound r angle^2 / 8 itself holds at any angle.
inline constexpr double sweep_turn = 0.7853981633974483;

/// Moving bodies meet when they are this near, m. Choice: a micrometre is far above the rounding of
/// coordinates up to 1e6 m (1e-10) and invisible to a reader of poses.
inline constexpr double sweep_clear = 1e-6;

/// A pair that is nearer already (it rests, or was hit a moment ago) may come nearer by this before
/// it counts as meeting again, m. A point at radius r that turns away from a wall needs it to get
/// off: the stride sqrt(8 slop / (w^2 r)) of a rod of 1 m at 100 rad/s is then 0.1 ms. Ten hits of
/// one pair in a step keep its overlap below 0.1 mm.
inline constexpr double sweep_slop = 1e-5;

/// Overlap at which sweep_slop has run out, m, and the share of an inner radius it may not exceed.
/// Choice: twice what soft contacts sink at rest (soft_sink), and a tenth of the body.
inline constexpr double sweep_deepest = 8e-4;
inline constexpr double sweep_deepest_share = 0.1;

/// Share of sweep_slop that is always left, so that what overlaps can turn and leave: 10 nm. A body
/// jammed for a minute at 60 Hz sinks 36 um by it.
inline constexpr double sweep_least_slop = 1e-3;

/// The largest gap at which a hit leaves two bodies, m: it is called between sweep_clear and half
/// as much again. What is farther apart and comes near flew there, however small the gap.
inline constexpr double sweep_leaves = 1.5 * sweep_clear;

/// Contact points farther apart than this are left to the sweep where a body is fast, m: more than
/// a hit leaves (sweep_clear) and than a pair that was hit may use up (sweep_slop).
inline constexpr double sweep_touch = 2e-5;

/// Share of its inner radius that a body may travel in a step without being swept. Contacts are
/// looked for that far ahead, so it meets whatever is there; and should the solver fail, its middle
/// is not past a sheet that its surface had not reached: the next step pushes it the right way.
inline constexpr double sweep_share = 1.0;

/// Share of the thinner body's thickness by which bodies that the solver holds apart may overlap
/// within a step without being followed. Half: the next step finds them on the side they are on.
inline constexpr double sweep_held = 0.5;

/// rad: up to this turn in a step two bodies that turn together count as at rest against each
/// other: the second order left out, turn^2 / 2 of their distance, is 5 % of it.
inline constexpr double small_turn = 0.3;

/// Share of its speed, and of its spin, that a body keeps when its hits run out, or when it has to
/// wait in a second step on end, unless it is fully elastic. Choice: what jams loses its speed in
/// some steps, as it would by hits without number.
inline constexpr double sweep_wait_keeps = 0.5;

/// Distances one pair of convex parts may ask for before it counts as given up. A rod that turns
/// past a wall asks 20, one that spins towards it at 100 rad/s some 300.
inline constexpr int sweep_queries = 1024;

/// Hits of one body in a step; then it waits for the next one instead of passing anything. Choice:
/// a ball of a struck chain takes two, a ball in a corner three; a heap that falls fast meets at
/// once everywhere, which the contact solver settles together and hits one by one do not.
inline constexpr int sweep_hits = 8;

/// m/s: points that close more slowly than this are not hit. Over 0.1 s they move a thousandth of
/// sweep_slop.
inline constexpr double sweep_still = 1e-7;

/// Share of its gap that a body may move towards a distance grid at once: between samples the
/// interpolated distance grows at up to sqrt(3) times the way.
inline constexpr double sdf_stride = 0.5;

/// rad: the longest arc of a path between two orientations of a body that is not a ball. Choice: a
/// top strays from it by no more than angle^2 / 8 times the asymmetry of its moments, 1e-3 rad.
inline constexpr double sweep_arc = 0.1;

/// The plain float method calls points closer than this a contact, m. Choice: the usual 1e-6 (as in
/// Bridson 2002 and in Tight-Inclusion's default), absolute as theirs is: that is its weakness.
inline constexpr double float_contact = 1e-6;

/// How far the largest moment may exceed the sum of the other two, and the smallest lie below 0,
/// relative, before no mass distribution has the tensor. The mission's figure; a rotated flat plate
/// is off by 16 u = 2e-15.
inline constexpr double impossible_inertia = 1e-12;

/// How far a tensor given from outside may be from symmetric, relative to its largest entry: what
/// two sides written with 9 digits differ by. Its mean with its transpose is used.
inline constexpr double inertia_symmetry = 1e-9;

/// A rotation matrix given from outside may be off R R^T = 1 by this, per entry. Choice: matrices
/// printed with 9 digits pass; anything further off is more likely a scale or a mistake.
inline constexpr double rotation_matrix = 1e-8;

/// A double-precision mesh integral is kept when its error bound is below this part of the smallest
/// moment, else it is summed again in double-double. A tenth of the 1e-12 that is promised.
inline constexpr double mesh_integral = 1e-13;

/// Mean thickness over diagonal below which a closed mesh is called thin, relative. Coordinates in
/// single precision, as STL files hold them, are off by 6e-8 of their size: at 1e-6 each of the two
/// sides shifts the volume by 6 %, and below that the volume is guesswork.
inline constexpr double thin_mesh = 1e-6;

/// Sign of an orientation determinant of doubles: the plain one is trusted above this share of the
/// sum of its terms' sizes. (7 + 56 u) u in J. R. Shewchuk, "Adaptive precision floating-point
/// arithmetic", 1997, rounded up.
inline constexpr double orientation_filter = 8 * unit_roundoff;

/// The same in double-double: differences are exact, 5 operations of 2^-102 each on every term's
/// way. Below it four points count as coplanar.
inline constexpr double orientation_exact = 0x1p-98;

/// Standard error of a sampled mass, relative, above which the result carries a warning. Choice:
/// one digit.
inline constexpr double poor_sampling = 0.1;

/// Above this (x - 1 + exp(-x)) / x^2 is computed as it stands, losing 2 u / x; below, nine more
/// terms of its series drop x^10 / 12! < u.
inline constexpr double decay_series = 0.1;

}  // namespace carom::tolerance
