// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <memory>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/step/simulation.hpp"

#include "body_arguments.hpp"
#include "module.hpp"
#include "shared_simulation.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;
using carom::python::ArrayLike;
using carom::python::BodyLike;
using carom::python::vector3;

/// What plan() returns; the caster below gives signatures and stubs the type of its entries.
struct StageList {
  py::list value;
};

template <>
struct pybind11::detail::type_caster<StageList> {
  PYBIND11_TYPE_CASTER(StageList, const_name("list[carom.plan.Stage]"));
  static handle cast(StageList stages, return_value_policy, handle) {
    return stages.value.release();
  }
};

namespace {

using python::Shared;
using Class = py::class_<Shared>;

/// One row of contacts(), laid out as numpy reads it.
struct ContactRow {
  std::int32_t a, b;
  double position[3], normal[3], separation, impulse[3], friction, restitution;
};

py::array_t<double> rows_of(const Array3& array) {
  const auto n = static_cast<py::ssize_t>(array.x.size());
  py::array_t<double> out({n, py::ssize_t{3}});
  double* to = out.mutable_data();
  for (std::size_t i = 0; i < array.x.size(); ++i)
    *to++ = array.x[i], *to++ = array.y[i], *to++ = array.z[i];
  return out;
}

template <int Width, class Fill>
py::array_t<double> filled(const Simulation& s, Fill fill) {
  py::array_t<double> out({py::ssize_t{s.size()}, py::ssize_t{Width}});
  fill(std::span<double>(out.mutable_data(), static_cast<std::size_t>(out.size())));
  return out;
}

SolverChoice solver_named(const std::string& name) {
  if (name == "automatic") return SolverChoice::automatic;
  if (name == "small_steps") return SolverChoice::small_steps;
  if (name == "direct") return SolverChoice::direct;
  throw InvalidInput("contact_solver", name, "must be automatic, small_steps or direct");
}

void bind_stepping(Class& cls) {
  cls.def(py::init([](const Scene& scene, double dt, const std::string& integrator,
                      const std::string& contact_solver, double contact_tolerance, int substeps,
                      double sleep_after, bool verify, int threads) {
            SimulationOptions options{.dt = dt, .integrator = integrator_named(integrator)};
            options.contact.choice = solver_named(contact_solver);
            options.contact.tolerance = contact_tolerance;
            options.contact.substeps = substeps;
            options.sleep_after = sleep_after;
            options.verify = verify;
            options.threads = threads;
            return std::make_unique<Shared>(scene, options);
          }),
          "scene"_a, "dt"_a = SimulationOptions{}.dt,
          "integrator"_a = std::string(name_of(SimulationOptions{}.integrator)), py::kw_only(),
          "contact_solver"_a = "automatic", "contact_tolerance"_a = SolverOptions{}.tolerance,
          "substeps"_a = 0, "sleep_after"_a = SimulationOptions{}.sleep_after, "verify"_a = false,
          "threads"_a = SimulationOptions{}.threads,
          "scene: copied, so later changes to it do not reach the simulation; dt: s, > 0, the\n"
          "largest step taken; integrator: of rotations, one of METHODS; contact_solver:\n"
          "'automatic', 'small_steps' or 'direct'; contact_tolerance: m/s, residual at which the\n"
          "direct solver stops; substeps: of the small steps, 0 for as many as the loads ask\n"
          "for; sleep_after: s at rest until an island costs nothing, inf for\n"
          "never; verify: look at the ways of every step again with exact predicates, see\n"
          "report.sweep.crossings; slow; threads: 1 to 1024 share the contact solver's work, with\n"
          "the same bits whatever their number.")
      .def(
          "step",
          [](Shared& self, std::optional<double> dt) {
            self.without_gil([&](Simulation& s) { s.step(dt); });
          },
          "dt"_a = py::none(),
          "Takes exactly one step of dt seconds (the simulation's own where none is given).\n"
          "Other Python threads run meanwhile.")
      .def(
          "advance",
          [](Shared& self, double seconds) {
            return self.without_gil([&](Simulation& s) { return s.advance(seconds); });
          },
          "seconds"_a,
          "Advances by exactly `seconds` of simulated time, in equal steps no longer than dt, and\n"
          "reports. Other Python threads run meanwhile.")
      .def_property_readonly(
          "time", [](Shared& self) { return self.with([](Simulation& s) { return s.time(); }); },
          "s, simulated")
      .def_property_readonly(
          "dt", [](Shared& self) { return self.with([](Simulation& s) { return s.dt(); }); },
          "s, the largest step taken")
      .def("__len__",
           [](Shared& self) { return self.with([](Simulation& s) { return s.size(); }); });
}

void bind_reading(Class& cls) {
  PYBIND11_NUMPY_DTYPE(ContactRow, a, b, position, normal, separation, impulse, friction,
                       restitution);
  cls.def(
         "poses",
         [](Shared& self) {
           return self.with(
               [](Simulation& s) { return filled<7>(s, [&](auto out) { s.poses(out); }); });
         },
         "(N, 7) x y z qx qy qz qw of each body frame, m; row i is body i in the order added.")
      .def(
          "centres",
          [](Shared& self) {
            return self.with([](Simulation& s) { return rows_of(s.states().position); });
          },
          "(N, 3) centres of mass, m.")
      .def(
          "twists",
          [](Shared& self) {
            return self.with(
                [](Simulation& s) { return filled<6>(s, [&](auto out) { s.twists(out); }); });
          },
          "(N, 6) velocity of each body frame's origin, m/s, then angular velocity, rad/s, world "
          "axes.")
      .def(
          "energy",
          [](Shared& self) { return self.with([](Simulation& s) { return s.energy(); }); },
          "The energy ledger, J.")
      .def(
          "momentum",
          [](Shared& self) { return self.with([](Simulation& s) { return s.momentum(); }); },
          "(3,) kg m/s, of all moving bodies.")
      .def(
          "angular_momentum",
          [](Shared& self) {
            return self.with([](Simulation& s) { return s.angular_momentum(); });
          },
          "(3,) kg m^2/s, about the world origin.")
      .def(
          "contacts",
          [](Shared& self) {
            return self.with([](Simulation& s) {
              const auto contacts = s.contacts();
              py::array_t<ContactRow> out(static_cast<py::ssize_t>(contacts.size()));
              ContactRow* to = out.mutable_data();
              for (const Contact& c : contacts) {
                *to = {c.a, c.b, {}, {}, c.separation, {}, c.friction, c.restitution};
                Eigen::Vector3d::Map(to->position) = c.position;
                Eigen::Vector3d::Map(to->normal) = c.normal;
                Eigen::Vector3d::Map(to->impulse) = c.impulse;
                ++to;
              }
              return py::array(std::move(out));
            });
          },
          "Contact points of the last step, a structured array: a, b (rows), position (m, world),\n"
          "normal (unit, from a to b), separation (m, < 0: overlap, at the start of the step),\n"
          "impulse (N s, on b), friction and restitution of the pair.")
      .def(
          "ids",
          [](Shared& self) {
            return self.with([](Simulation& s) {
              py::array_t<std::uint32_t> out(py::ssize_t{s.size()});
              for (int i = 0; i < s.size(); ++i) out.mutable_at(i) = s.scene().bodies[i].id.value;
              return out;
            });
          },
          "(N,) id of the body in each row.")
      .def(
          "names",
          [](Shared& self) {
            return self.with([](Simulation& s) {
              std::vector<std::string> names;
              for (const auto& body : s.scene().bodies) names.push_back(body.name);
              return names;
            });
          },
          "Name of the body in each row.")
      .def(
          "row",
          [](Shared& self, const BodyLike& body) {
            return self.with(
                [&](Simulation& s) { return *s.scene().row(python::body_id(body, s.scene())); });
          },
          "body"_a, "Row of a body, by id or name.")
      .def_property_readonly(
          "scene", [](Shared& self) { return self.with([](Simulation& s) { return s.scene(); }); },
          "A copy of the scene as it stands: what was added and removed included.")
      .def_property_readonly(
          "report",
          [](Shared& self) { return self.with([](Simulation& s) { return s.report(); }); },
          "The Report since the simulation began.")
      .def(
          "plan",
          [](Shared& self, bool off) {
            return self.with([&](Simulation& s) {
              const py::object row = py::module_::import("carom.plan").attr("Stage");
              py::list rows;
              for (const Stage& stage : s.plan().stages) {
                if (!stage.on && !off) continue;
                const std::string name(name_of(stage.kind));
                double seconds = 0;
                for (const StageTime& each : s.report().stages)
                  if (each.stage == name) seconds += each.seconds;
                rows.append(row(name, stage.reason, stage.bodies, seconds));
              }
              return StageList{rows};
            });
          },
          "off"_a = false,
          "What a step runs, in order: named tuples (stage, reason, bodies, seconds), seconds "
          "being\n"
          "the wall time spent so far. With off=True those that are off as well, with the reason.");
}

void bind_changing(Class& cls) {
  python::define_add(cls, [](Shared& self, BodyDefinition body) {
    return self.with([&](Simulation& s) { return s.add(std::move(body)); });
  });
  const ArrayLike zero{py::make_tuple(0.0, 0.0, 0.0)};
  cls.def(
         "remove",
         [](Shared& self, const BodyLike& body) {
           self.with([&](Simulation& s) { s.remove(python::body_id(body, s.scene())); });
         },
         "body"_a, "Takes a body out by id or name; rows close up, ids are never used again.")
      .def(
          "set_state",
          [](Shared& self, const BodyLike& body, const std::optional<ArrayLike>& position,
             const std::optional<ArrayLike>& orientation, const std::optional<ArrayLike>& velocity,
             const std::optional<ArrayLike>& angular_velocity) {
            self.with([&](Simulation& s) {
              const BodyId id = python::body_id(body, s.scene());
              const int row = *s.scene().row(id);
              Pose pose = s.states().pose(row);
              Eigen::Vector3d v = s.states().velocity_at(row, pose.position);
              Eigen::Vector3d omega = s.states().angular_velocity(row);
              if (position) pose.position = vector3(*position, "position");
              if (orientation) pose.orientation = python::orientation(*orientation, "orientation");
              if (velocity) v = vector3(*velocity, "velocity");
              if (angular_velocity) omega = vector3(*angular_velocity, "angular_velocity");
              s.set_state(id, pose, v, omega);
            });
          },
          "body"_a, py::kw_only(), "position"_a = py::none(), "orientation"_a = py::none(),
          "velocity"_a = py::none(), "angular_velocity"_a = py::none(),
          "Puts a body somewhere; what is not given stays. position (3,) m, orientation (4,)\n"
          "x y z w, velocity (3,) m/s of the body frame's origin, angular_velocity (3,) rad/s.");
  const auto point_of = [](const std::optional<ArrayLike>& point) {
    return point ? std::optional(vector3(*point, "point")) : std::nullopt;
  };
  cls.def(
         "apply_force",
         [point_of](Shared& self, const BodyLike& body, const ArrayLike& force,
                    const std::optional<ArrayLike>& point) {
           self.with([&](Simulation& s) {
             s.apply_force(python::body_id(body, s.scene()), vector3(force, "force"),
                           point_of(point));
           });
         },
         "body"_a, "force"_a, "point"_a = py::none(),
         "For the next step only. force: (3,) N, world axes; point: (3,) m, world; the centre of\n"
         "mass where none is given.")
      .def(
          "apply_torque",
          [](Shared& self, const BodyLike& body, const ArrayLike& torque) {
            self.with([&](Simulation& s) {
              s.apply_torque(python::body_id(body, s.scene()), vector3(torque, "torque"));
            });
          },
          "body"_a, "torque"_a, "For the next step only. torque: (3,) N m, world axes.")
      .def(
          "apply_impulse",
          [point_of](Shared& self, const BodyLike& body, const ArrayLike& impulse,
                     const std::optional<ArrayLike>& point) {
            self.with([&](Simulation& s) {
              s.apply_impulse(python::body_id(body, s.scene()), vector3(impulse, "impulse"),
                              point_of(point));
            });
          },
          "body"_a, "impulse"_a, "point"_a = py::none(),
          "With the next step. impulse: (3,) N s, world axes; point: (3,) m, world; the centre of\n"
          "mass where none is given.")
      .def(
          "apply_angular_impulse",
          [](Shared& self, const BodyLike& body, const ArrayLike& impulse) {
            self.with([&](Simulation& s) {
              s.apply_angular_impulse(python::body_id(body, s.scene()),
                                      vector3(impulse, "impulse"));
            });
          },
          "body"_a, "impulse"_a, "With the next step. impulse: (3,) N m s, world axes.")
      .def(
          "hold_wrench",
          [](Shared& self, const BodyLike& body, const ArrayLike& force, const ArrayLike& torque,
             const ArrayLike& point_b, bool in_body_axes, double until) {
            self.with([&](Simulation& s) {
              s.hold_wrench({.body = python::body_id(body, s.scene()),
                             .force = vector3(force, "force"),
                             .torque = vector3(torque, "torque"),
                             .point_b = vector3(point_b, "point_b"),
                             .in_body_axes = in_body_axes,
                             .until = until});
            });
          },
          "body"_a, py::arg_v("force", zero, "(0, 0, 0)"), py::arg_v("torque", zero, "(0, 0, 0)"),
          py::kw_only(), py::arg_v("point_b", zero, "(0, 0, 0)"), "in_body_axes"_a = false,
          py::arg_v("until", std::numeric_limits<double>::infinity(), "float('inf')"),
          "Holds force (3,) N and torque (3,) N m on a body until replaced or until `until`, s of\n"
          "simulated time; all zeros clears it. point_b: (3,) m from the centre of mass, body "
          "axes;\n"
          "in_body_axes: force and torque turn with the body.");
}

void bind_saving(Class& cls) {
  cls.def(
         "save",
         [](Shared& self) { return self.with([](Simulation& s) { return py::bytes(s.save()); }); },
         "All that steps depend on, as bytes for this same build.")
      .def(
          "restore",
          [](Shared& self, const std::string& bytes) {
            self.with([&](Simulation& s) { s.restore(bytes); });
          },
          "bytes"_a, "Back to a saved state; the same bits follow from there.")
      .def(
          "state_hash",
          [](Shared& self) { return self.with([](Simulation& s) { return s.state_hash(); }); },
          "64-bit hash of the state: equal bits, equal hash.")
      .def("__repr__", [](Shared& self) {
        return self.with([](Simulation& s) {
          return py::str("<Simulation of {} bodies at {:.6g} s>").format(s.size(), s.time());
        });
      });
}

}  // namespace

void bind_simulation(py::module_& m) {
  Class cls(m, "Simulation", "Runs the plan of a scene, step by step.");
  bind_stepping(cls);
  bind_reading(cls);
  bind_changing(cls);
  bind_saving(cls);
  python::bind_queries(cls);
}
