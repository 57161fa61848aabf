// SPDX-License-Identifier: Apache-2.0
#include "step/pair_filter.hpp"

#include <algorithm>
#include <string>

namespace carom {
namespace {

bool asks(const Scene::Body& body) {
  return body.groups != BodyDefinition{}.groups || body.meets != BodyDefinition{}.meets;
}

}  // namespace

void PairFilter::build(const Scene& scene) {
  groups_.clear(), meets_.clear(), never_.clear();
  if (std::ranges::any_of(scene.bodies, asks))
    for (const Scene::Body& body : scene.bodies) {
      groups_.push_back(body.groups);
      meets_.push_back(body.meets);
    }
  // Ids ascend with rows, so the order stays.
  for (const auto& [a, b] : scene.never) never_.push_back({*scene.row(a), *scene.row(b)});
}

bool PairFilter::meet(int a, int b) const {
  if (!groups_.empty() && !((groups_[a] & meets_[b]) && (groups_[b] & meets_[a]))) return false;
  return !std::ranges::binary_search(never_, BodyPair{std::min(a, b), std::max(a, b)});
}

std::span<const BodyPair> PairFilter::operator()(std::span<const BodyPair> pairs) {
  if (!on()) return pairs;
  kept_.clear();
  for (const BodyPair& pair : pairs)
    if (meet(pair.a, pair.b)) kept_.push_back(pair);
  return kept_;
}

std::string filters_of(const Scene& scene) {
  const auto counted = [](std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + ' ' + (n == 1 ? one : many);
  };
  const auto asking = static_cast<std::size_t>(std::ranges::count_if(scene.bodies, asks));
  std::string out;
  if (asking) out = "groups of " + counted(asking, "body", "bodies");
  if (!scene.never.empty())
    out += (out.empty() ? "" : ", ") + counted(scene.never.size(), "pair", "pairs") +
           " that never meet";
  return out;
}

}  // namespace carom
