// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "carom/bodies/mass_properties.hpp"
#include "carom/bodies/mesh_moments.hpp"
#include "carom/bodies/shells.hpp"
#include "carom/geometry/aabb.hpp"
#include "carom/geometry/mesh_diagnosis.hpp"
#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom {
namespace {

MassProperties of_moments(const MeshMoments& moments, double density) {
  MassProperties body;
  body.mass = density * moments.measure;
  body.com = moments.centroid;
  body.inertia = density * inertia_of_second_moments(moments.second);
  if (!std::isfinite(body.mass) || !body.inertia.allFinite())
    throw InvalidInput("mesh", with_unit(body.mass, "kg"), "must give finite numbers",
                       "the sizes and the density leave the range of doubles");
  return body;
}

double diagonal(const TriangleMesh& mesh) {
  Aabb box;
  for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i)
    for (int k = 0; k < 3; ++k) box.extend(mesh.vertices.row(mesh.faces(i, k)).transpose());
  return box.extents().norm();
}

}  // namespace

MassProperties MassProperties::mesh(const TriangleMesh& mesh, double density) {
  require_positive(density, "density", "kg/m^3");
  const MendedMesh sound = mended(mesh);
  const MeshDiagnosis& found = sound.diagnosis;
  if (!found.closed())
    throw InvalidInput("mesh", "open at " + std::to_string(found.open_edges) + " edges",
                       "must be closed to enclose a volume",
                       "close the holes, or take it as a thin shell");
  if (!found.orientable)
    throw InvalidInput("mesh", "a surface with one side", "must have an inside");
  const MeshMoments moments =
      sound.mesh.faces.rows() > 0 ? volume_moments(sound.mesh) : MeshMoments{};
  if (!(moments.measure > moments.measure_error))
    throw InvalidInput("mesh", with_unit(moments.measure, "m^3"), "must enclose a volume",
                       "take a flat mesh as a thin shell");
  MassProperties body = of_moments(moments, density);
  body.warnings = found.findings();
  const double thickness = 2 * moments.measure / surface_moments(sound.mesh).measure;
  if (thickness <= tolerance::thin_mesh * diagonal(sound.mesh))
    body.warnings.push_back("tiny volume: the mesh is " + with_unit(thickness, "m") +
                            " thick on average, where single-precision corners decide it");
  return body;
}

namespace shell {

MassProperties mesh(const TriangleMesh& mesh, double surface_density) {
  require_valid(mesh, "mesh");
  require_positive(surface_density, "surface_density", "kg/m^2");
  const MeshMoments moments = surface_moments(mesh);
  if (!(moments.measure > 0))
    throw InvalidInput("mesh", with_unit(moments.measure, "m^2"), "must have an area");
  return of_moments(moments, surface_density);
}

}  // namespace shell
}  // namespace carom
