// SPDX-License-Identifier: Apache-2.0
// The narrow phase on settled piles, one thread: which share of the pairs skips it, and what one of
// the others costs. `contact_pairs_bench [bodies = 1000]` prints a table. (Every pair of shapes:
// `carom cost --study pairs`.)
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <vector>

#include "carom/broad/box_tree.hpp"
#include "carom/narrow/contacts.hpp"
#include "carom/numerics/tolerance.hpp"
#include "carom/step/simulation.hpp"

#include "../src/contact/manifold_cache.hpp"

using namespace carom;
using Eigen::Vector3d;

namespace {

double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Bodies dropped into a square pit as the peers' driver does, cells of 1.1 m with some disorder.
Scene pile(int bodies, const Shape& shape) {
  Scene scene;
  scene.add({.name = "ground", .shape = Plane{}, .is_static = true});
  const double wide = 6;
  for (int side = 0; side < 4; ++side) {
    const double angle = side * 1.5707963267948966;
    const Vector3d out(std::cos(angle), std::sin(angle), 0);
    scene.add({.shape = Plane{-out, -wide}, .is_static = true});
  }
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> jitter(-0.05, 0.05);
  for (int i = 0; i < bodies; ++i) {
    const double x = jitter(random), y = jitter(random);
    scene.add({.shape = shape,
               .pose = {.position = {1.1 * (i % 10) - 4.95 + x, 1.1 * (i / 10 % 10) - 4.95 + y,
                                     0.6 + 1.1 * (i / 100)}}});
  }
  scene.effects.emplace_back(UniformGravity{{0, 0, -9.81}});
  return scene;
}

struct Measured {
  double skipped = 0;      // share of the pairs, over a second of steps
  double nanoseconds = 0;  // of one collide() of a pair of movers, least of ten passes
  std::size_t pairs = 0;   // of movers, at the end
};

Measured measure(int bodies, const Shape& shape, double settle) {
  Simulation simulation(pile(bodies, shape));
  simulation.advance(settle);
  BoxTree tree;
  contact::ManifoldCache cache;
  std::vector<Aabb> boxes(simulation.size());
  std::vector<Manifold> out;
  const double radius = bounding_radius(shape);
  long asked = 0, kept = 0;
  for (int step = 0; step < 61; ++step) {
    const BodyStates& s = simulation.states();
    std::vector<double> reach(s.size(), 0);
    for (int i = 0; i < s.size(); ++i) {
      if (s.moves[i])
        reach[i] = simulation.dt() * (s.velocity[i].norm() + s.angular_velocity(i).norm() * radius);
      boxes[i] = bounds(simulation.scene().bodies[i].shape, s.pose(i))
                     .inflated(0.5 * tolerance::contact_margin + reach[i]);
    }
    const std::vector<contact::ManifoldCache::Pair> before = cache.pairs;
    cache.begin_step();
    for (const BodyPair& p : tree.update(boxes, s.moves)) {
      out.clear();
      const Frame at_a(s.pose(p.a)), at_b(s.pose(p.b));
      const bool ball = std::holds_alternative<Sphere>(shape);
      const Shape &of_a = simulation.scene().bodies[p.a].shape,
                  &of_b = simulation.scene().bodies[p.b].shape;
      cache.collide(p.a, p.b, {of_a, at_a, s.pose(p.a).orientation, ball},
                    {of_b, at_b, s.pose(p.b).orientation, ball},
                    tolerance::contact_margin + reach[p.a] + reach[p.b], radius, out);
    }
    if (step > 0)  // what was carried along keeps the pose it was found at
      for (const auto& now : cache.pairs) {
        const auto old = std::lower_bound(
            before.begin(), before.end(), now,
            [](const auto& l, const auto& r) { return std::pair(l.a, l.b) < std::pair(r.a, r.b); });
        ++asked;
        kept += old != before.end() && old->a == now.a && old->b == now.b &&
                old->offset == now.offset && old->rotation == now.rotation;
      }
    simulation.step();
  }
  std::vector<BodyPair> movers;
  for (const BodyPair& p : tree.pairs())
    if (simulation.states().moves[p.a] && simulation.states().moves[p.b]) movers.push_back(p);
  double least = 1e9;
  for (int pass = 0; pass < 10; ++pass) {
    const double start = cpu_seconds();
    for (const BodyPair& p : movers) {
      out.clear();
      collide(shape, simulation.states().pose(p.a), shape, simulation.states().pose(p.b),
              tolerance::contact_margin, out);
    }
    least = std::min(least, cpu_seconds() - start);
  }
  return {asked ? static_cast<double>(kept) / static_cast<double>(asked) : 0.0,
          1e9 * least / static_cast<double>(movers.size()), movers.size()};
}

}  // namespace

int main(int count, char** arguments) {
  const int bodies = count > 1 ? std::atoi(arguments[1]) : 1000;
  const Measured boxes = measure(bodies, Box{}, 8), balls = measure(bodies, Sphere{0.5}, 8);
  std::printf("| settled pile of %d | pairs of movers | skip the narrow phase | one pair, ns |\n",
              bodies);
  std::printf("|---|---|---|---|\n");
  std::printf("| boxes | %zu | %.1f %% | %.0f |\n", boxes.pairs, 100 * boxes.skipped,
              boxes.nanoseconds);
  std::printf("| spheres | %zu | found again each step | %.0f |\n", balls.pairs, balls.nanoseconds);
}
