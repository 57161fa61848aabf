// SPDX-License-Identifier: Apache-2.0
// Flies one body, or a batch in lanes, for a given number of steps; prints nothing that matters.
// For callgrind: count_instructions.py takes the difference of two runs, so that only steps count.
//   rotation_steps symmetric_top 2000            rotation_steps symmetric_top 2000 64
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "carom/step/free_flight.hpp"
#include "carom/step/rotation.hpp"

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const carom::Integrator method = carom::integrator_named(argv[1]);
  const int steps = std::atoi(argv[2]), bodies = argc > 3 ? std::atoi(argv[3]) : 0;
  const double dt = 0.1 / 1.7320508075688772;
  if (bodies == 0) {
    carom::MassProperties body;
    body.mass = 1;
    body.inertia = Eigen::Vector3d(1, 2, 3).asDiagonal();
    const carom::FreeFlight f = carom::integrate_free(
        body, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Ones(), dt * steps, steps, method);
    std::printf("%g\n", f.orientation.w());
    return 0;
  }
  std::vector<double> x(bodies, 0.1), y(bodies, 0.2), z(bodies, 0.3), w(bodies, 0.9273618495495703);
  const std::vector<double> l1(bodies, 1), l2(bodies, 2), l3(bodies, 3);
  const std::vector<double> a1(bodies, 1), a2(bodies, 0.5), a3(bodies, 1.0 / 3);
  carom::RotationReport report;
  for (int i = 0; i < steps; ++i)
    carom::advance_rotation(method,
                            {x.data(), y.data(), z.data(), w.data(), l1.data(), l2.data(),
                             l3.data(), a1.data(), a2.data(), a3.data()},
                            0, bodies, dt, report);
  std::printf("%g\n", w[0]);
}
