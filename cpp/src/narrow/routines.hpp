// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <vector>

#include "carom/geometry/convex.hpp"
#include "carom/geometry/frame.hpp"
#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/polytope.hpp"
#include "carom/geometry/sdf.hpp"
#include "carom/geometry/separation.hpp"
#include "carom/narrow/contacts.hpp"

// The routines every pair of shapes is built from: four kinds of body (half-space, convex, surface,
// distance grid), ten pairs. All work in the frame of a (b sits at b_in_a), append manifolds in
// that frame, normals from a to b, and leave out points beyond `margin`.
namespace carom {

/// a is the half-space normal . x <= offset (unit normal).
void half_space_points(const Eigen::Vector3d& normal, double offset,
                       std::span<const Eigen::Vector3d> points, const Frame& b_in_a, double margin,
                       std::vector<Manifold>& out);
void half_space_convex(const Eigen::Vector3d& normal, double offset, const Convex& b,
                       const Frame& b_in_a, double margin, std::vector<Manifold>& out);
void half_space_surface(const Eigen::Vector3d& normal, double offset, const MeshSurface& b,
                        const Frame& b_in_a, double margin, std::vector<Manifold>& out);
void half_space_sdf(const Eigen::Vector3d& normal, double offset, const SdfGrid& b,
                    const Frame& b_in_a, double margin, std::vector<Manifold>& out);

void convex_convex(const Convex& a, const Convex& b, const Frame& b_in_a, double margin,
                   std::vector<Manifold>& out);
/// False where b is near several faces of a, or deep inside. Near one alone a is a half-space to
/// it.
/// @param corners  m, of b where it is a polytope, else none
bool one_face(const Polytope& a, const Convex& b, std::span<const Eigen::Vector3d> corners,
              const Frame& b_in_a, double margin, std::vector<Manifold>& out);
/// How far two polytopes are apart along the normal of a face of one of them.
struct FaceAxis {
  double separation;       ///< m
  Eigen::Vector3d normal;  ///< from a to b, frame of a
  int face;
};
/// The contact of two edges that lie along one another; false where the two best faces do not meet
/// in such a pair, nearly touching.
/// @param size  m, twice that of the smaller
bool edge_on_edge(const Polytope& pa, const FaceAxis& a, const Polytope& pb, const FaceAxis& b,
                  const Frame& b_in_a, double size, Manifold& out);
/// For few faces: separating axes while they overlap, convex_convex while apart.
void polytope_polytope(const Polytope& a, const Polytope& b, const Frame& b_in_a, double margin,
                       std::vector<Manifold>& out);
/// Of boxes: the same answer in closed form.
void box_box(const Eigen::Vector3d& half_a, const Eigen::Vector3d& half_b, const Frame& b_in_a,
             double margin, std::vector<Manifold>& out);
/// The patch of two convex bodies once their separation is known.
void patch_along(const Convex& a, const Convex& b, const Frame& b_in_a, const Separation& s,
                 double margin, std::vector<Manifold>& out);

/// A ball at `centre` (in the frame of a).
void ball_ball(double radius_a, const Eigen::Vector3d& centre, double radius, double margin,
               std::vector<Manifold>& out);
void box_ball(const Eigen::Vector3d& half, const Eigen::Vector3d& centre, double radius,
              double margin, std::vector<Manifold>& out);
void surface_ball(const MeshSurface& a, const Eigen::Vector3d& centre, double radius, double margin,
                  std::vector<Manifold>& out);

/// b is curved; polyhedra go to surface_surface.
void surface_convex(const MeshSurface& a, const Convex& b, const Frame& b_in_a, double margin,
                    std::vector<Manifold>& out);
void surface_surface(const MeshSurface& a, const MeshSurface& b, const Frame& b_in_a, double margin,
                     std::vector<Manifold>& out);

void sdf_convex(const SdfGrid& a, const Convex& b, const Frame& b_in_a, double margin,
                std::vector<Manifold>& out);
void sdf_surface(const SdfGrid& a, const MeshSurface& b, const Frame& b_in_a, double margin,
                 std::vector<Manifold>& out);
void sdf_sdf(const SdfGrid& a, const SdfGrid& b, const Frame& b_in_a, double margin,
             std::vector<Manifold>& out);

}  // namespace carom
