// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "carom/scene/scene.hpp"

namespace carom {

enum class StageKind {
  gravity,
  applied_wrench,
  drag,
  torsion,
  pairs,
  contacts,
  repulsion,
  solve,
  integrate,
  sweep
};

/// Lower-case name as printed: "gravity", "applied_wrench", ...
[[nodiscard]] std::string_view name_of(StageKind kind);

/// One thing a step does, or does not do, and why.
struct Stage {
  StageKind kind;
  bool on = false;
  std::string reason;
  int bodies = 0;  ///< how many it concerns
};

/// Every stage there is, in the order a step runs them; those that are off carry their reason too.
struct Plan {
  std::vector<Stage> stages;
  std::vector<int> movers;  ///< rows of the bodies that move

  [[nodiscard]] bool runs(StageKind kind) const;
  [[nodiscard]] std::string to_string() const;  ///< a table, one stage per line
};

/// Decides what a step of this scene must do; the only place that decides. Pure: same scene, same
/// plan.
/// @param wrench_requested  someone asked for a force or impulse in the next step
[[nodiscard]] Plan compile(const Scene& scene, bool wrench_requested = false);

}  // namespace carom
