// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "carom/bodies/ids.hpp"
#include "carom/bodies/mass_properties.hpp"
#include "carom/geometry/shape.hpp"
#include "carom/scene/effects.hpp"
#include "carom/scene/name_index.hpp"

namespace carom {

/// When a body is followed along its path, so that it meets what lies between two steps.
enum class Ccd : std::uint8_t {
  automatic,  ///< in steps that move it farther than its own thickness allows
  always,     ///< in every step that moves it
  never       ///< it may pass through things when it is fast
};

/// One body as the scene describes it. Mass: give at most one of mass, density and mass_properties.
struct BodyDefinition {
  std::string name{};  ///< [A-Za-z][A-Za-z0-9_]*, unique; empty: "body_<id>"
  Shape shape{};
  bool is_static = false;
  std::optional<double> mass{};                        ///< kg, spread evenly over the shape
  std::optional<double> density{};                     ///< kg/m^3; 1000 where nothing is given
  std::optional<MassProperties> mass_properties{};     ///< in the body frame
  Pose pose{};                                         ///< of the body frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, of the body frame's origin
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< rad/s, world axes
  double friction = 0.5;                                       ///< a pair uses sqrt(mu1 mu2)
  double restitution = 0.0;                                    ///< 0 to 1; a pair uses the larger
  /// m: the torque that resists rolling, or spinning about the normal, is at most this times the
  /// normal force; a pair uses the larger. 0: no such rows exist.
  double rolling_resistance = 0.0;
  double spinning_resistance = 0.0;
  Ccd ccd = Ccd::automatic;
  /// Bits of the groups the body belongs to, and of those it meets. Two bodies meet where each
  /// belongs to a group that the other meets; `meets` 0: a ghost, which nothing touches.
  std::uint32_t groups = 1;
  std::uint32_t meets = 0xffffffff;
};

/// The body's mass properties by whichever way it gives them. Zero mass for a static body.
/// @throws InvalidInput naming body and field
[[nodiscard]] MassProperties mass_properties(const BodyDefinition& body);

/// Everything a simulation is told: plain data, no behaviour but checking what is put in.
struct Scene {
  /// A body once it is checked and named.
  struct Body : BodyDefinition {
    BodyId id;
    MassProperties properties;  ///< in the body frame; zero for a static body
  };
  std::vector<Body> bodies;
  std::vector<Effect> effects;
  /// Pairs that never meet, the lower id first, ascending; see never_meet.
  std::vector<std::pair<BodyId, BodyId>> never;

  /// Checks and appends. @throws InvalidInput naming the body, the field and the rule; the scene is
  /// then unchanged
  BodyId add(BodyDefinition body);
  /// Lets two bodies pass through each other, whatever their groups. Saying it twice is once.
  /// @throws InvalidInput for a body that is not in the scene, a body and itself, or two static
  /// ones
  void never_meet(BodyId a, BodyId b);
  /// Ids are never used again. @throws InvalidInput when there is no such body
  void remove(BodyId id);
  /// O(1) for a name that is there, O(n) for one that is not.
  [[nodiscard]] std::optional<BodyId> find(std::string_view name) const;
  /// Row of the body now, or nothing. O(log n): ids ascend with rows.
  [[nodiscard]] std::optional<int> row(BodyId id) const;

  /// Names that add() has compared so far to keep them unique: none unless hashes coincide.
  [[nodiscard]] std::int64_t names_compared() const { return names_compared_; }

 private:
  [[nodiscard]] std::optional<BodyId> find_indexed(std::string_view name,
                                                   std::int64_t& compared) const;

  NameIndex names_;  // beside `bodies`, which stay plain: made anew by add() when they differ
  std::int64_t names_compared_ = 0;
  std::uint32_t next_id_ = 0;
};

}  // namespace carom
