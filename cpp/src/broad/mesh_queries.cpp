// SPDX-License-Identifier: Apache-2.0
#include "broad/mesh_queries.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "carom/numerics/invalid_input.hpp"

namespace carom::broad {
namespace {

std::string row_of(const char* name, Eigen::Index row) {
  return std::string(name) + "[" + std::to_string(row) + "]";
}

}  // namespace

void require_finite_row(const Eigen::Vector3d& v, const char* name, Eigen::Index row) {
  if (!v.allFinite())
    throw InvalidInput(row_of(name, row), with_unit(v.transpose(), "m"), "must be finite");
}

void require_distance(double max_distance) {
  if (!(max_distance >= 0))
    throw InvalidInput("max_distance", with_unit(max_distance, "m"), "must be >= 0");
}

void require_same_rows(Points a, const char* a_name, Points b, const char* b_name) {
  if (a.rows() != b.rows())
    throw InvalidInput(
        b_name, std::to_string(b.rows()) + " rows",
        std::string("must have as many as ") + a_name + ": " + std::to_string(a.rows()));
}

namespace {

// A sum is finite unless some term is not, or it overflows: only then look closer.
bool all_finite(Points rows) {
  return rows.rows() == 0 || std::isfinite(rows.sum());
}

}  // namespace

void require_finite_rows(Points rows, const char* name) {
  if (all_finite(rows)) return;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) require_finite_row(rows.row(i), name, i);
}

void require_directions(Points directions) {
  require_finite_rows(directions, "directions");
  for (Eigen::Index i = 0; i < directions.rows(); ++i)
    if (is_zero(row_at(directions, i)))
      throw InvalidInput(row_of("directions", i), "0", "must have a direction");
}

void require_segments(Points starts, Points ends) {
  require_finite_rows(starts, "starts");
  require_finite_rows(ends, "ends");
  if (starts.rows() == 0 || std::isfinite((ends - starts).sum())) return;
  for (Eigen::Index i = 0; i < ends.rows(); ++i)
    require_finite_row(ends.row(i) - starts.row(i), "ends - starts", i);
}

void require_finite_vertices(const Eigen::Ref<const TriangleMesh::Vertices>& vertices) {
  // One sum is finite unless some term is not, or it overflows: only then look closer.
  if (std::isfinite(vertices.sum())) return;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i)
    if (!vertices.row(i).allFinite())
      throw InvalidInput(row_of("vertices", i), with_unit(vertices.row(i), "m"), "must be finite");
}

void require_mesh(const Eigen::Ref<const TriangleMesh::Vertices>& vertices,
                  const Eigen::Ref<const TriangleMesh::Faces>& faces) {
  require_finite_vertices(vertices);
  const auto count = static_cast<unsigned>(vertices.rows());
  for (Eigen::Index i = 0; i < faces.rows(); ++i)
    for (int k = 0; k < 3; ++k)
      if (static_cast<unsigned>(faces(i, k)) >= count)
        throw InvalidInput(row_of("faces", i), with_unit(faces.row(i), ""),
                           "must index vertices 0 to " + std::to_string(vertices.rows() - 1));
}

}  // namespace carom::broad
