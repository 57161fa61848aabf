// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>

#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/triangle.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {

/// Whether `direction` points away from the body at vertex v: along it no edge of v leads on.
/// @param slack  sine of the angle by which an edge may lead on and still not count
[[nodiscard]] bool in_cone_of_vertex(const MeshSurface& s, int v, const Eigen::Vector3d& direction,
                                     double slack = tolerance::normal_cone);

/// The same at an edge: the direction lies between the normals of its two faces.
[[nodiscard]] bool in_cone_of_edge(const MeshSurface& s, int e, const Eigen::Vector3d& direction);

/// The feature of face f that a point at `away` from it is nearest to, none where the point belongs
/// to another face, lies behind, or the surface is not convex there. On a flat edge: the face.
[[nodiscard]] std::optional<std::uint32_t> held_by(const MeshSurface& s, int f, TriangleFeature at,
                                                   const Eigen::Vector3d& away);

}  // namespace carom
