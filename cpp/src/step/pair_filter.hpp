// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "carom/broad/pairs.hpp"
#include "carom/scene/scene.hpp"

namespace carom {

/// Takes pairs out that the scene's groups and named pairs keep apart. Built with the plan; where
/// no body asks for it the pairs pass as they are, uncopied and unread.
class PairFilter {
 public:
  void build(const Scene& scene);
  [[nodiscard]] bool on() const { return !groups_.empty() || !never_.empty(); }
  /// Whether two rows may meet.
  [[nodiscard]] bool meet(int a, int b) const;
  /// Ascending in, ascending out; valid until the next call.
  [[nodiscard]] std::span<const BodyPair> operator()(std::span<const BodyPair> pairs);

 private:
  std::vector<std::uint32_t> groups_, meets_;  // by row; empty where all are as by default
  std::vector<BodyPair> never_;                // rows, ascending
  std::vector<BodyPair> kept_;
};

/// "groups of 3 bodies, 2 pairs that never meet"; empty where the scene filters nothing.
[[nodiscard]] std::string filters_of(const Scene& scene);

}  // namespace carom
