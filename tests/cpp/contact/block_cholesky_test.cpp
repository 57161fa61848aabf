// SPDX-License-Identifier: Apache-2.0
#include "contact/block_cholesky.hpp"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace carom::contact {
namespace {

struct Graph {
  const char* name;
  int n;
  std::vector<std::pair<int, int>> edges;
};

Graph chain(int n) {
  Graph g{"chain", n, {}};
  for (int i = 0; i + 1 < n; ++i) g.edges.emplace_back(i + 1, i);
  return g;
}

Graph tangle(int n) {
  Graph g{"tangle", n, {}};
  std::mt19937 random(3);
  for (int i = 1; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      const int j = static_cast<int>(random() % i);
      g.edges.emplace_back(k % 2 ? i : j, k % 2 ? j : i);  // repeats and both directions
    }
  return g;
}

// Against Eigen's dense factorisation of the same matrix.
TEST(BlockCholesky, SolvesWhatTheDenseFactorSolves) {
  for (const Graph& g : {chain(1), chain(2), chain(30), tangle(25)}) {
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    BlockCholesky sparse;
    sparse.analyse(g.n, g.edges);
    sparse.set_zero();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6 * g.n, 6 * g.n);
    const auto noise = [&] {
      Matrix6 m;
      for (int i = 0; i < 36; ++i) m(i) = normal(random);
      return m;
    };
    for (int i = 0; i < g.n; ++i) {
      const Matrix6 m = noise();
      const Matrix6 d = m * m.transpose() + Matrix6::Identity();
      sparse.diagonal(i) += d;
      dense.block<6, 6>(6 * i, 6 * i) += d;
    }
    for (int e = 0; e < static_cast<int>(g.edges.size()); ++e) {
      const auto [a, b] = g.edges[e];
      const Matrix6 x = noise(), y = noise();  // [x; y][x; y]^T keeps the whole positive
      sparse.diagonal(a) += x * x.transpose();
      sparse.diagonal(b) += y * y.transpose();
      sparse.add(e, x * y.transpose());
      dense.block<6, 6>(6 * a, 6 * a) += x * x.transpose();
      dense.block<6, 6>(6 * b, 6 * b) += y * y.transpose();
      dense.block<6, 6>(6 * a, 6 * b) += x * y.transpose();
      dense.block<6, 6>(6 * b, 6 * a) += y * x.transpose();
    }
    Eigen::VectorXd right(6 * g.n);
    std::vector<Vector6> x(g.n);
    for (int i = 0; i < 6 * g.n; ++i) x[i / 6][i % 6] = right[i] = normal(random);
    ASSERT_TRUE(sparse.factor()) << g.name;
    sparse.solve(x);
    const Eigen::VectorXd truth = dense.llt().solve(right);
    Eigen::VectorXd mine(6 * g.n);
    for (int i = 0; i < 6 * g.n; ++i) mine[i] = x[i / 6][i % 6];
    // Both are backward stable: the error is u times the condition number, here below 1e5.
    EXPECT_LT((mine - truth).norm(), 1e-10 * truth.norm()) << g.name << ' ' << g.n;
  }
}

TEST(BlockCholesky, RefusesWhatIsNotPositive) {
  BlockCholesky sparse;
  sparse.analyse(1, {});
  sparse.set_zero();
  sparse.diagonal(0).diagonal() << 1, 1, 1, -1, 1, 1;
  EXPECT_FALSE(sparse.factor());
  sparse.diagonal(0).setConstant(std::nan(""));
  EXPECT_FALSE(sparse.factor());
}

}  // namespace
}  // namespace carom::contact
