// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "carom/narrow/sweep.hpp"
#include "carom/numerics/rotation.hpp"

#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using carom::SweepResult;
using carom::SweptBody;

namespace {

SweptBody make_body(const carom::TriangleMesh::Vertices& vertices,
                    const std::optional<carom::TriangleMesh::Faces>& faces,
                    const std::optional<SweptBody::Edges>& edges, const Eigen::Vector3d& position,
                    const Eigen::Vector4d& orientation, const Eigen::Vector3d& displacement,
                    const Eigen::Vector3d& rotation) {
  SweptBody body;
  body.mesh.vertices = vertices;
  body.mesh.faces = faces.value_or(carom::TriangleMesh::Faces(0, 3));
  body.motion.centre = position;
  body.motion.orientation = carom::unit_quaternion(orientation, "orientation");
  body.motion.displacement = displacement;
  body.motion.rotation = rotation;
  body.edges = edges ? *edges : carom::edges_of(body.mesh.faces);
  return body;
}

}  // namespace

void bind_sweep(py::module_& m) {
  auto ccd = m.attr("ccd").cast<py::module_>();
  py::enum_<carom::SweepStatus>(ccd, "SweepStatus", "How a sweep ended.", py::arithmetic())
      .value("separated", carom::SweepStatus::separated, "certified: farther than thickness")
      .value("contact", carom::SweepStatus::contact,
             "distance <= thickness + tolerance within 1e-9 of the step after time")
      .value("interval_limit", carom::SweepStatus::interval_limit, "certified only up to time");
  py::enum_<SweepResult::Kind>(ccd, "Feature", "Which features met.")
      .value("none", SweepResult::Kind::none)
      .value("vertex_face", SweepResult::Kind::vertex_face)
      .value("face_vertex", SweepResult::Kind::face_vertex)
      .value("edge_edge", SweepResult::Kind::edge_edge)
      .value("edge_face", SweepResult::Kind::edge_face, "at time 0: an edge is through a face")
      .value("face_edge", SweepResult::Kind::face_edge);

  py::class_<SweptBody>(ccd, "SweptBody", "A body moving rigidly over one step.")
      .def(py::init(&make_body), "vertices"_a, "faces"_a = py::none(), "edges"_a = py::none(),
           py::kw_only(), "position"_a = Eigen::Vector3d(0, 0, 0),
           "orientation"_a = Eigen::Vector4d(0, 0, 0, 1),
           "displacement"_a = Eigen::Vector3d(0, 0, 0), "rotation"_a = Eigen::Vector3d(0, 0, 0),
           "vertices: (N, 3) m, relative to the centre of rotation. faces: (F, 3). edges: (E, 2),\n"
           "those of the faces unless given; a rod is two vertices and one edge.\n"
           "position, orientation (x y z w): at the start. displacement: (3,) m over the step.\n"
           "rotation: (3,) rad over the step, world axes.");
  py::class_<SweepResult>(ccd, "SweepResult")
      .def_readonly("status", &SweepResult::status)
      .def_readonly("time", &SweepResult::time, "no contact before this fraction of the step")
      .def_readonly("intervals", &SweepResult::intervals, "chords tried")
      .def_readonly("queries", &SweepResult::queries, "continuous queries spent")
      .def_readonly("kind", &SweepResult::kind, "ccd.Feature")
      .def_readonly("a", &SweepResult::a, "vertex, face or edge of the first body; -1 for none")
      .def_readonly("b", &SweepResult::b, "vertex, face or edge of the second body; -1 for none");
  ccd.def(
      "sweep",
      [](const SweptBody& a, const SweptBody& b, double thickness, double tolerance,
         int max_intervals) {
        return carom::sweep(
            a, b, {.thickness = thickness, .tolerance = tolerance, .max_intervals = max_intervals});
      },
      "a"_a, "b"_a, py::kw_only(), "thickness"_a = 0.0, "tolerance"_a = carom::tolerance::sweep_gap,
      "max_intervals"_a = 4096, py::call_guard<py::gil_scoped_release>(),
      "First contact of two rigidly moving surfaces, rotation included: never a miss; a false\n"
      "alarm only below thickness + tolerance (m). Time is never later than the first contact.");
}
