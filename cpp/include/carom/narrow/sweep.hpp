// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "carom/geometry/mesh.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {

/// A rigid motion over one step: the centre moves on a line, the body turns at a constant rate.
struct ScrewMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();                 ///< at the start, m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< at the start, R_wb
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();           ///< v dt, m
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();               ///< omega dt, rad, world axes

  /// World position of the body point p (relative to the centre) at the fraction t of the step.
  [[nodiscard]] Eigen::Vector3d position(const Eigen::Vector3d& p_b, double t) const;
};

/// How far a point at distance `radius` from the axis can leave its timed chord while the body
/// turns by `angle`: its acceleration is at most omega^2 r, so r angle^2 / 8. m.
[[nodiscard]] double chord_error(double radius, double angle);

/// A body to sweep: vertices relative to the centre, faces, edges. Either may be empty: a rod is
/// two vertices and an edge. Every edge of a face must be listed, see edges_of().
struct SweptBody {
  using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;
  TriangleMesh mesh;
  Edges edges;
  ScrewMotion motion;
};

/// The undirected edges of the faces, each once.
[[nodiscard]] SweptBody::Edges edges_of(const TriangleMesh::Faces& faces);

enum class SweepStatus : std::uint8_t {
  separated,  ///< certified: farther than thickness throughout
  /// The distance gets to thickness + tolerance or below at `time` or at most
  /// tolerance::contact_time of the step after it.
  contact,
  interval_limit,  ///< cap reached: certified only up to `time`; treat it as a contact there
};

struct SweepOptions {
  double thickness = 0;                     ///< m, >= 0
  double tolerance = tolerance::sweep_gap;  ///< m, > 0
  int max_intervals = 4096;
};

struct SweepResult {
  SweepStatus status = SweepStatus::separated;
  double time = 1;    ///< no contact in [0, time): a lower bound, always
  int intervals = 0;  ///< chords tried, the "work"
  int queries = 0;    ///< continuous queries spent
  enum class Kind : std::uint8_t {
    none,
    vertex_face,
    face_vertex,
    edge_edge,
    edge_face,  ///< these two only at time 0: an edge already passes through a face
    face_edge
  } kind = Kind::none;
  int a = -1, b = -1;  ///< indices of the features met (vertex, face or edge of each body)
};

/// First contact of two rigidly moving surfaces, rotation included; never a miss. Surfaces that
/// already pass through each other are in contact at time 0; one that lies wholly inside another is
/// not in contact with it.
///
/// The step is cut into intervals on which every vertex follows its chord, to within chord_error().
/// The chords are asked with thickness enlarged by both bodies' errors and the rounding of poses;
/// intervals shrink until the errors are below tolerance / 4, and grow again where nothing is near.
/// So a false alarm needs a distance below thickness + tolerance. All features of one body are
/// tried against all of the other that share a box: for large meshes pass the parts that a tree
/// found near.
/// @throws InvalidInput for what is not finite, indices out of range, tolerance not > 0
/// Source: lecture notes, "Moving triangles equation" for the chords; Redon et al. 2002 (arbitrary
/// in-between motions).
[[nodiscard]] SweepResult sweep(const SweptBody& a, const SweptBody& b,
                                const SweepOptions& options = {});

}  // namespace carom
