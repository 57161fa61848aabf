// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include <pybind11/numpy.h>

#include "carom/narrow/moving_triangle.hpp"
#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/roots.hpp"

#include "module.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

struct Hits {
  py::array_t<bool> hit;
  py::array_t<double> time;
  py::array_t<std::uint8_t> status;
};

std::string shape_of(const Doubles& a) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < a.ndim(); ++i) text += std::to_string(a.shape(i)) + ", ";
  return text + ")";
}

template <auto Query>
Hits ask(const Doubles& queries, double thickness, const std::string& method) {
  if (queries.ndim() != 3 || queries.shape(1) != 8 || queries.shape(2) != 3)
    throw carom::InvalidInput("queries", "shape " + shape_of(queries), "must be (N, 8, 3)",
                              "four points at the start, then the same four at the end");
  carom::CcdOptions options{.thickness = thickness};
  if (method == "lecture")
    options.method = carom::CcdMethod::lecture;
  else if (method == "tolerance")
    options.method = carom::CcdMethod::tolerance;
  else if (method != "certified")
    throw carom::InvalidInput("method", method, "must be certified, lecture or tolerance");
  const py::ssize_t count = queries.shape(0);
  Hits out{py::array_t<bool>(count), py::array_t<double>(count), py::array_t<std::uint8_t>(count)};
  const std::span<const double> all(queries.data(), static_cast<std::size_t>(queries.size()));
  const auto n = static_cast<std::size_t>(count);
  static_assert(sizeof(bool) == 1);
  const carom::CcdBatch batch{{reinterpret_cast<std::uint8_t*>(out.hit.mutable_data()), n},
                              {out.time.mutable_data(), n},
                              {out.status.mutable_data(), n}};
  const py::gil_scoped_release release;
  Query(all, batch, options);
  return out;
}

constexpr auto point_triangle = [](auto... a) { carom::point_triangle(a...); };
constexpr auto edge_edge = [](auto... a) { carom::edge_edge(a...); };

struct Roots {
  py::array_t<double> roots;
  py::array_t<std::uint8_t> status;
  py::array_t<int> iterations;
};

Roots roots(const Doubles& coefficients, const std::string& method, int max_iterations) {
  if (coefficients.ndim() != 2 || coefficients.shape(1) != 4)
    throw carom::InvalidInput("coefficients", "shape " + shape_of(coefficients), "must be (N, 4)",
                              "ascending powers");
  if (method != "exact" && method != "lecture")
    throw carom::InvalidInput("method", method, "must be exact or lecture");
  const carom::RootOptions options{
      .method = method == "exact" ? carom::RootMethod::exact : carom::RootMethod::lecture,
      .max_iterations = max_iterations};
  const py::ssize_t n = coefficients.shape(0);
  py::array_t<double> values({n, py::ssize_t{3}});
  py::array_t<std::uint8_t> status(n);
  py::array_t<int> iterations(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    const double* c = coefficients.data(i, 0);
    const carom::CubicRoots r = carom::cubic_roots({c[0], c[1], c[2], c[3]}, options);
    for (py::ssize_t k = 0; k < 3; ++k)
      values.mutable_at(i, k) = r.root[static_cast<std::size_t>(k)];
    status.mutable_at(i) = static_cast<std::uint8_t>(r.status);
    iterations.mutable_at(i) = r.iterations;
  }
  return {values, status, iterations};
}

constexpr const char* query_doc = R"(
queries: (N, 8, 3) float64, m: four points at the start of the step, then the same four at its
    end; each moves on a straight line. {points}
thickness: m, >= 0. A hit: distance <= thickness at some time.
method: "certified" (no miss, no false alarm), or "lecture" and "tolerance", the plain double
    methods it is measured against.

Returns Hits: hit (N,) bool; time (N,) in [0, 1], never later than the first contact and within
1e-9 of it, 1.0 where none; status (N,) uint8 of ccd.Status.
Raises ValueError for coordinates that are not finite.)";

}  // namespace

void bind_ccd(py::module_& m) {
  py::module_ ccd = m.def_submodule("ccd", "Continuous collision of moving triangles and edges.");
  ccd.attr("__name__") = "carom.ccd";

  py::enum_<carom::CcdStatus>(ccd, "Status", "How a query was decided.", py::arithmetic())
      .value("certified", carom::CcdStatus::certified, "in doubles, every rounding bounded")
      .value("coplanar", carom::CcdStatus::coplanar, "exactly; one plane throughout")
      .value("exact", carom::CcdStatus::exact, "exactly, in integers")
      .value("conservative", carom::CcdStatus::conservative,
             "thickness > 0: contact not excluded, reported as a hit");
  py::enum_<carom::RootStatus>(ccd, "RootStatus", "How a root search ended.", py::arithmetic())
      .value("converged", carom::RootStatus::converged)
      .value("cap", carom::RootStatus::cap)
      .value("stagnated", carom::RootStatus::stagnated)
      .value("zero_polynomial", carom::RootStatus::zero_polynomial);
  py::class_<Hits>(ccd, "Hits", "Answers, one row per query.")
      .def_readonly("hit", &Hits::hit, "(N,) bool")
      .def_readonly("time", &Hits::time, "(N,) fraction of the step, 1.0 where none")
      .def_readonly("status", &Hits::status, "(N,) uint8 of ccd.Status");
  py::class_<Roots>(ccd, "Roots", "Unpacks as roots, status.")
      .def_readonly("roots", &Roots::roots, "(N, 3) ascending, a multiple root once, NaN-padded")
      .def_readonly("status", &Roots::status, "(N,) uint8 of ccd.RootStatus")
      .def_readonly("iterations", &Roots::iterations, "(N,) function values spent on brackets")
      .def("__iter__", [](const Roots& r) { return py::iter(py::make_tuple(r.roots, r.status)); });

  const auto doc = [](const char* title, const char* points) {
    std::string text = std::string(title) + query_doc;
    text.replace(text.find("{points}"), 8, points);
    return text;
  };
  ccd.def(
      "point_triangle", &ask<point_triangle>, "queries"_a, py::kw_only(), "thickness"_a = 0.0,
      "method"_a = "certified",
      doc("Does a moving point meet a moving triangle, and when first?", "Order: point, a, b, c.")
          .c_str());
  ccd.def("edge_edge", &ask<edge_edge>, "queries"_a, py::kw_only(), "thickness"_a = 0.0,
          "method"_a = "certified",
          doc("Do two moving segments meet, and when first?", "Order: a0, a1, b0, b1.").c_str());
  ccd.def(
      "cubic_roots", &roots, "coefficients"_a, py::kw_only(), "method"_a = "exact",
      "max_iterations"_a = 64,
      "Real roots in [0, 1] of cubics, by the lecture's route: derivative's quadratic, extrema,\n"
      "brackets, secant and bisection.\n\n"
      "coefficients: (N, 4), ascending powers. method: \"exact\" decides every sign exactly, so\n"
      "the number of roots is right; \"lecture\" is the plain double version.\n"
      "Returns Roots: roots (N, 3) ascending, a multiple root once, padded with NaN (all NaN for\n"
      "the zero polynomial); status (N,) of ccd.RootStatus; iterations (N,). Unpacks as\n"
      "roots, status.");
}
