// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "carom/scene/effects.hpp"

#include "arguments.hpp"
#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;
using carom::python::ArrayLike;
using carom::python::vector3;

namespace {

template <class T>
T checked(T effect, const char* name) {
  require_valid(Effect(effect), name);
  return effect;
}

}  // namespace

// Effects are read-only values: a scene checks them as they go in, and to change one is to replace
// it there.
void bind_effects(py::module_& m) {
  const ArrayLike zero{py::make_tuple(0.0, 0.0, 0.0)};

  py::class_<UniformGravity>(m, "UniformGravity",
                             "Constant acceleration of every moving body; energy -m g . x.")
      .def(py::init([](const ArrayLike& acceleration) {
             return checked(UniformGravity{vector3(acceleration, "UniformGravity.acceleration")},
                            "UniformGravity");
           }),
           py::arg_v("acceleration", ArrayLike{py::make_tuple(0.0, 0.0, -9.81)}, "(0, 0, -9.81)"),
           "acceleration: (3,) m/s^2, world axes.")
      .def_property_readonly(
          "acceleration", [](const UniformGravity& g) { return g.acceleration; },
          "(3,) m/s^2, world axes")
      .def("__repr__", [](const UniformGravity& g) {
        return py::str("UniformGravity(acceleration=[{!r}, {!r}, {!r}])")
            .format(g.acceleration.x(), g.acceleration.y(), g.acceleration.z());
      });

  py::class_<AppliedWrench>(m, "AppliedWrench",
                            "Force and torque held on one body; its power is booked as work.")
      .def(py::init([](BodyId body, const ArrayLike& force, const ArrayLike& torque,
                       const ArrayLike& point_b, bool in_body_axes, double until) {
             return checked(AppliedWrench{.body = body,
                                          .force = vector3(force, "AppliedWrench.force"),
                                          .torque = vector3(torque, "AppliedWrench.torque"),
                                          .point_b = vector3(point_b, "AppliedWrench.point_b"),
                                          .in_body_axes = in_body_axes,
                                          .until = until},
                            "AppliedWrench");
           }),
           "body"_a, py::arg_v("force", zero, "(0, 0, 0)"), py::arg_v("torque", zero, "(0, 0, 0)"),
           py::kw_only(), py::arg_v("point_b", zero, "(0, 0, 0)"), "in_body_axes"_a = false,
           py::arg_v("until", std::numeric_limits<double>::infinity(), "float('inf')"),
           "body: id; force: (3,) N; torque: (3,) N m; point_b: (3,) m from the centre of mass, "
           "body\n"
           "axes; in_body_axes: force and torque turn with the body; until: s of simulated time.")
      .def_readonly("body", &AppliedWrench::body, "id")
      .def_property_readonly(
          "force", [](const AppliedWrench& w) { return w.force; }, "(3,) N")
      .def_property_readonly(
          "torque", [](const AppliedWrench& w) { return w.torque; }, "(3,) N m")
      .def_property_readonly(
          "point_b", [](const AppliedWrench& w) { return w.point_b; }, "(3,) m")
      .def_readonly("in_body_axes", &AppliedWrench::in_body_axes)
      .def_readonly("until", &AppliedWrench::until, "s of simulated time")
      .def("__repr__", [](const AppliedWrench& w) {
        return py::str(
                   "AppliedWrench(body={}, force={}, torque={}, point_b={}, in_body_axes={}, "
                   "until={!r})")
            .format(w.body, py::cast(w.force).attr("tolist")(), py::cast(w.torque).attr("tolist")(),
                    py::cast(w.point_b).attr("tolist")(), w.in_body_axes, w.until);
      });

  py::class_<LinearDrag>(
      m, "LinearDrag",
      "Resistance of the air to motion relative to it: F = -coefficient (v -\n"
      "wind), T = -angular_coefficient omega; solved exactly, so never too stiff.")
      .def(py::init([](double coefficient, const ArrayLike& wind, double angular_coefficient,
                       std::optional<BodyId> body) {
             return checked(LinearDrag{.coefficient = coefficient,
                                       .angular_coefficient = angular_coefficient,
                                       .wind = vector3(wind, "LinearDrag.wind"),
                                       .body = body},
                            "LinearDrag");
           }),
           "coefficient"_a, py::arg_v("wind", zero, "(0, 0, 0)"), py::kw_only(),
           "angular_coefficient"_a = 0.0, "body"_a = py::none(),
           "coefficient: kg/s; wind: (3,) m/s, world axes; angular_coefficient: N m s; body: id,\n"
           "every moving body where none is named.")
      .def_readonly("coefficient", &LinearDrag::coefficient, "kg/s")
      .def_readonly("angular_coefficient", &LinearDrag::angular_coefficient, "N m s")
      .def_property_readonly(
          "wind", [](const LinearDrag& d) { return d.wind; }, "(3,) m/s, world axes")
      .def_readonly("body", &LinearDrag::body, "id, or None for every moving body")
      .def("__repr__", [](const LinearDrag& d) {
        return py::str("LinearDrag(coefficient={!r}, wind={}, angular_coefficient={!r}, body={})")
            .format(d.coefficient, py::cast(d.wind).attr("tolist")(), d.angular_coefficient,
                    py::cast(d.body));
      });

  py::class_<TorsionSpring>(m, "TorsionSpring",
                            "Spring that turns a body back to `rest`: T = -stiffness theta -\n"
                            "damping omega; energy stiffness |theta|^2 / 2.")
      .def(py::init([](BodyId body, double stiffness, double damping, const Eigen::Vector4d& rest) {
             return checked(TorsionSpring{.body = body,
                                          .stiffness = stiffness,
                                          .damping = damping,
                                          .rest = Eigen::Quaterniond(rest)},
                            "TorsionSpring");
           }),
           "body"_a, "stiffness"_a, "damping"_a = 0.0, py::kw_only(),
           py::arg_v("rest", Eigen::Vector4d(0, 0, 0, 1), "(0, 0, 0, 1)"),
           "body: id; stiffness: N m/rad; damping: N m s; rest: (4,) x y z w, body frame to world.")
      .def_readonly("body", &TorsionSpring::body, "id")
      .def_readonly("stiffness", &TorsionSpring::stiffness, "N m/rad")
      .def_readonly("damping", &TorsionSpring::damping, "N m s")
      .def_property_readonly(
          "rest", [](const TorsionSpring& s) { return Eigen::Vector4d(s.rest.coeffs()); },
          "(4,) x y z w, body frame to world")
      .def("__repr__", [](const TorsionSpring& s) {
        return py::str("TorsionSpring(body={}, stiffness={!r}, damping={!r}, rest={})")
            .format(s.body, s.stiffness, s.damping,
                    py::cast(Eigen::Vector4d(s.rest.coeffs())).attr("tolist")());
      });

  py::class_<Repulsion>(m, "Repulsion",
                        "The lecture's way out of overlap: speed depth / dt along the normal. It\n"
                        "puts energy in: see Energy.repulsion and Report.repulsion.")
      .def(py::init([](bool bounded, double cap, bool interior_normals) {
             return checked(Repulsion{bounded, cap, interior_normals}, "Repulsion");
           }),
           "bounded"_a = true, "cap"_a = Repulsion{}.cap, "interior_normals"_a = true,
           "bounded: give a point only what it lacks of that speed, and never more than leaves it "
           "at\n"
           "cap, m/s, > 0; interior_normals: take the normals of particles inside distance grids "
           "from\n"
           "the chain gradient, swept hit, velocity.")
      .def_readonly("bounded", &Repulsion::bounded)
      .def_readonly("cap", &Repulsion::cap, "m/s")
      .def_readonly("interior_normals", &Repulsion::interior_normals)
      .def("__repr__", [](const Repulsion& r) {
        return py::str("Repulsion(bounded={}, cap={!r}, interior_normals={})")
            .format(r.bounded, r.cap, r.interior_normals);
      });

  py::class_<EffectInfo>(m, "EffectInfo", "What there is to know of a kind of effect.")
      .def_property_readonly(
          "name", [](const EffectInfo& i) { return std::string(i.name); }, "as in scene files")
      .def_property_readonly(
          "stage", [](const EffectInfo& i) { return std::string(i.stage); }, "of the plan")
      .def_property_readonly(
          "formula", [](const EffectInfo& i) { return std::string(i.formula); }, "of the force")
      .def_property_readonly(
          "energy", [](const EffectInfo& i) { return std::string(i.energy); },
          "potential energy or power")
      .def_property_readonly(
          "units", [](const EffectInfo& i) { return std::string(i.units); }, "of the parameters")
      .def("__repr__",
           [](const EffectInfo& i) { return "<EffectInfo " + std::string(i.name) + ">"; });
  m.def(
      "effects_table",
      [] {
        const auto table = effects_table();
        return std::vector<EffectInfo>(table.begin(), table.end());
      },
      "Every effect there is: name, stage, formula, energy or power, units.");
}
