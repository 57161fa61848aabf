// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "carom/bodies/principal_axes.hpp"
#include "carom/geometry/mesh.hpp"
#include "carom/geometry/shape.hpp"

namespace carom {

inline constexpr double default_density = 1000;  ///< kg/m^3, water: where nothing else is given

/// Standard errors (one sigma) of sampled mass properties, entry by entry, and what they cost.
struct SamplingError {
  double mass = 0.0;                                  ///< kg; NaN where the method gives none
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      ///< m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m^2
  long samples = 0;                                   ///< points evaluated
};

/// Mass, centre of mass and inertia of a rigid body, in the body's own frame B. A plain value.
///
/// Every factory guarantees a finite mass > 0 and a tensor that some distribution of mass has.
/// A rod or a point has zero moments: legal, see inertia_rank() and inverse_inertia(). Round bodies
/// lie along z. Sizes are in m, > 0; density in kg/m^3, > 0; thin shells are in shells.hpp, bodies
/// from an inside test in sampling.hpp, from particles in particles.hpp. Each factory
/// @throws InvalidInput naming the offending argument.
struct MassProperties {
  double mass = 0.0;                                  ///< kg
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      ///< m, in B
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m^2, about `com`, axes of B
  std::vector<std::string> warnings;                  ///< legal but odd, one sentence each
  std::optional<SamplingError> error;                 ///< only where something was sampled

  /// Given numbers, checked: mass > 0, inertia physical (see physical_inertia).
  [[nodiscard]] static MassProperties checked(double mass, const Eigen::Vector3d& com,
                                              const Eigen::Matrix3d& inertia);

  // Solids, centred at the origin of B unless told otherwise.
  [[nodiscard]] static MassProperties sphere(double radius, double density);
  /// Half a ball above the plane z = 0, its flat face in that plane.
  [[nodiscard]] static MassProperties hemisphere(double radius, double density);
  /// Between two spheres of one centre; 0 <= inner_radius < outer_radius.
  [[nodiscard]] static MassProperties hollow_sphere(double inner_radius, double outer_radius,
                                                    double density);
  /// extents: full edge lengths.
  [[nodiscard]] static MassProperties box(const Eigen::Vector3d& extents, double density);
  /// length: of the straight part, without the caps, >= 0.
  [[nodiscard]] static MassProperties capsule(double radius, double length, double density);
  [[nodiscard]] static MassProperties cylinder(double radius, double length, double density);
  /// Hollow cylinder; 0 <= inner_radius < outer_radius.
  [[nodiscard]] static MassProperties tube(double inner_radius, double outer_radius, double length,
                                           double density);
  /// Apex towards +z at 3/4 of the length; the origin is the centre of mass.
  [[nodiscard]] static MassProperties cone(double radius, double length, double density);
  /// radii: semi-axes.
  [[nodiscard]] static MassProperties ellipsoid(const Eigen::Vector3d& radii, double density);
  /// Ring about z; major_radius: centre of the ring to centre of the tube; 0 < minor_radius <=
  /// major_radius.
  [[nodiscard]] static MassProperties torus(double major_radius, double minor_radius,
                                            double density);

  // Bodies without a volume, by their mass (kg, > 0).
  [[nodiscard]] static MassProperties point(const Eigen::Vector3d& position, double mass);
  /// Thin rod along z: rank 2.
  [[nodiscard]] static MassProperties rod(double length, double mass);
  /// Thin disc in the plane z = 0.
  [[nodiscard]] static MassProperties disc(double radius, double mass);
  /// Thin rectangle in the plane z = 0; extents: full edge lengths along x and y.
  [[nodiscard]] static MassProperties plate(const Eigen::Vector2d& extents, double mass);

  /// Solid inside of a closed mesh, exact for the mesh: 1e-12 of the rational sums over the given
  /// doubles, wherever the mesh lies. Wrong winding is mended and said in `warnings`, as are
  /// cavities, crossings and more (see MeshDiagnosis). An open or one-sided mesh is refused.
  [[nodiscard]] static MassProperties mesh(const TriangleMesh& mesh, double density);

  /// The union of any number of bodies given in one frame, by the parallel-axis theorem. The sums
  /// are in double-double: the order of the parts changes no digit above 1e-15.
  [[nodiscard]] static MassProperties combined(std::span<const MassProperties> parts);

  /// The same body seen from another frame: x_new = rotation * x + translation.
  /// @throws InvalidInput when `rotation` is no rotation; a reflection (det = -1) is none.
  [[nodiscard]] MassProperties transformed(const Eigen::Matrix3d& rotation,
                                           const Eigen::Vector3d& translation) const;
  /// The same body with its density scaled until it weighs `mass`, kg, > 0.
  [[nodiscard]] MassProperties scaled_to(double mass) const;
};

/// Rigid union of two bodies given in one frame. Commutative to the last bit; many parts are better
/// given to MassProperties::combined. Source: lecture notes, "Combined Inertia Tensor".
[[nodiscard]] MassProperties operator+(const MassProperties& a, const MassProperties& b);

/// Mass properties of a shape of uniform density, kg/m^3. A plane has none. @throws InvalidInput
[[nodiscard]] MassProperties mass_properties(const Shape& shape, double density);

}  // namespace carom
