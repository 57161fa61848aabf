// SPDX-License-Identifier: Apache-2.0
// Questions to whole scenes and to two shapes, N at a time: one row of the answer for each row
// asked (or a list with the number of its row), worked out without the GIL.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "carom/narrow/contacts.hpp"
#include "carom/narrow/queries.hpp"
#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"
#include "carom/step/queries.hpp"

#include "arguments.hpp"
#include "body_arguments.hpp"
#include "module.hpp"
#include "shared_simulation.hpp"

using namespace pybind11::literals;

namespace carom::python {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr std::int64_t all_groups = 0xffffffff;

using Doubles = py::array_t<double>;
using Rows = py::array_t<std::int32_t>;

/// One row of a contact list, laid out as numpy reads it.
struct QueryContact {
  std::int32_t query, row, manifold;
  double position[3], normal[3], separation;
  std::uint32_t feature;
};

/// (N, 3), or (3,) for one.
TriangleMesh::Vertices points(const ArrayLike& input, const char* field) {
  const py::array array = py::array::ensure(input.value);
  if (array && array.ndim() == 1) {
    TriangleMesh::Vertices one(1, 3);
    one.row(0) = vector3(input, field).transpose();
    return one;
  }
  PyErr_Clear();
  return rows3(input, field);
}

/// Poses from positions (N, 3) or (3,) and orientations (N, 4), or (4,) for all.
std::vector<Pose> poses(const ArrayLike& positions, const ArrayLike& orientations,
                        const std::string& of) {
  const TriangleMesh::Vertices at = points(positions, ("positions" + of).c_str());
  const std::string field = "orientations" + of;
  std::vector<Pose> out(static_cast<std::size_t>(at.rows()));
  for (Eigen::Index i = 0; i < at.rows(); ++i) out[i].position = at.row(i).transpose();
  const py::array array = py::array::ensure(orientations.value);
  PyErr_Clear();
  if (!array || array.ndim() != 2) {
    const Eigen::Quaterniond q = orientation(orientations, field);
    for (Pose& pose : out) pose.orientation = q;
    return out;
  }
  if (array.shape(0) != at.rows() || array.shape(1) != 4 ||
      std::string_view("iuf").find(array.dtype().kind()) == std::string_view::npos)
    throw InvalidInput(field, "an array of shape " + std::string(py::str(array.attr("shape"))),
                       "must be numbers of shape (4,) or (N, 4), N as of positions");
  const py::array_t<double, py::array::c_style | py::array::forcecast> q(array);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].orientation = unit_quaternion(Eigen::Map<const Eigen::Vector4d>(q.data() + 4 * i),
                                         field + "[" + std::to_string(i) + "]");
  return out;
}

void require_as_many(Eigen::Index n, Eigen::Index wanted, const char* field, const char* as) {
  if (n != wanted)
    throw InvalidInput(field, std::to_string(n) + " rows", std::string("must be as many as ") + as);
}

py::tuple hits_as_arrays(const std::vector<BodyHit>& hits) {
  const auto n = static_cast<py::ssize_t>(hits.size());
  Doubles distance(n), normal({n, py::ssize_t{3}});
  Rows row(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    distance.mutable_at(i) = hits[i].row < 0 ? inf : hits[i].cast.distance;
    row.mutable_at(i) = hits[i].row;
    Eigen::Vector3d::Map(normal.mutable_data(i, 0)) = hits[i].cast.normal;
  }
  return py::make_tuple(distance, row, normal);
}

/// Asks N times, one object for the batch.
template <class Answer, class Ask>
std::vector<Answer> asked(Shared& self, std::int64_t groups, std::size_t n, Ask ask) {
  const std::uint32_t bits = group_bits(groups, "groups");
  std::vector<Answer> answers;
  answers.reserve(n);
  self.without_gil([&](Simulation& s) {
    const SceneQueries queries(s, bits);
    for (std::size_t i = 0; i < n; ++i) answers.push_back(ask(queries, i));
  });
  return answers;
}

void append(std::size_t query, int row, int number, const Manifold& m,
            std::vector<QueryContact>& out) {
  for (int k = 0; k < m.count; ++k) {
    QueryContact& c = out.emplace_back();
    c = {static_cast<std::int32_t>(query),
         row,
         number,
         {},
         {},
         m.points[k].separation,
         m.points[k].feature};
    Eigen::Vector3d::Map(c.position) = m.points[k].position;
    Eigen::Vector3d::Map(c.normal) = m.normal;
  }
}

py::array as_array(const std::vector<QueryContact>& contacts) {
  py::array_t<QueryContact> out(static_cast<py::ssize_t>(contacts.size()));
  std::copy(contacts.begin(), contacts.end(), out.mutable_data());
  return py::array(std::move(out));
}

ArrayLike upright() {
  return {py::make_tuple(0.0, 0.0, 0.0, 1.0)};
}

}  // namespace

void bind_queries(py::class_<Shared>& cls) {
  const auto q = py::arg_v("orientations", upright(), "(0, 0, 0, 1)");
  const auto reach = py::arg_v("reach", inf, "float('inf')");
  const auto far = py::arg_v("max_distance", inf, "float('inf')");
  cls.def(
      "raycast",
      [](Shared& self, const ArrayLike& origins, const ArrayLike& directions, double limit,
         std::int64_t groups) {
        const auto from = points(origins, "origins"), way = points(directions, "directions");
        require_as_many(way.rows(), from.rows(), "directions", "origins");
        return hits_as_arrays(asked<BodyHit>(
            self, groups, static_cast<std::size_t>(from.rows()), [&](const auto& ask, auto i) {
              return ask.ray(from.row(i).transpose(), way.row(i).transpose(), limit);
            }));
      },
      "origins"_a, "directions"_a, far, py::kw_only(), "groups"_a = all_groups,
      "First body along each ray. origins, directions: (N, 3) m, directions of any length > 0;\n"
      "max_distance: m; groups: bits, only bodies of these groups are asked.\n"
      "Returns distance (N,) m (inf where none), row (N,) of the body (-1), normal (N, 3).");
  cls.def(
      "segments",
      [](Shared& self, const ArrayLike& starts, const ArrayLike& ends, std::int64_t groups) {
        const auto from = points(starts, "starts"), to = points(ends, "ends");
        require_as_many(to.rows(), from.rows(), "ends", "starts");
        return hits_as_arrays(asked<BodyHit>(
            self, groups, static_cast<std::size_t>(from.rows()), [&](const auto& ask, auto i) {
              return ask.segment(from.row(i).transpose(), to.row(i).transpose());
            }));
      },
      "starts"_a, "ends"_a, py::kw_only(), "groups"_a = all_groups,
      "First body along each segment. starts, ends: (N, 3) m. Returns fraction (N,) of the way, 0\n"
      "to 1 (inf where none), row (N,) of the body (-1), normal (N, 3).");
  cls.def(
      "shape_cast",
      [](Shared& self, const Shape& shape, const ArrayLike& positions, const ArrayLike& directions,
         const ArrayLike& orientations, double limit, std::int64_t groups) {
        const auto start = poses(positions, orientations, "");
        const auto way = points(directions, "directions");
        require_as_many(way.rows(), static_cast<Eigen::Index>(start.size()), "directions",
                        "positions");
        return hits_as_arrays(
            asked<BodyHit>(self, groups, start.size(), [&](const auto& ask, auto i) {
              return ask.shape(shape, start[i], way.row(i).transpose(), limit);
            }));
      },
      "shape"_a, "positions"_a, "directions"_a, q, far, py::kw_only(), "groups"_a = all_groups,
      "How far a shape goes without turning until it meets a body. positions, directions: (N, 3)\n"
      "m; orientations: (N, 4) x y z w, or (4,) for all. Returns distance (N,) m, never beyond "
      "the\n"
      "first contact (inf where none), row (N,) (-1), normal (N, 3) out of the body.");
  cls.def(
      "overlaps",
      [](Shared& self, const Shape& shape, const ArrayLike& positions,
         const ArrayLike& orientations, std::int64_t groups) {
        const auto at = poses(positions, orientations, "");
        const auto found = asked<std::vector<int>>(
            self, groups, at.size(),
            [&](const auto& ask, auto i) { return ask.overlaps(shape, at[i]); });
        py::array_t<std::int64_t> offsets(static_cast<py::ssize_t>(at.size() + 1));
        std::vector<std::int32_t> rows;
        offsets.mutable_at(0) = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
          rows.insert(rows.end(), found[i].begin(), found[i].end());
          offsets.mutable_at(static_cast<py::ssize_t>(i + 1)) =
              static_cast<std::int64_t>(rows.size());
        }
        Rows list(static_cast<py::ssize_t>(rows.size()));
        std::copy(rows.begin(), rows.end(), list.mutable_data());
        return py::make_tuple(offsets, list);
      },
      "shape"_a, "positions"_a, q, py::kw_only(), "groups"_a = all_groups,
      "Bodies that a shape touches where it is placed. positions: (N, 3) m; orientations: (N, 4)\n"
      "x y z w, or (4,) for all. Returns offsets (N + 1,) and rows: those of placing i are\n"
      "rows[offsets[i]:offsets[i + 1]], ascending.");
  cls.def(
      "closest",
      [](Shared& self, const ArrayLike& at, double limit, std::int64_t groups) {
        const auto from = points(at, "points");
        const auto found = asked<BodyPoint>(
            self, groups, static_cast<std::size_t>(from.rows()), [&](const auto& ask, auto i) {
              return ask.closest(Eigen::Vector3d(from.row(i).transpose()), limit);
            });
        const auto n = static_cast<py::ssize_t>(found.size());
        Doubles distance(n), point({n, py::ssize_t{3}});
        Rows row(n);
        for (py::ssize_t i = 0; i < n; ++i) {
          distance.mutable_at(i) = found[i].row < 0 ? inf : found[i].distance;
          row.mutable_at(i) = found[i].row;
          Eigen::Vector3d::Map(point.mutable_data(i, 0)) = found[i].point;
        }
        return py::make_tuple(distance, row, point);
      },
      "points"_a, reach, py::kw_only(), "groups"_a = all_groups,
      "Nearest body to each point (N, 3), no farther than reach m: distance (N,) m, negative\n"
      "inside, inf for none; row (N,), -1 for none; point (N, 3) on the body.");
  cls.def(
      "closest_to_shape",
      [](Shared& self, const Shape& shape, const ArrayLike& positions,
         const ArrayLike& orientations, double limit, std::int64_t groups) {
        const auto at = poses(positions, orientations, "");
        const auto found = asked<NearestBody>(
            self, groups, at.size(),
            [&](const auto& ask, auto i) { return ask.closest(shape, at[i], limit); });
        const auto n = static_cast<py::ssize_t>(found.size());
        Doubles distance(n), on_body({n, py::ssize_t{3}}), on_shape({n, py::ssize_t{3}});
        Rows row(n);
        for (py::ssize_t i = 0; i < n; ++i) {
          distance.mutable_at(i) = found[i].row < 0 ? inf : found[i].points.distance;
          row.mutable_at(i) = found[i].row;
          Eigen::Vector3d::Map(on_body.mutable_data(i, 0)) = found[i].points.point_a;
          Eigen::Vector3d::Map(on_shape.mutable_data(i, 0)) = found[i].points.point_b;
        }
        return py::make_tuple(distance, row, on_body, on_shape);
      },
      "shape"_a, "positions"_a, q, reach, py::kw_only(), "groups"_a = all_groups,
      "Nearest body to a shape where it is placed, no farther than reach m. positions: (N, 3) m;\n"
      "orientations: (N, 4) x y z w, or (4,) for all. Returns distance (N,) m, negative where "
      "they\n"
      "overlap, inf for none; row (N,), -1 for none; the nearest points on body and shape, (N, "
      "3).");
  cls.def(
      "contacts_of",
      [](Shared& self, const Shape& shape, const ArrayLike& positions,
         const ArrayLike& orientations, double margin, std::int64_t groups) {
        const auto at = poses(positions, orientations, "");
        const auto found = asked<std::vector<BodyContact>>(
            self, groups, at.size(),
            [&](const auto& ask, auto i) { return ask.contacts(shape, at[i], margin); });
        std::vector<QueryContact> out;
        for (std::size_t i = 0; i < found.size(); ++i)
          for (std::size_t k = 0; k < found[i].size(); ++k)
            append(i, found[i][k].row, static_cast<int>(k), found[i][k].manifold, out);
        return as_array(out);
      },
      "shape"_a, "positions"_a, q, "margin"_a = 0.0, py::kw_only(), "groups"_a = all_groups,
      "Contacts a shape would have where it is placed: positions (N, 3) m, orientations (N, 4)\n"
      "x y z w, or (4,) for all; margin: m, points farther apart are left out. A structured "
      "array,\n"
      "one row a point: query (which placing), row (of the body), manifold (number within the\n"
      "placing), position (m, world), normal (unit, from the body to the shape), separation (m,\n"
      "negative: overlap), feature (names the meeting features).");
}

}  // namespace carom::python

void bind_pairs(pybind11::module_& m) {
  namespace py = pybind11;
  using namespace carom;
  using python::ArrayLike;
  PYBIND11_NUMPY_DTYPE(python::QueryContact, query, row, manifold, position, normal, separation,
                       feature);
  const auto qa = py::arg_v("orientations_a", python::upright(), "(0, 0, 0, 1)");
  const auto qb = py::arg_v("orientations_b", python::upright(), "(0, 0, 0, 1)");
  const auto both = [](const Shape& a, const ArrayLike& pa, const ArrayLike& oa, const Shape& b,
                       const ArrayLike& pb, const ArrayLike& ob, const auto& work) {
    require_valid(a, "a"), require_valid(b, "b");
    const auto at_a = python::poses(pa, oa, "_a"), at_b = python::poses(pb, ob, "_b");
    python::require_as_many(static_cast<Eigen::Index>(at_b.size()),
                            static_cast<Eigen::Index>(at_a.size()), "positions_b", "positions_a");
    py::gil_scoped_release release;
    for (std::size_t i = 0; i < at_a.size(); ++i) work(i, at_a[i], at_b[i]);
    return static_cast<py::ssize_t>(at_a.size());
  };
  m.def(
      "collide",
      [both](const Shape& a, const Shape& b, const ArrayLike& pa, const ArrayLike& pb,
             const ArrayLike& oa, const ArrayLike& ob, double margin) {
        require_non_negative(margin, "margin", "m");
        std::vector<python::QueryContact> out;
        std::vector<Manifold> manifolds;
        both(a, pa, oa, b, pb, ob, [&](std::size_t i, const Pose& at_a, const Pose& at_b) {
          manifolds.clear();
          collide(a, at_a, b, at_b, margin, manifolds);
          for (std::size_t k = 0; k < manifolds.size(); ++k)
            python::append(i, -1, static_cast<int>(k), manifolds[k], out);
        });
        return python::as_array(out);
      },
      "a"_a, "b"_a, "positions_a"_a, "positions_b"_a, qa, qb, "margin"_a = 0.0,
      "All contacts of two shapes at N pairs of poses: positions (N, 3) m, orientations (N, 4)\n"
      "x y z w, or (4,) for all; margin: m, points farther apart are left out. A structured "
      "array,\n"
      "one row a point: query (which pair of poses), row (-1), manifold (number within the "
      "query),\n"
      "position (m, world, midway between the surfaces), normal (unit, from a to b), separation "
      "(m\n"
      "along it, negative: overlap), feature (names the meeting features).");
  m.def(
      "closest_points",
      [both](const Shape& a, const Shape& b, const ArrayLike& pa, const ArrayLike& pb,
             const ArrayLike& oa, const ArrayLike& ob, double reach) {
        if (!(reach >= 0)) throw InvalidInput("reach", with_unit(reach, "m"), "must be >= 0");
        std::vector<ClosestPoints> found;
        const py::ssize_t n =
            both(a, pa, oa, b, pb, ob, [&](std::size_t, const Pose& at_a, const Pose& at_b) {
              const double whole = (at_b.position - at_a.position).norm() + bounding_radius(a) +
                                   bounding_radius(b);  // all that can be asked for
              found.push_back(closest_points(a, at_a, b, at_b, std::min(reach, whole)));
            });
        python::Doubles distance(n), on_a({n, py::ssize_t{3}}), on_b({n, py::ssize_t{3}}),
            normal({n, py::ssize_t{3}});
        for (py::ssize_t i = 0; i < n; ++i) {
          distance.mutable_at(i) = found[i].distance;
          Eigen::Vector3d::Map(on_a.mutable_data(i, 0)) = found[i].point_a;
          Eigen::Vector3d::Map(on_b.mutable_data(i, 0)) = found[i].point_b;
          Eigen::Vector3d::Map(normal.mutable_data(i, 0)) = found[i].normal;
        }
        return py::make_tuple(distance, on_a, on_b, normal);
      },
      "a"_a, "b"_a, "positions_a"_a, "positions_b"_a, qa, qb,
      py::arg_v("reach", python::inf, "float('inf')"),
      "Nearest points of two shapes at N pairs of poses, as of `collide`: distance (N,) m, "
      "negative\n"
      "where they overlap, inf beyond reach; points on a and on b (N, 3) m; normal (N, 3) from a "
      "to "
      "b.");
}
