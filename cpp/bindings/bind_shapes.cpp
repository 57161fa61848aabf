// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "carom/geometry/mesh_surface.hpp"
#include "carom/geometry/sdf.hpp"
#include "carom/geometry/shape.hpp"

#include "arguments.hpp"
#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;
using carom::python::ArrayLike;

namespace {

template <class T>
T checked(T shape, const char* name) {
  require_valid(Shape(shape), name);
  return shape;
}

/// A view of the mesh's own memory, kept alive by the shared mesh and not writable: a thousand
/// bodies may hold it.
template <class Matrix>
py::array view(const Matrix& matrix, const std::shared_ptr<const TriangleMesh>& owner) {
  using Scalar = typename Matrix::Scalar;
  const py::capsule keep(new std::shared_ptr<const TriangleMesh>(owner), [](void* p) {
    delete static_cast<std::shared_ptr<const TriangleMesh>*>(p);
  });
  py::array_t<Scalar> array({matrix.rows(), Eigen::Index{3}}, matrix.data(), keep);
  array.attr("flags").attr("writeable") = false;
  return array;
}

template <class T>
void bind_round(py::module_& m, const char* name, const char* doc, const char* arguments) {
  py::class_<T>(m, name, doc)
      .def(py::init(
               [name](double radius, double length) { return checked(T{radius, length}, name); }),
           "radius"_a, "length"_a, arguments)
      .def_readonly("radius", &T::radius, "m")
      .def_readonly("length", &T::length, "m")
      .def("__repr__", [name](const T& s) {
        return py::str("{}(radius={!r}, length={!r})").format(name, s.radius, s.length);
      });
}

void bind_round_shapes(py::module_& m) {
  bind_round<Capsule>(m, "Capsule", "Segment along z, grown by a radius.",
                      "radius: m, > 0; length: m, >= 0, without the caps.");
  bind_round<Cylinder>(m, "Cylinder", "Solid cylinder along z about the origin.",
                       "radius, length: m, > 0.");
  bind_round<Cone>(m, "Cone",
                   "Solid cone, apex towards +z; the origin is its centre of mass, a quarter of\n"
                   "the length above the base.",
                   "radius of the base, length base to apex: m, > 0.");
  py::class_<Ellipsoid>(m, "Ellipsoid", "Solid ellipsoid about the origin.")
      .def(py::init([](const ArrayLike& radii) {
             return checked(Ellipsoid{python::vector3(radii, "Ellipsoid.radii")}, "Ellipsoid");
           }),
           "radii"_a, "radii: (3,) semi-axes, m, each > 0.")
      .def_property_readonly(
          "radii", [](const Ellipsoid& e) { return e.radii; }, "(3,) m")
      .def("__repr__", [](const Ellipsoid& e) {
        return py::str("Ellipsoid(radii=[{!r}, {!r}, {!r}])")
            .format(e.radii.x(), e.radii.y(), e.radii.z());
      });
}

void bind_made_shapes(py::module_& m) {
  py::class_<ConvexHull>(m, "ConvexHull", "Convex hull of points, found once and shared.")
      .def(py::init([](const ArrayLike& points) {
             return ConvexHull(python::rows3(points, "ConvexHull.points"));
           }),
           "points"_a, "points: (N, 3) m, not all in one plane.")
      .def_property_readonly(
          "vertices", [](const ConvexHull& h) { return view(h.triangles->vertices, h.triangles); },
          "(V, 3) m, the corners of the hull")
      .def_property_readonly(
          "faces", [](const ConvexHull& h) { return view(h.triangles->faces, h.triangles); },
          "(F, 3) vertex indices");
  py::class_<Sdf>(m, "Sdf", "Body given by the signed distance to its surface on a grid.")
      .def(
          py::init([](const Mesh& mesh, double spacing) {
            require_valid(Shape(mesh), "Sdf.mesh");
            return Sdf{std::make_shared<const SdfGrid>(SdfGrid::from_mesh(*mesh.surface, spacing))};
          }),
          "mesh"_a, "spacing"_a, "mesh: closed; spacing: cell size, m, > 0.")
      .def_static(
          "from_function",
          [](const py::function& distance, const ArrayLike& lower, const ArrayLike& upper,
             double spacing) {
            const auto ask = [&](const Eigen::Vector3d& p) {
              return distance(p).template cast<double>();
            };
            return Sdf{std::make_shared<const SdfGrid>(SdfGrid::from_function(
                ask, {python::vector3(lower, "Sdf.lower"), python::vector3(upper, "Sdf.upper")},
                spacing))};
          },
          "distance"_a, "lower"_a, "upper"_a, "spacing"_a,
          "distance: takes a point, (3,) m, gives its signed distance, m, negative inside; lower,\n"
          "upper: (3,) m, a box that holds the body; spacing: cell size, m, > 0.")
      .def_property_readonly(
          "error", [](const Sdf& s) { return s.grid->error; },
          "m, largest error met at the centres of cells near the surface")
      .def_property_readonly(
          "spacing", [](const Sdf& s) { return s.grid->spacing; }, "m, cell size")
      .def_property_readonly(
          "vertices",
          [](const Sdf& s) {
            const std::shared_ptr<const TriangleMesh> mesh(s.grid, &s.grid->surface->mesh);
            return view(mesh->vertices, mesh);
          },
          "(V, 3) m, of the surface where the distance is zero")
      .def_property_readonly(
          "faces",
          [](const Sdf& s) {
            const std::shared_ptr<const TriangleMesh> mesh(s.grid, &s.grid->surface->mesh);
            return view(mesh->faces, mesh);
          },
          "(F, 3) vertex indices");
  py::class_<HeightField>(m, "HeightField", "Terrain over a grid, solid below. Static only.")
      .def(py::init([](const Eigen::Ref<const HeightField::Heights>& heights, double spacing) {
             return HeightField(heights, spacing);
           }),
           "heights"_a, "spacing"_a,
           "heights: (rows, columns) m, row i at y = i * spacing, column j at x = j * spacing.")
      .def_readonly("spacing", &HeightField::spacing, "m")
      .def_property_readonly(
          "heights", [](const HeightField& h) { return h.heights; }, "(rows, columns) m");
  py::class_<ParticleSet>(m, "Particles", "Equal balls held together as one body.")
      .def(py::init([](const ArrayLike& positions, double radius) {
             return checked(ParticleSet{python::rows3(positions, "Particles.positions"), radius},
                            "Particles");
           }),
           "positions"_a, "radius"_a, "positions: (N, 3) m; radius: m, > 0, of each.")
      .def_property_readonly(
          "positions", [](const ParticleSet& p) { return p.positions; }, "(N, 3) m")
      .def_readonly("radius", &ParticleSet::radius, "m");
  // Part and Compound name each other: the class stands before the first signature that says it.
  py::class_<Compound> compound(m, "Compound",
                                "Several shapes as one body; overlaps count twice in mass.");
  py::class_<CompoundPart>(m, "Part", "A shape at its place in a Compound.")
      .def(py::init([](const Shape& shape, const ArrayLike& position, const ArrayLike& q) {
             return CompoundPart{shape, Pose{python::vector3(position, "Part.position"),
                                             python::orientation(q, "Part.orientation")}};
           }),
           "shape"_a, "position"_a = py::make_tuple(0.0, 0.0, 0.0),
           "orientation"_a = py::make_tuple(0.0, 0.0, 0.0, 1.0),
           "position: (3,) m; orientation: (4,) x y z w; in the body frame.")
      .def_readonly("shape", &CompoundPart::shape)
      .def_property_readonly(
          "position", [](const CompoundPart& p) { return p.pose.position; }, "(3,) m")
      .def_property_readonly(
          "orientation", [](const CompoundPart& p) { return p.pose.orientation.coeffs(); },
          "(4,) x y z w");
  compound
      .def(py::init([](const std::vector<CompoundPart>& parts) {
             return checked(Compound(parts), "Compound");
           }),
           "parts"_a, "parts: a list of Part.")
      .def_property_readonly(
          "size", [](const Compound& c) { return c.parts->size(); }, "number of parts")
      .def_property_readonly(
          "parts", [](const Compound& c) { return *c.parts; }, "copies, in order");
}

}  // namespace

void bind_shapes(py::module_& m) {
  py::class_<Sphere>(m, "Sphere", "Ball about the origin of the body frame.")
      .def(py::init([](double radius) { return checked(Sphere{radius}, "Sphere"); }), "radius"_a,
           "radius: m, > 0.")
      .def_readonly("radius", &Sphere::radius, "m")
      .def("__repr__",
           [](const Sphere& s) { return py::str("Sphere(radius={!r})").format(s.radius); });

  py::class_<Box>(m, "Box", "Box about the origin of the body frame, edges along its axes.")
      .def(py::init([](const ArrayLike& extents) {
             return checked(Box{python::vector3(extents, "Box.extents")}, "Box");
           }),
           "extents"_a, "extents: (3,) full edge lengths, m, each > 0.")
      .def_property_readonly(
          "extents", [](const Box& b) { return b.extents; }, "(3,) m")
      .def("__repr__", [](const Box& b) {
        return py::str("Box(extents=[{!r}, {!r}, {!r}])")
            .format(b.extents.x(), b.extents.y(), b.extents.z());
      });

  py::class_<Plane>(m, "Plane",
                    "Half-space: the body is where normal . x <= offset. For static bodies only.")
      .def(py::init([](const ArrayLike& normal, double offset) {
             return checked(Plane{python::vector3(normal, "Plane.normal"), offset}, "Plane");
           }),
           "normal"_a, "offset"_a = 0.0,
           "normal: (3,) of any length > 0, points out of the body; offset: m along the unit "
           "normal.")
      .def_property_readonly(
          "normal", [](const Plane& p) { return p.normal; }, "(3,) as given")
      .def_readonly("offset", &Plane::offset, "m")
      .def("__repr__", [](const Plane& p) {
        return py::str("Plane(normal=[{!r}, {!r}, {!r}], offset={!r})")
            .format(p.normal.x(), p.normal.y(), p.normal.z(), p.offset);
      });

  py::class_<Mesh>(m, "Mesh", "Closed triangle mesh; bodies that use one Mesh share its memory.")
      .def(py::init([](const ArrayLike& vertices, const ArrayLike& faces) {
             return checked(Mesh(python::triangle_mesh(vertices, faces, "Mesh")), "Mesh");
           }),
           "vertices"_a, "faces"_a,
           "vertices: (V, 3) m, body frame; faces: (F, 3) vertex indices, counter-clockwise seen\n"
           "from outside.")
      .def_static(
          "load",
          [](const py::object& path, double scale) {
            return py::module_::import("carom.mesh_file").attr("load")(path, scale).cast<Mesh>();
          },
          "path"_a, "scale"_a = 1.0,
          "Reads an OBJ, STL or PLY file (and what else trimesh reads); needs carom[mesh].\n\n"
          "scale: m per unit of the file, > 0; 0.001 for a file in millimetres. Warns when the\n"
          "result is implausibly large, and repairs nothing silently: see carom.mesh_file.")
      .def_property_readonly(
          "vertices",
          [](const Mesh& mesh) { return view(mesh.triangles->vertices, mesh.triangles); },
          "(V, 3) m, a view that cannot be written")
      .def_property_readonly(
          "faces", [](const Mesh& mesh) { return view(mesh.triangles->faces, mesh.triangles); },
          "(F, 3) vertex indices, a view that cannot be written")
      .def("__repr__", [](const Mesh& mesh) {
        return py::str("<Mesh of {} vertices, {} faces>")
            .format(mesh.triangles->vertices.rows(), mesh.triangles->faces.rows());
      });
  bind_round_shapes(m);
  bind_made_shapes(m);
}
