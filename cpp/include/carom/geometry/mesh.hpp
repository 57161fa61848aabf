// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

#include <Eigen/Core>

namespace carom {

/// Triangle mesh: vertices in rows of three, m; faces as rows of three vertex indices,
/// counter-clockwise seen from outside. Row-major, so that arrays from Python and files are taken
/// as they lie.
struct TriangleMesh {
  using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  using Faces = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

  Vertices vertices;
  Faces faces;
};

/// Refuses what no mesh can be: no face, an index out of range, a coordinate that is not finite.
/// @throws InvalidInput naming the first offending row
void require_valid(const TriangleMesh& mesh, std::string_view field);

}  // namespace carom
