// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "carom/geometry/mesh_diagnosis.hpp"

#include "arguments.hpp"
#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;
using carom::python::ArrayLike;

void bind_mesh_diagnosis(py::module_& m) {
  py::class_<MeshDiagnosis>(m, "MeshDiagnosis",
                            "What is odd about a triangle mesh as the boundary of a solid.")
      .def_readonly("components", &MeshDiagnosis::components, "Parts joined over edges.")
      .def_readonly("open_edges", &MeshDiagnosis::open_edges, "Edges with a face on one side only.")
      .def_readonly("mixed_edges", &MeshDiagnosis::mixed_edges,
                    "Edges along which two faces run the same way.")
      .def_readonly("non_manifold_edges", &MeshDiagnosis::non_manifold_edges,
                    "Edges of four or more faces.")
      .def_readonly("duplicate_faces", &MeshDiagnosis::duplicate_faces, "Copies of a face.")
      .def_readonly("degenerate_faces", &MeshDiagnosis::degenerate_faces,
                    "Faces that use a corner twice.")
      .def_readonly("crossings", &MeshDiagnosis::crossings,
                    "Pairs of faces that pass through each other.")
      .def_readonly("inverted", &MeshDiagnosis::inverted, "Closed parts that were inside out.")
      .def_readonly("cavities", &MeshDiagnosis::cavities, "Closed parts that bound a hole.")
      .def_readonly("nested", &MeshDiagnosis::nested, "Closed parts inside the solid of another.")
      .def_readonly("orientable", &MeshDiagnosis::orientable, "False for a surface with one side.")
      .def_readonly("volume", &MeshDiagnosis::volume, "m^3, of the mended mesh; 0 while open.")
      .def_property_readonly("closed", &MeshDiagnosis::closed)
      .def_property_readonly("findings", &MeshDiagnosis::findings, "One sentence each.")
      .def("__repr__", [](const MeshDiagnosis& d) {
        return py::str("<MeshDiagnosis: {}>")
            .format(d.findings().empty() ? py::cast("sound")
                                         : py::str("; ").attr("join")(d.findings()));
      });

  m.def(
      "diagnose_mesh",
      [](const ArrayLike& vertices, const ArrayLike& faces) {
        return diagnose(python::triangle_mesh(vertices, faces, "mesh"));
      },
      "vertices"_a, "faces"_a,
      "Finds what is odd about a mesh: open edges, winding, copies, crossings, cavities.\n\n"
      "vertices: (V, 3) m; faces: (F, 3).");
  m.def(
      "mend_mesh",
      [](const ArrayLike& vertices, const ArrayLike& faces) {
        const MendedMesh result = mended(python::triangle_mesh(vertices, faces, "mesh"));
        return py::make_tuple(result.mesh.vertices, result.mesh.faces, result.diagnosis);
      },
      "vertices"_a, "faces"_a,
      "(vertices, faces, MeshDiagnosis) with corners joined, copies left out and faces turned\n"
      "outward (inward about cavities). Open meshes keep their winding.");
}
