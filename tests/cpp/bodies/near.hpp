// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>
#include <gtest/gtest.h>

namespace carom {

/// Whether two arrays agree to `tolerance` in every entry; prints the worst one.
template <class A, class B>
testing::AssertionResult near(const A& a, const B& b, double tolerance) {
  Eigen::Index row = 0, col = 0;
  const double worst = (a - b).cwiseAbs().maxCoeff(&row, &col);
  if (worst <= tolerance) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "entry (" << row << ", " << col << "): " << a(row, col) << " against " << b(row, col)
         << ", off by " << worst << ", allowed " << tolerance;
}

}  // namespace carom
