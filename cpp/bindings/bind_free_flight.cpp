// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "carom/step/free_flight.hpp"

#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;

void bind_free_flight(py::module_& m) {
  py::tuple methods(carom::METHODS.size());
  for (std::size_t i = 0; i < carom::METHODS.size(); ++i)
    methods[i] = py::str(std::string(carom::METHODS[i]));
  m.attr("METHODS") = methods;

  // Wrapped in Python: carom.integrate_free names and documents the result.
  m.def(
      "integrate_free",
      [](const carom::MassProperties& body, const Eigen::Vector4d& orientation,
         const Eigen::Vector3d& angular_velocity, double seconds, std::int64_t steps,
         const std::string& method, std::optional<double> tolerance) {
        const carom::Integrator integrator = carom::integrator_named(method);
        carom::FreeFlight flight;
        {
          const py::gil_scoped_release release;
          flight = carom::integrate_free(body, Eigen::Quaterniond(orientation), angular_velocity,
                                         seconds, steps, integrator, tolerance);
        }
        return py::make_tuple(Eigen::Vector4d(flight.orientation.coeffs()), flight.angular_velocity,
                              std::string(carom::name_of(flight.status)), flight.error,
                              flight.steps);
      },
      "mass_properties"_a, "orientation"_a, "angular_velocity"_a, "seconds"_a, "steps"_a,
      "method"_a, "tolerance"_a);
}
