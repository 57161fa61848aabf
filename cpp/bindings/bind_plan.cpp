// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "carom/step/plan.hpp"

#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;

void bind_plan(py::module_& m) {
  py::class_<Stage>(m, "PlannedStage", "One thing a step does, or does not do, and why.")
      .def_property_readonly("stage", [](const Stage& s) { return std::string(name_of(s.kind)); })
      .def_readonly("on", &Stage::on)
      .def_readonly("reason", &Stage::reason)
      .def_readonly("bodies", &Stage::bodies, "how many it concerns")
      .def("__repr__", [](const Stage& s) {
        return py::str("<PlannedStage {} {}: {}>")
            .format(std::string(name_of(s.kind)), s.on ? "on" : "off", s.reason);
      });
  py::class_<Plan>(m, "Plan", "Every stage there is, in the order a step runs them.")
      .def_readonly("stages", &Plan::stages, "those that are off too, with the reason")
      .def_property_readonly(
          "movers", [](const Plan& p) { return p.movers; }, "rows of the bodies that move")
      .def("__str__", &Plan::to_string);
  m.def(
      "compile", [](const Scene& scene) { return compile(scene); }, "scene"_a,
      "Decides what a step of this scene must do. Pure: same scene, same plan.");
}
