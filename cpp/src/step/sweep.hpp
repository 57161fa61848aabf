// SPDX-License-Identifier: Apache-2.0
// What the sweep keeps: the paths of the step under way and the hits still to come on them.
#pragma once
#include <cstdint>
#include <vector>

#include "carom/broad/pairs.hpp"
#include "carom/narrow/body_path.hpp"
#include "carom/narrow/contacts.hpp"
#include "carom/narrow/first_contact.hpp"
#include "carom/scene/scene.hpp"
#include "carom/state/report.hpp"

#include "contact/impacts.hpp"
#include "step/verify.hpp"

namespace carom {

struct World;

/// A meeting of two paths. Stale once either body was hit since: then its version is another.
struct SweepEvent {
  FirstContact contact;
  int a = 0, b = 0;
  int version_a = 0, version_b = 0;

  /// Later comes first out of a heap; rows decide between equals, so every run has one order.
  bool operator<(const SweepEvent& other) const {
    if (contact.time != other.contact.time) return contact.time > other.contact.time;
    return a != other.a ? a > other.a : b > other.b;
  }
};

struct SweepWork {
  std::vector<double> thickness;       ///< m, by row: inner radius; refreshed with the plan
  std::vector<double> turning_radius;  ///< m, by row: what a turn moves, about the centre of mass
  std::vector<double> radius;          ///< m, by row: that holds it, about the centre of mass
  std::vector<Ccd> ccd;                ///< by row: beside each other, unlike those of the scene
  bool has_thin = false;             ///< something that stands is thinner than something that moves
  std::vector<std::uint8_t> fast;    ///< by row: swept in this step
  std::vector<BodyPair> left, kept;  ///< near pairs whose contacts the sweep, or the solver, takes
  std::vector<BodyPair> free;        ///< of those kept, what is apart and would bounce
  Array3 position_before;            ///< where the step began
  Array4 orientation_before;
  std::vector<BodyPath> paths;      ///< by row, of this step
  std::vector<std::uint8_t> laid;   ///< by row: its path is known
  Array3 pull;                      ///< m/s^2, by row: what acts on it once nothing holds it
  Array3 torque;                    ///< N m, by row: rate of the angular momentum over the step
  std::vector<std::uint8_t> waits;  ///< by row: stays where it is until the step ends
  /// By row, empty where none: waited in the step before. Part of a saved state.
  std::vector<std::uint8_t> waited;
  /// By row: the only one it hit in this step; its own row where none, -1 where several.
  std::vector<int> met_only;
  std::vector<int> version, hits;  ///< by row
  std::vector<BodyPair> near_pairs;
  int ahead = 0;                    ///< rows whose way stands in the tree of the pair stage
  std::vector<int> strayed;         ///< rows whose path left the box it has in that tree
  std::vector<std::uint8_t> boxed;  ///< by row: its box below is known
  std::vector<Aabb> boxes;          ///< of the paths; in the pair stage, of what is near
  std::vector<int> met;             ///< scratch of queries
  std::vector<SweepEvent> events;   ///< a heap
  std::vector<TrailPiece> trail;    ///< ways of the step, kept only to verify it
  contact::BodyFrames frames;
  contact::Impacts impacts;
  std::vector<Manifold> manifolds;
  std::vector<Contact> contacts;
  std::vector<contact::Patch> patches;
};

/// How a body moves in a step or the rest of it.
struct Motion {
  Eigen::Vector3d centre;  ///< m
  Eigen::Vector3d way;     ///< m
  Eigen::Vector3d turn;    ///< rad
};

/// Whether two bodies move against each other by more than the thinner one's thickness allows. What
/// they share does not count: a heap that falls as one is no case for the sweep.
[[nodiscard]] bool is_fast(const World& world, int a, int b, const Motion& of_a,
                           const Motion& of_b);

/// Whether the turn of one against the other may carry corners that no contact knows of through the
/// thinner of the two, standing ones included: a sheet has no inside from which to push them back.
[[nodiscard]] bool turns_through(const World& world, int a, int b, const Eigen::Vector3d& turn_a,
                                 const Eigen::Vector3d& turn_b);
/// Marks as fast what the solver has turned like that. True when there is any.
bool mark_turned(World& world);

/// Whether the direction of the solver's contacts parts two convex bodies from time t of their
/// paths to the end of the step, but for an overlap that their thickness allows: then neither can
/// have gone through the other, however fast they slide or turn.
[[nodiscard]] bool stays_apart(const World& world, int a, int b, double t);

/// Bodies whose motion in this step the pair stage did not foresee, as contacts pushed them farther
/// than their box there allows, stand in its tree with the way they took.
void foresee(World& world);
/// Asks about every two of which one is fast, and whose ways may cross.
void ask_all(World& world);
/// Asks again, from time t, about everything a body with a new path may meet;
/// `done` was asked already.
void ask_about(World& world, int row, int done, double t);

/// No path is known yet.
void begin_paths(World& world);
/// Path of one body from its states before and after the integration, where it is not known.
void need_path(World& world, int row);
/// Path of one body from time t on, from its state there: position, orientation, velocity,
/// momentum. Leaves in the states where it ends.
void lay_path(World& world, int row, double t, const Eigen::Vector3d& acceleration);
/// Puts the states of a row to time t of its path.
void go_to(World& world, int row, double t);
/// Stops a body where it is at time t, until the step ends; it keeps its velocity.
void wait_at(World& world, int row, double t);
/// Takes from a body that jams a share of its speed, unless it is fully elastic; from two that jam
/// against each other alone, of what they do against each other: their momentum stays.
void calm(World& world, int row);
void calm_together(World& world, int a, int b);
/// Box of all that a body may touch on a parabola between two places of its centre of mass that
/// ends at the velocity of the states.
[[nodiscard]] Aabb path_box(const World& world, int row, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to);
/// Box of the rest of a path, or of the whole of one that is not known.
[[nodiscard]] Aabb path_bounds(const World& world, int row);

/// Resolves a hit: both bodies at its time, impulses with friction and restitution, new paths.
void strike(World& world, const SweepEvent& event);

}  // namespace carom
