// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace carom::contact {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Sparse Cholesky factorisation of a symmetric positive definite matrix of 6x6 blocks, one block
/// row per body, in an order that keeps fill low (minimum degree).
///
/// Analysis depends on the graph alone and is kept while the graph stays; a chain costs O(n).
class BlockCholesky {
 public:
  /// @param edges  pairs of distinct bodies below n; the same pair may come more than once
  void analyse(int n, std::span<const std::pair<int, int>> edges);

  void set_zero();
  [[nodiscard]] Matrix6& diagonal(int i) { return diagonal_[position_[i]]; }
  /// Adds `block`, which stands in block row a and block column b of the edge given to analyse().
  void add(int edge, const Matrix6& block);

  /// Overwrites the matrix by its factor. False when a pivot is not positive: the caller must not
  /// use the factor then.
  [[nodiscard]] bool factor();
  /// x := A^-1 x, rows in the caller's order.
  void solve(std::span<Vector6> x);

 private:
  void order();
  void lay_out();

  int n_ = 0;
  std::vector<std::pair<int, int>> edges_;
  std::vector<std::vector<int>> neighbours_;  // while eliminating; then: rows of each column
  std::vector<int> order_, position_;
  std::vector<int> column_start_, rows_;  // blocks below the diagonal, column by column
  std::vector<int> targets_;              // where each update of the elimination lands
  std::vector<int> edge_block_;  // >= 0: block index, stored transposed when below 0: ~index
  std::vector<Matrix6> diagonal_, blocks_;
  std::vector<Vector6> work_;
};

}  // namespace carom::contact
