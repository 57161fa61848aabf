// SPDX-License-Identifier: Apache-2.0
#include "contact/block_cholesky.hpp"

#include <algorithm>
#include <cmath>

namespace carom::contact {
namespace {

// In place, lower triangle. Written out because Eigen's LLT checks sizes that are fixed here.
bool cholesky(Matrix6& a) {
  for (int j = 0; j < 6; ++j) {
    double d = a(j, j);
    for (int k = 0; k < j; ++k) d -= a(j, k) * a(j, k);
    if (!(d > 0)) return false;
    d = std::sqrt(d);
    a(j, j) = d;
    const double inverse = 1 / d;
    for (int i = j + 1; i < 6; ++i) {
      double s = a(i, j);
      for (int k = 0; k < j; ++k) s -= a(i, k) * a(j, k);
      a(i, j) = s * inverse;
    }
  }
  return true;
}

// b := b L^-T, column by column: columns are contiguous.
void solve_right(const Matrix6& l, Matrix6& b) {
  for (int j = 0; j < 6; ++j) {
    for (int k = 0; k < j; ++k) b.col(j).noalias() -= l(j, k) * b.col(k);
    b.col(j) *= 1 / l(j, j);
  }
}

void solve_lower(const Matrix6& l, Vector6& x) {
  for (int j = 0; j < 6; ++j) {
    x[j] /= l(j, j);
    for (int i = j + 1; i < 6; ++i) x[i] -= l(i, j) * x[j];
  }
}

void solve_upper(const Matrix6& l, Vector6& x) {
  for (int j = 5; j >= 0; --j) {
    double s = x[j];
    for (int i = j + 1; i < 6; ++i) s -= l(i, j) * x[i];
    x[j] = s / l(j, j);
  }
}

void insert_sorted(std::vector<int>& v, int x) {
  const auto at = std::lower_bound(v.begin(), v.end(), x);
  if (at == v.end() || *at != x) v.insert(at, x);
}

}  // namespace

void BlockCholesky::analyse(int n, std::span<const std::pair<int, int>> edges) {
  if (n == n_ && std::equal(edges.begin(), edges.end(), edges_.begin(), edges_.end())) return;
  n_ = n;
  edges_.assign(edges.begin(), edges.end());
  if (static_cast<int>(neighbours_.size()) < n) neighbours_.resize(n);
  for (int i = 0; i < n; ++i) neighbours_[i].clear();
  for (const auto& [a, b] : edges_)
    insert_sorted(neighbours_[a], b), insert_sorted(neighbours_[b], a);
  order();
  lay_out();
}

// Minimum degree on the elimination graph; ties go to the lowest index, so that the order, and with
// it every rounding, depends on the graph alone.
void BlockCholesky::order() {
  order_.clear();
  position_.assign(n_, -1);
  for (int step = 0; step < n_; ++step) {
    int best = -1;
    for (int i = 0; i < n_; ++i)
      if (position_[i] < 0 && (best < 0 || neighbours_[i].size() < neighbours_[best].size()))
        best = i;
    position_[best] = step;
    order_.push_back(best);
    const std::vector<int>& clique = neighbours_[best];
    for (const int i : clique) {
      std::vector<int>& mine = neighbours_[i];
      mine.erase(std::lower_bound(mine.begin(), mine.end(), best));
      for (const int j : clique)
        if (j != i) insert_sorted(mine, j);
    }
  }
}

void BlockCholesky::lay_out() {
  column_start_.assign(1, 0);
  rows_.clear();
  for (int k = 0; k < n_; ++k) {
    std::vector<int>& column = neighbours_[order_[k]];
    for (int& i : column) i = position_[i];
    std::sort(column.begin(), column.end());
    rows_.insert(rows_.end(), column.begin(), column.end());
    column_start_.push_back(static_cast<int>(rows_.size()));
  }
  const auto block_at = [&](int row, int column) {
    const auto first = rows_.begin() + column_start_[column];
    const auto last = rows_.begin() + column_start_[column + 1];
    return static_cast<int>(std::lower_bound(first, last, row) - rows_.begin());
  };
  targets_.clear();
  for (int k = 0; k < n_; ++k)
    for (int q = column_start_[k]; q < column_start_[k + 1]; ++q)
      for (int p = q + 1; p < column_start_[k + 1]; ++p)
        targets_.push_back(block_at(rows_[p], rows_[q]));
  edge_block_.clear();
  for (const auto& [a, b] : edges_) {
    const int i = position_[a], j = position_[b];
    edge_block_.push_back(i > j ? block_at(i, j) : ~block_at(j, i));
  }
  diagonal_.resize(n_);
  blocks_.resize(rows_.size());
  work_.resize(n_);
}

void BlockCholesky::set_zero() {
  for (Matrix6& m : diagonal_) m.setZero();
  for (Matrix6& m : blocks_) m.setZero();
}

void BlockCholesky::add(int edge, const Matrix6& block) {
  const int at = edge_block_[edge];
  if (at >= 0)
    blocks_[at] += block;
  else
    blocks_[~at] += block.transpose();
}

bool BlockCholesky::factor() {
  const int* target = targets_.data();
  for (int k = 0; k < n_; ++k) {
    if (!cholesky(diagonal_[k])) return false;
    const int first = column_start_[k], last = column_start_[k + 1];
    for (int q = first; q < last; ++q) solve_right(diagonal_[k], blocks_[q]);
    for (int q = first; q < last; ++q) {
      diagonal_[rows_[q]].noalias() -= blocks_[q].lazyProduct(blocks_[q].transpose());
      for (int p = q + 1; p < last; ++p)
        blocks_[*target++].noalias() -= blocks_[p].lazyProduct(blocks_[q].transpose());
    }
  }
  return true;
}

void BlockCholesky::solve(std::span<Vector6> x) {
  for (int k = 0; k < n_; ++k) work_[k] = x[order_[k]];
  for (int k = 0; k < n_; ++k) {
    solve_lower(diagonal_[k], work_[k]);
    for (int q = column_start_[k]; q < column_start_[k + 1]; ++q)
      work_[rows_[q]].noalias() -= blocks_[q] * work_[k];
  }
  for (int k = n_ - 1; k >= 0; --k) {
    for (int q = column_start_[k]; q < column_start_[k + 1]; ++q)
      work_[k].noalias() -= blocks_[q].transpose() * work_[rows_[q]];
    solve_upper(diagonal_[k], work_[k]);
  }
  for (int k = 0; k < n_; ++k) x[order_[k]] = work_[k];
}

}  // namespace carom::contact
