// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "carom/state/report.hpp"

#include "arguments.hpp"
#include "module.hpp"

namespace py = pybind11;
using namespace carom;

void bind_report(py::module_& m) {
  py::class_<Energy>(m, "Energy",
                     "Where the energy is and where it went, J; `balance` is constant up to the\n"
                     "error of the integration.")
      .def_readonly("kinetic", &Energy::kinetic, "J")
      .def_readonly("potential", &Energy::potential, "J")
      .def_readonly("dissipated", &Energy::dissipated,
                    "J, by contacts and friction since the start")
      .def_readonly("work", &Energy::work, "J, by applied wrenches and impulses since the start")
      .def_readonly("repulsion", &Energy::repulsion,
                    "J, put in by the lecture's repulsion since the start")
      .def_property_readonly("balance", &Energy::balance,
                             "J, kinetic + potential + dissipated - work - repulsion")
      .def("__repr__", [](const Energy& e) {
        return py::str("Energy(kinetic={:.6g}, potential={:.6g}, dissipated={:.6g}, work={:.6g})")
            .format(e.kinetic, e.potential, e.dissipated, e.work);
      });

  py::class_<ContactReport>(m, "ContactReport",
                            "What contacts did: extremes and sums over the steps of a report.")
      .def_readonly("points", &ContactReport::points, "in the last step")
      .def_readonly("deepest_overlap", &ContactReport::deepest_overlap,
                    "m, worst seen at a step's start, >= 0")
      .def_readonly("residual", &ContactReport::residual, "m/s, worst the solver left")
      .def_readonly("iterations", &ContactReport::iterations, "in all")
      .def_readonly("islands", &ContactReport::islands, "in the last step")
      .def_readonly("direct_islands", &ContactReport::direct_islands,
                    "of these, solved directly; the others took small steps")
      .def_readonly("asleep", &ContactReport::asleep, "bodies at rest without cost")
      .def_readonly("gave_up", &ContactReport::gave_up, "solves that ended above their tolerance")
      .def("__repr__", [](const ContactReport& c) {
        return py::str(
                   "ContactReport(points={}, deepest_overlap={:.4g}, residual={:.4g}, "
                   "iterations={}, gave_up={})")
            .format(c.points, c.deepest_overlap, c.residual, c.iterations, c.gave_up);
      });

  py::class_<RepulsionReport>(m, "RepulsionReport",
                              "What the lecture's repulsion did, added up; the first four: where "
                              "the\nnormals of centres inside distance grids came from.")
      .def_readonly("gradient", &RepulsionReport::gradient, "of the distance")
      .def_readonly("swept_hit", &RepulsionReport::swept_hit, "where the path met the surface")
      .def_readonly("velocity", &RepulsionReport::velocity, "opposite of the motion")
      .def_readonly("kept", &RepulsionReport::kept, "of the step before: inside all along")
      .def_readonly("pushed", &RepulsionReport::pushed, "contact points")
      .def_readonly("capped", &RepulsionReport::capped, "steps that stopped at the cap of sweeps")
      .def_readonly("stagnated", &RepulsionReport::stagnated, "steps that rounding stopped")
      .def_readonly("fastest", &RepulsionReport::fastest, "m/s, largest speed given to a point")
      .def("__repr__", [](const RepulsionReport& r) {
        return py::str(
                   "RepulsionReport(pushed={}, gradient={}, swept_hit={}, velocity={}, kept={}, "
                   "capped={}, stagnated={}, fastest={:.4g})")
            .format(r.pushed, r.gradient, r.swept_hit, r.velocity, r.kept, r.capped, r.stagnated,
                    r.fastest);
      });

  py::class_<RotationReport>(m, "RotationReport", "What turning the bodies took, added up.")
      .def_readonly("capped", &RotationReport::capped, "bodies too fast for the most sub-steps")
      .def_readonly("clamped", &RotationReport::clamped, "square-root steps beyond |dt w| = 2")
      .def_readonly("not_converged", &RotationReport::not_converged,
                    "implicit or adaptive steps that stopped at their cap")
      .def_readonly("most_substeps", &RotationReport::most_substeps, "of any body in any step")
      .def("__repr__", [](const RotationReport& r) {
        return py::str("RotationReport(capped={}, clamped={}, not_converged={}, most_substeps={})")
            .format(r.capped, r.clamped, r.not_converged, r.most_substeps);
      });

  py::class_<SweepReport>(m, "SweepReport",
                          "The certificate: what was followed along its path, and what could not\n"
                          "be followed to the end of a step and waited there. Nothing has passed "
                          "through\nanything else.")
      .def_readonly("swept", &SweepReport::swept, "bodies followed in the last step")
      .def_readonly("sweeps", &SweepReport::sweeps, "pairs of paths asked about")
      .def_readonly("queries", &SweepReport::queries, "distances that took")
      .def_readonly("impacts", &SweepReport::impacts, "hits resolved at their time")
      .def_readonly("waited", &SweepReport::waited,
                    "bodies stopped for the rest of a step: too many hits, or given up")
      .def_readonly("gave_up", &SweepReport::gave_up,
                    "pairs not certified to the end of a step: query cap met")
      .def_readonly("time_lost", &SweepReport::time_lost, "s, that those bodies did not move")
      .def_readonly("verified", &SweepReport::verified,
                    "pairs of ways looked at again, with Simulation(verify=True)")
      .def_readonly("crossings", &SweepReport::crossings, "of these, found to cross")
      .def_readonly("smallest_gap", &SweepReport::smallest_gap,
                    "m, least separation of swept pairs; negative: overlap, inf where none was")
      .def("__repr__", [](const SweepReport& s) {
        return py::str(
                   "SweepReport(swept={}, impacts={}, waited={}, gave_up={}, smallest_gap={:.4g})")
            .format(s.swept, s.impacts, s.waited, s.gave_up, s.smallest_gap);
      });

  py::class_<StageTime>(m, "StageTime", "Wall time spent in one stage.")
      .def_readonly("stage", &StageTime::stage)
      .def_readonly("seconds", &StageTime::seconds, "s, wall")
      .def_readonly("bodies", &StageTime::bodies, "how many it worked on in the last step")
      .def("__repr__", [](const StageTime& s) {
        return py::str("StageTime({!r}, seconds={:.4g}, bodies={})")
            .format(s.stage, s.seconds, s.bodies);
      });

  py::class_<Report>(m, "Report", "What an advance did, how wrong it may be and what it cost.")
      .def_readonly("time", &Report::time, "s, simulated clock at the end")
      .def_readonly("simulated", &Report::simulated, "s, advanced")
      .def_readonly("steps", &Report::steps)
      .def_readonly("wall_seconds", &Report::wall_seconds, "s")
      .def_readonly("stages", &Report::stages, "wall time of each stage")
      .def_readonly("contact", &Report::contact)
      .def_readonly("rotation", &Report::rotation)
      .def_readonly("sweep", &Report::sweep)
      .def_readonly("repulsion", &Report::repulsion)
      .def_readonly("frozen", &Report::frozen,
                    "ids of bodies held at their last good pose since their state went non-finite")
      .def_property_readonly("ok", &Report::ok, "no body frozen or made to wait, no solve given up")
      .def("__repr__", [](const Report& r) {
        return py::str("<Report {}: {:.6g} s simulated in {} steps, {:.4g} s wall>")
            .format(r.ok() ? "ok" : "NOT ok", r.simulated, r.steps, r.wall_seconds);
      });
}
