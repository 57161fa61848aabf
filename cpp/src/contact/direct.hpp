// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "contact/block_cholesky.hpp"
#include "contact/cone.hpp"

namespace carom::contact {

/// A body of an island as the direct solver sees it. World axes; angular parts about the centre of
/// mass.
struct DirectBody {
  double mass = 0, inverse_mass = 0;
  Eigen::Matrix3d inertia, inverse_inertia;  ///< kg m^2; made invertible, and the pseudo-inverse
  Eigen::Matrix3d resists;                   ///< projector on the axes that resist rotation
  bool resists_all = true;
  double radius = 0;  ///< m, turns rad/s into the m/s that the tolerances speak of
  Vector6 free, v;    ///< linear, angular: without contacts, and the unknown
};

/// One contact point. `a` or `b` is -1 where that side does not move within the solve.
struct DirectPoint {
  int a = -1, b = -1;
  int edge = -1;  ///< of (a, b) in the island's graph
  double mu = 0;
  double gap_speed = 0;  ///< m/s added to the normal velocity before it must be >= 0
  double mobility = 0;   ///< 1/kg, mean diagonal of J M^-1 J^T
  Eigen::Vector3d arm_a, arm_b;
  Eigen::Matrix3d frame;    ///< columns: normal, two tangents
  Eigen::Vector3d drive;    ///< m/s, velocity of the sides that do not move, in the frame
  Eigen::Vector3d impulse;  ///< N s in the frame; in: where to start; out: the solution
};

/// Turning impulses a contact also carries where rolling or spinning resistance is asked for.
struct DirectTurn {
  int point = 0;
  double rolling = 0, spinning = 0;  ///< m: bounds are these times the normal impulse
  double mobility = 0;               ///< 1/(kg m^2)
  Eigen::Vector3d drive;             ///< rad/s of the sides that do not move, in the frame
  Eigen::Vector3d impulse;           ///< N m s in the frame of the point
};

struct DirectResult {
  bool converged = false;
  int newton = 0;       ///< Newton steps in all
  double residual = 0;  ///< m/s
};

/// Contact velocities of one island to a stated residual, whatever the mass ratio and however many
/// points share a face: augmented Lagrangian outside, Newton with exact line search on the bodies'
/// velocities inside, block Cholesky over bodies.
///
/// Coulomb's law is reached by shifting the normal velocity by mu |slip| of the last iterate
/// (De Saxce; Acary and Cadoux 2013): the cone of one iterate alone would lift what slides.
class DirectSolver {
 public:
  std::vector<DirectBody> bodies;
  std::vector<DirectPoint> points;
  std::vector<DirectTurn> turns;
  std::vector<std::pair<int, int>> edges;

  void clear();
  /// Reads bodies, points, turns, edges; writes their `v` and `impulse`. When not converged these
  /// are the last iterate: do not use them.
  /// @param enough       m/s, residual to stop at
  /// @param slow_enough  m/s, the same once rounds gain little
  DirectResult solve(double enough, double slow_enough, int newton_cap);

 private:
  struct Work {
    double rho;
    Eigen::Vector3d start, z, value, along;
    double shift, slip, normal_speed;
    double shift_change;  ///< m/s, in the last round
    Branch branch;
  };
  struct TurnWork {
    double rho;
    Eigen::Vector3d start, z, value, along;
    double roll_bound, spin_bound;
  };

  [[nodiscard]] Eigen::Vector3d slip(const DirectPoint& p, std::span<const Vector6> v) const;
  [[nodiscard]] Eigen::Vector3d turning(const DirectTurn& t, std::span<const Vector6> v) const;
  void project();
  double gradient();
  bool factor();
  [[nodiscard]] bool same_branches() const;
  double line_search(double slope_at_0);
  void add_impulses(std::span<Vector6> to, double sign) const;

  BlockCholesky cholesky_;
  std::vector<Work> work_;
  std::vector<TurnWork> turn_work_;
  std::vector<Branch> factored_;
  std::vector<Vector6> v_, gradient_, step_;
};

}  // namespace carom::contact
