// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <compare>

namespace carom {

/// Two bodies whose boxes overlap.
struct BodyPair {
  int a = 0, b = 0;  ///< rows, a < b
  auto operator<=>(const BodyPair&) const = default;
};

}  // namespace carom
