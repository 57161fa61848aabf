// SPDX-License-Identifier: Apache-2.0
// One file binds one header, in the header's order; this one only calls them. Types come before the
// functions that name them, so that signatures and stubs show Python names.
#include "module.hpp"

#include <Eigen/Core>

namespace {

/// What an error report should name besides the version.
pybind11::dict build_info() {
  using namespace pybind11::literals;
  return pybind11::dict("version"_a = CAROM_VERSION,
                        "Eigen"_a = std::to_string(EIGEN_WORLD_VERSION) + '.' +
                                    std::to_string(EIGEN_MAJOR_VERSION) + '.' +
                                    std::to_string(EIGEN_MINOR_VERSION),
#if defined(__clang__)
                        "compiler"_a = "clang " __clang_version__,
#else
                        "compiler"_a = "g++ " __VERSION__,
#endif
                        "scalar"_a = "double");
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "The C++ core of carom. Import the package `carom`, not this module.";
  m.attr("__version__") = CAROM_VERSION;
  m.def("build_info", &build_info, "Version, Eigen, compiler and scalar of this build.");
  bind_errors(m);
  bind_shapes(m);
  bind_mass_properties(m);
  bind_mesh_diagnosis(m);
  bind_particles(m);
  bind_effects(m);
  bind_scene(m);
  bind_plan(m);
  bind_report(m);
  bind_pairs(m);
  bind_simulation(m);
  bind_free_flight(m);
  bind_ccd(m);
  bind_sweep(m);
  bind_broad(m);
}
