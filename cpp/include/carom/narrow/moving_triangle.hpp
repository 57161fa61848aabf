// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>

#include <Eigen/Core>

namespace carom {

/// How a continuous query was decided.
enum class CcdStatus : std::uint8_t {
  certified,    ///< in doubles, with every rounding bounded
  coplanar,     ///< exactly; the four points stay in one plane throughout
  exact,        ///< exactly, in integers
  conservative  ///< thickness > 0 only: contact not excluded, nor proven; reported as a hit
};

/// Methods for the same question. Only `certified` is meant for use; the others are what it is
/// measured against (study "ccd").
enum class CcdMethod : std::uint8_t {
  certified,  ///< no miss and no false alarm, see point_triangle()
  lecture,   ///< the cubic by derivative, extrema, brackets, secant and bisection, in plain doubles
  tolerance  ///< the same, a contact when closer than tolerance::float_contact at a root or an end
};

struct CcdOptions {
  double thickness = 0;  ///< m, >= 0: contact when the distance is <= thickness
  CcdMethod method = CcdMethod::certified;
};

struct CcdHit {
  bool hit = false;
  double time = 1;  ///< fraction of the step in [0, 1]; 1 without a hit
  CcdStatus status = CcdStatus::certified;
};

/// Four points, each on a straight line from `start` to `end` over the step. Columns: point, a, b,
/// c for point_triangle(); a0, a1, b0, b1 for edge_edge(). m.
struct MovingFour {
  Eigen::Matrix<double, 3, 4> start, end;
};

/// Does a moving point meet a moving triangle, and when first?
///
/// With thickness 0: hit is true exactly when the closed point and triangle share a point at some
/// time in the closed interval [0, 1], for the real numbers the doubles stand for: no tolerance,
/// any scale (denormals to 1e308), degenerate triangles and coplanar motion included. `time` is
/// never later than the first contact, and within tolerance::contact_time of it.
///
/// With thickness > 0: never a miss. A hit is reported only if the least distance is below
/// thickness + tolerance::thickness_slack * (thickness + largest corner difference), or after 2^14
/// divisions of time, which no test has needed; `time` is never later than the first contact.
/// @throws InvalidInput for coordinates that are not finite, or a thickness that is not finite and
/// not negative
///
/// Source: lecture notes, "Moving triangles equation", made certain.
[[nodiscard]] CcdHit point_triangle(const MovingFour& points, const CcdOptions& options = {});

/// The same for two moving segments; a segment may have length 0.
[[nodiscard]] CcdHit edge_edge(const MovingFour& points, const CcdOptions& options = {});

/// Results of a batch: one entry per query in each.
struct CcdBatch {
  std::span<std::uint8_t> hit;
  std::span<double> time;
  std::span<std::uint8_t> status;  ///< CcdStatus
};

/// Many queries, SIMD lanes across queries. `queries` holds 24 doubles each: the four points at the
/// start, then at the end, x y z. No allocation.
/// @throws InvalidInput as above, or when the sizes disagree
void point_triangle(std::span<const double> queries, const CcdBatch& out,
                    const CcdOptions& options = {});
void edge_edge(std::span<const double> queries, const CcdBatch& out,
               const CcdOptions& options = {});

}  // namespace carom
