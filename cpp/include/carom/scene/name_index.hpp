// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "carom/bodies/ids.hpp"

namespace carom {

/// Ids by the hash of a name, so that looking one up costs the same among ten bodies and ten
/// thousand. The names stay where they are: a hash only proposes, the names themselves decide.
class NameIndex {
 public:
  void add(std::string_view name, BodyId id) { ids_.emplace(hash(name), id); }
  void remove(std::string_view name, BodyId id) {
    const auto [first, last] = ids_.equal_range(hash(name));
    for (auto it = first; it != last; ++it)
      if (it->second == id) {
        ids_.erase(it);
        return;
      }
  }
  void clear() { ids_.clear(); }
  [[nodiscard]] std::size_t size() const { return ids_.size(); }

  /// The first proposed id for which named(id) holds. @param looks  counts what is proposed
  template <class Named>
  [[nodiscard]] std::optional<BodyId> find(std::string_view name, Named named,
                                           std::int64_t& looks) const {
    const auto [first, last] = ids_.equal_range(hash(name));
    for (auto it = first; it != last; ++it) {
      ++looks;
      if (named(it->second)) return it->second;
    }
    return std::nullopt;
  }

 private:
  static std::size_t hash(std::string_view name) { return std::hash<std::string_view>{}(name); }

  std::unordered_multimap<std::size_t, BodyId> ids_;
};

}  // namespace carom
