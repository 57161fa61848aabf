// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "carom/geometry/frame.hpp"
#include "carom/geometry/shape.hpp"
#include "carom/narrow/contacts.hpp"

namespace carom::contact {

/// Manifolds of the last step, so that pairs which hardly moved against each other need no narrow
/// phase: in a settled pile nearly all of them. Their points keep their places on both bodies, and
/// their gaps are measured between these.
///
/// Pairs must be asked for in ascending order, each once per step. The kept arrays hold plain
/// numbers: they are part of a saved state, since what is recycled depends on the past.
class ManifoldCache {
 public:
  struct Pair {
    int a = 0, b = 0;
    std::array<double, 3> offset{};    ///< m, of b in a's frame when the manifold was found
    std::array<double, 4> rotation{};  ///< x y z w, of b in a's frame
    double margin = 0;                 ///< m
    int first = 0, count = 0;          ///< points
  };
  struct Point {
    std::array<double, 3> on_a{}, on_b{};  ///< m, body frames
    std::array<double, 3> normal_a{};      ///< in a's frame
    std::uint32_t feature = 0;
    int patch = 0;
  };
  std::vector<Pair> pairs;
  std::vector<Point> points;

  void begin_step();
  void clear();
  /// A shape where it is, as a matrix and as a quaternion.
  struct Placed {
    const Shape& shape;
    const Frame& frame;
    const Eigen::Quaterniond& orientation;
    bool is_ball;
  };
  /// Appends the pair's manifolds to `out`, found again or carried along. `reach`: m, length of the
  /// smaller body, to which the motion that is let pass is proportional.
  void collide(int a, int b, const Placed& in_a, const Placed& in_b, double margin, double reach,
               std::vector<Manifold>& out);

 private:
  bool carry(const Pair& before, const Frame& frame_a, const Frame& frame_b,
             const Eigen::Vector3d& offset, const Eigen::Quaterniond& rotation, double margin,
             double reach, std::vector<Manifold>& out);

  std::vector<Pair> pairs_before_;
  std::vector<Point> points_before_;
  std::size_t next_ = 0;
};

}  // namespace carom::contact
