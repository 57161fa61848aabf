// SPDX-License-Identifier: Apache-2.0
#include "carom/geometry/mesh.hpp"

#include <string>

#include "carom/numerics/invalid_input.hpp"

namespace carom {

void require_valid(const TriangleMesh& mesh, std::string_view field) {
  const std::string at(field);
  if (mesh.faces.rows() == 0) throw InvalidInput(at + ".faces", "none", "must hold a face");
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
    if (!mesh.vertices.row(i).allFinite())
      throw InvalidInput(at + ".vertices[" + std::to_string(i) + "]",
                         with_unit(mesh.vertices.row(i), "m"), "must be finite");
  for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i)
    if (mesh.faces.row(i).minCoeff() < 0 || mesh.faces.row(i).maxCoeff() >= mesh.vertices.rows())
      throw InvalidInput(at + ".faces[" + std::to_string(i) + "]", with_unit(mesh.faces.row(i), ""),
                         "must index vertices 0 to " + std::to_string(mesh.vertices.rows() - 1));
}

}  // namespace carom
