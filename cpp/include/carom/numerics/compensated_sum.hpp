// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

namespace carom {

/// Running sum that carries its rounding error: wrong by 2u of the sum plus n^2 u^2 of the sizes of
/// the terms, in any order. Source: A. Neumaier, ZAMM 54, 1974.
struct CompensatedSum {
  double sum = 0.0;
  double carry = 0.0;

  CompensatedSum& operator+=(double term) {
    const double s = sum + term;
    carry += std::abs(sum) >= std::abs(term) ? (sum - s) + term : (term - s) + sum;
    sum = s;
    return *this;
  }
  [[nodiscard]] double value() const { return sum + carry; }
};

}  // namespace carom
