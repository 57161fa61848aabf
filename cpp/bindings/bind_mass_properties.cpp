// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "carom/bodies/mass_properties.hpp"
#include "carom/bodies/particles.hpp"
#include "carom/bodies/sampling.hpp"
#include "carom/bodies/shells.hpp"

#include "arguments.hpp"
#include "material.hpp"
#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace carom;
using carom::python::ArrayLike;
using carom::python::Material;

namespace {

using Optional = std::optional<double>;
using Class = py::class_<MassProperties>;

/// Binds a factory of which `make` takes the sizes and a Material.
template <class... Sizes, class Make, class... Args>
void define(Class& cls, const char* name, Make make, const std::string& doc, const Args&... args) {
  cls.def_static(
      name,
      [make](Sizes... sizes, Optional density, Optional mass, bool shell, Optional thickness) {
        return make(sizes..., Material{density, mass, shell, thickness});
      },
      args..., "density"_a = py::none(), py::kw_only(), "mass"_a = py::none(), "shell"_a = false,
      "thickness"_a = py::none(), (doc + python::material_doc).c_str());
}

/// The same with `caps`, for shells whose flat ends may be open.
template <class... Sizes, class Make, class... Args>
void define_capped(Class& cls, const char* name, Make make, const std::string& doc,
                   const Args&... args) {
  cls.def_static(
      name,
      [make](Sizes... sizes, Optional density, Optional mass, bool shell, Optional thickness,
             bool caps) {
        const bool open = !caps;
        if (open && !shell && !thickness)
          throw InvalidInput("caps", "False", "must be True for a solid", "set shell or thickness");
        return make(sizes..., open ? shell::Caps::open : shell::Caps::closed,
                    Material{density, mass, shell, thickness});
      },
      args..., "density"_a = py::none(), py::kw_only(), "mass"_a = py::none(), "shell"_a = false,
      "thickness"_a = py::none(), "caps"_a = true,
      (doc + python::material_doc + "\ncaps: whether the flat ends belong to the skin.").c_str());
}

void define_primitives(Class& cls) {
  define<double>(
      cls, "sphere",
      [](double radius, const Material& m) {
        return m.fill([&](double rho) { return MassProperties::sphere(radius, rho); },
                      [&](double s) { return shell::sphere(radius, s); });
      },
      "Ball about the origin. radius: m.", "radius"_a);
  define_capped<double>(
      cls, "hemisphere",
      [](double radius, shell::Caps caps, const Material& m) {
        return m.fill([&](double rho) { return MassProperties::hemisphere(radius, rho); },
                      [&](double s) { return shell::hemisphere(radius, s, caps); });
      },
      "Half a ball above z = 0, its flat face in that plane. radius: m.", "radius"_a);
  define<ArrayLike>(
      cls, "box",
      [](const ArrayLike& extents, const Material& m) {
        const Eigen::Vector3d e = python::vector3(extents, "extents");
        return m.fill([&](double rho) { return MassProperties::box(e, rho); },
                      [&](double s) { return shell::box(e, s); });
      },
      "Box about the origin. extents: (3,) full edge lengths, m.", "extents"_a);
  define<double, double>(
      cls, "capsule",
      [](double radius, double length, const Material& m) {
        return m.fill([&](double rho) { return MassProperties::capsule(radius, length, rho); },
                      [&](double s) { return shell::capsule(radius, length, s); });
      },
      "Capsule along z about the origin. radius: m; length: m, without the caps, >= 0.", "radius"_a,
      "length"_a);
  define_capped<double, double>(
      cls, "cylinder",
      [](double radius, double length, shell::Caps caps, const Material& m) {
        return m.fill([&](double rho) { return MassProperties::cylinder(radius, length, rho); },
                      [&](double s) { return shell::cylinder(radius, length, s, caps); });
      },
      "Cylinder along z about the origin. radius, length: m.", "radius"_a, "length"_a);
  define_capped<double, double>(
      cls, "cone",
      [](double radius, double length, shell::Caps caps, const Material& m) {
        return m.fill([&](double rho) { return MassProperties::cone(radius, length, rho); },
                      [&](double s) { return shell::cone(radius, length, s, caps); });
      },
      "Cone along z, apex at 3/4 of the length: the origin is the solid's centre of mass.\n"
      "radius, length: m.",
      "radius"_a, "length"_a);
  define<ArrayLike>(
      cls, "ellipsoid",
      [](const ArrayLike& radii, const Material& m) {
        const Eigen::Vector3d r = python::vector3(radii, "radii");
        return m.fill([&](double rho) { return MassProperties::ellipsoid(r, rho); },
                      [&](double s) { return shell::ellipsoid(r, s); });
      },
      "Ellipsoid about the origin. radii: (3,) semi-axes, m. As a shell it is of one thickness\n"
      "everywhere.",
      "radii"_a);
  define<double, double>(
      cls, "torus",
      [](double major, double minor, const Material& m) {
        return m.fill([&](double rho) { return MassProperties::torus(major, minor, rho); },
                      [&](double s) { return shell::torus(major, minor, s); });
      },
      "Ring about z. major_radius: m, to the middle of the tube; minor_radius: m, of the tube, at\n"
      "most major_radius.",
      "major_radius"_a, "minor_radius"_a);
  const auto solid = [](Optional density, Optional mass, const auto& make) {
    const auto no_skin = [](double) { return MassProperties{}; };
    return Material{density, mass, false, {}}.fill(make, no_skin);
  };
  cls.def_static(
      "tube",
      [solid](double inner, double outer, double length, Optional density, Optional mass) {
        return solid(density, mass,
                     [&](double rho) { return MassProperties::tube(inner, outer, length, rho); });
      },
      "inner_radius"_a, "outer_radius"_a, "length"_a, "density"_a = py::none(), py::kw_only(),
      "mass"_a = py::none(),
      "Hollow cylinder along z about the origin; sizes in m, inner < outer.");
  cls.def_static(
      "hollow_sphere",
      [solid](double inner, double outer, Optional density, Optional mass) {
        return solid(density, mass,
                     [&](double rho) { return MassProperties::hollow_sphere(inner, outer, rho); });
      },
      "inner_radius"_a, "outer_radius"_a, "density"_a = py::none(), py::kw_only(),
      "mass"_a = py::none(), "Ball with a hollow about its centre; sizes in m, inner < outer.");
  cls.def_static(
      "point",
      [](const ArrayLike& position, double mass) {
        return MassProperties::point(python::vector3(position, "position"), mass);
      },
      "position"_a, "mass"_a, "One particle: rank 0. position: (3,) m; mass: kg.");
  cls.def_static("rod", &MassProperties::rod, "length"_a, "mass"_a,
                 "Thin rod along z about the origin: rank 2. length: m; mass: kg.");
  cls.def_static("disc", &MassProperties::disc, "radius"_a, "mass"_a,
                 "Thin disc in the plane z = 0. radius: m; mass: kg.");
  cls.def_static(
      "plate", [](double x, double y, double mass) { return MassProperties::plate({x, y}, mass); },
      "x"_a, "y"_a, "mass"_a, "Thin rectangle in the plane z = 0. x, y: full edges, m; mass: kg.");
}

/// The density at rows of points from Python's inside test and density; no point outside reaches
/// the density, which may be undefined there.
DensityField density_field(const py::function& inside, const py::object& density) {
  const bool varies = PyCallable_Check(density.ptr()) != 0;
  const double uniform = varies ? 0 : density.cast<double>();
  if (!varies) require_positive(uniform, "density", "kg/m^3");
  return [=](const TriangleMesh::Vertices& points) {
    const py::object rows = py::cast(points);
    const auto mask = py::array_t<bool, py::array::forcecast>::ensure(inside(rows));
    if (!mask || mask.ndim() != 1 || mask.shape(0) != points.rows())
      throw InvalidInput("inside", "an answer of another shape",
                         "must return (N,) truth values for (N, 3) points");
    Eigen::VectorXd rho(points.rows());
    if (!varies) {
      for (Eigen::Index i = 0; i < rho.size(); ++i) rho[i] = mask.at(i) ? uniform : 0;
      return rho;
    }
    rho.setZero();
    const Eigen::VectorXd values =
        python::numbers(ArrayLike{density(rows[mask])}, "density's answer");
    Eigen::Index next = 0;
    for (Eigen::Index i = 0; i < rho.size(); ++i) {
      if (!mask.at(i)) continue;
      if (next == values.size()) break;
      rho[i] = values[next++];
    }
    if (next != values.size() || next != py::cast<Eigen::Index>(mask.attr("sum")()))
      throw InvalidInput("density", std::to_string(values.size()) + " values",
                         "must be (N,) numbers for (N, 3) points");
    return rho;
  };
}

SamplingMethod method_of(bool stratified, const std::optional<std::string>& name) {
  if (!name) return stratified ? SamplingMethod::stratified : SamplingMethod::monte_carlo;
  if (*name == "stratified") return SamplingMethod::stratified;
  if (*name == "monte_carlo") return SamplingMethod::monte_carlo;
  if (*name == "grid") return SamplingMethod::grid;
  throw InvalidInput("method", "'" + *name + "'", "must be monte_carlo, stratified or grid");
}

void define_others(Class& cls) {
  cls.def_static(
      "mesh",
      [](const ArrayLike& vertices, const ArrayLike& faces, Optional density, Optional mass,
         bool shell, Optional thickness) {
        const TriangleMesh mesh = python::triangle_mesh(vertices, faces, "mesh");
        return Material{density, mass, shell, thickness}.fill(
            [&](double rho) { return MassProperties::mesh(mesh, rho); },
            [&](double s) { return shell::mesh(mesh, s); });
      },
      "vertices"_a, "faces"_a, "density"_a = py::none(), py::kw_only(), "mass"_a = py::none(),
      "shell"_a = false, "thickness"_a = py::none(),
      (std::string(
           "Closed triangle mesh, exact for the mesh. vertices: (V, 3) m; faces: (F, 3).\n"
           "Wrong winding is mended and said in `.warnings`, as are cavities, crossings and\n"
           "copies; an open mesh is refused, unless as a shell.") +
       python::material_doc)
          .c_str());
  cls.def_static(
      "particles",
      [](const ArrayLike& positions, const ArrayLike& masses) {
        return mass_properties(
            Particles{python::rows3(positions, "positions"), python::numbers(masses, "masses")});
      },
      "positions"_a, "masses"_a,
      "Point masses. positions: (N, 3) m; masses: (N,) kg, >= 0. On one line: rank 2; one: rank "
      "0.");
  cls.def_static(
      "sampled",
      [](const py::function& inside, const ArrayLike& lower, const ArrayLike& upper,
         const py::object& density, long samples, bool stratified, std::uint64_t seed,
         const std::optional<std::string>& method) {
        return sampled(density_field(inside, density), python::vector3(lower, "lower"),
                       python::vector3(upper, "upper"),
                       {samples, method_of(stratified, method), seed});
      },
      "inside"_a, "lower"_a, "upper"_a, "density"_a = default_density, "samples"_a = 100000,
      "stratified"_a = true, "seed"_a = 0, py::kw_only(), "method"_a = py::none(),
      "Any body, by sampling the box lower..upper ((3,) m) that holds it; `.error` says how "
      "well.\n\n"
      "inside: callable (N, 3) -> (N,) bool; density: kg/m^3, or a callable (N, 3) -> (N,), asked\n"
      "at points inside only; samples: at most this many points, >= 2; stratified: two points in\n"
      "each cell of a grid (error ~ samples^-2/3) instead of independent ones (^-1/2); seed: the\n"
      "same points on every machine. method: 'stratified', 'monte_carlo' or 'grid' (cell centres,\n"
      "no error estimate) instead of `stratified`.");
  cls.def_static(
      "combined",
      [](const std::vector<MassProperties>& parts) { return MassProperties::combined(parts); },
      "parts"_a,
      "Union of any number of bodies given in one frame, by the parallel-axis theorem. Unlike a\n"
      "chain of +, the order of the parts changes no digit above 1e-15.");
}

void define_members(Class& cls) {
  // Copies, not views: a view would let Python break the positive semi-definite invariant.
  cls.def_property_readonly(
         "mass", [](const MassProperties& p) { return p.mass; }, "kg")
      .def_property_readonly(
          "com", [](const MassProperties& p) { return p.com; }, "(3,) m")
      .def_property_readonly(
          "inertia", [](const MassProperties& p) { return p.inertia; },
          "(3, 3) kg m^2, about com, axes of the body frame")
      .def_property_readonly(
          "rank", [](const MassProperties& p) { return inertia_rank(p.inertia); },
          "How many axes resist rotation: 3 a solid, 2 a rod, 0 a point.")
      .def_property_readonly(
          "inverse_inertia", [](const MassProperties& p) { return inverse_inertia(p.inertia); },
          "(3, 3) 1/(kg m^2), the pseudo-inverse: zero about axes nothing resists")
      .def_property_readonly(
          "warnings", [](const MassProperties& p) { return p.warnings; },
          "What is legal but odd, one sentence each.")
      .def_property_readonly(
          "error", [](const MassProperties& p) { return p.error; },
          "SamplingError, or None where nothing was sampled.")
      .def(
          "principal",
          [](const MassProperties& p) {
            const PrincipalAxes principal = principal_axes(p.inertia);
            return py::make_tuple(principal.moments, principal.rotation());
          },
          "(moments (3,) ascending in kg m^2, axes (3, 3) a rotation with the axes as columns):\n"
          "inertia = axes @ diag(moments) @ axes.T.")
      .def(
          "transformed",
          [](const MassProperties& p, const ArrayLike& R, const ArrayLike& t) {
            return p.transformed(python::matrix3(R, "rotation"), python::vector3(t, "translation"));
          },
          "rotation"_a, "translation"_a,
          "The same body seen from another frame: x_new = rotation @ x + translation.\n\n"
          "rotation: (3, 3), a reflection is refused; translation: (3,) m.")
      .def("scaled_to", &MassProperties::scaled_to, "mass"_a,
           "The same body with its density scaled until it weighs `mass`, kg.")
      .def(
          "__add__", [](const MassProperties& a, const MassProperties& b) { return a + b; },
          py::is_operator())
      .def(
          "__radd__",
          [](const MassProperties& p, int zero) -> py::object {  // for sum()
            if (zero != 0) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            return py::cast(p);
          },
          py::is_operator())
      .def("__repr__", [](const MassProperties& p) {
        return py::str("MassProperties(mass={!r}, com={}, inertia={})")
            .format(p.mass, py::cast(p.com).attr("tolist")(), py::cast(p.inertia).attr("tolist")());
      });
  cls.def(py::pickle(
      [](const MassProperties& p) {
        return py::make_tuple(p.mass, p.com, p.inertia, p.warnings, p.error);
      },
      [](const py::tuple& t) {
        return MassProperties{t[0].cast<double>(), t[1].cast<Eigen::Vector3d>(),
                              t[2].cast<Eigen::Matrix3d>(), t[3].cast<std::vector<std::string>>(),
                              t[4].cast<std::optional<SamplingError>>()};
      }));
}

void bind_sampling_error(py::module_& m) {
  py::class_<SamplingError>(m, "SamplingError",
                            "One standard error of each number of a sampled body.")
      .def_property_readonly(
          "mass", [](const SamplingError& e) { return e.mass; }, "kg")
      .def_property_readonly(
          "com", [](const SamplingError& e) { return e.com; }, "(3,) m")
      .def_property_readonly(
          "inertia", [](const SamplingError& e) { return e.inertia; }, "(3, 3) kg m^2")
      .def_readonly("samples", &SamplingError::samples, "Points evaluated.")
      .def("__repr__",
           [](const SamplingError& e) {
             return py::str("<SamplingError: mass {:.3g} kg from {} samples>")
                 .format(e.mass, e.samples);
           })
      .def(py::pickle(
          [](const SamplingError& e) {
            return py::make_tuple(e.mass, e.com, e.inertia, e.samples);
          },
          [](const py::tuple& t) {
            return SamplingError{t[0].cast<double>(), t[1].cast<Eigen::Vector3d>(),
                                 t[2].cast<Eigen::Matrix3d>(), t[3].cast<long>()};
          }));
}

}  // namespace

void bind_mass_properties(py::module_& m) {
  bind_sampling_error(m);
  Class cls(m, "MassProperties",
            "Mass, centre of mass and inertia of a rigid body, in its own frame.\n\n"
            "Made from numbers, which are checked, or by one of the factories; `a + b` is their\n"
            "rigid union. SI units; round bodies lie along z.");
  cls.def(py::init([](double mass, const ArrayLike& com, const ArrayLike& inertia) {
            return MassProperties::checked(mass, python::vector3(com, "com"),
                                           python::matrix3(inertia, "inertia"));
          }),
          "mass"_a, "com"_a, "inertia"_a,
          "mass: kg, > 0; com: (3,) m; inertia: (3, 3) kg m^2 about com. A tensor no distribution\n"
          "of mass has is refused: largest moment above the sum of the other two, or negative.");
  define_primitives(cls);
  define_others(cls);
  define_members(cls);
}
