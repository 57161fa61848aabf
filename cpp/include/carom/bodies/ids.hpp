// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <compare>
#include <cstdint>

namespace carom {

/// Names a body for its whole life and is never used again. The row of a body in the arrays is
/// another thing: rows close up when a body is removed.
struct BodyId {
  std::uint32_t value = 0;
  auto operator<=>(const BodyId&) const = default;
};

}  // namespace carom
