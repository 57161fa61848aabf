// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include <cstdint>
#include <limits>
#include <string>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"

namespace py = pybind11;

namespace carom::python {
namespace {

std::string shape_text(const py::array& array) {
  return py::str(array.attr("shape"));
}

std::string short_repr(const py::handle& object) {
  if (py::isinstance<py::array>(object))
    return "an array of " + std::string(py::str(object.attr("dtype")));
  std::string text = py::repr(object);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

/// @param kinds  numpy's letters for the kinds of number that are allowed
py::array numbers(const ArrayLike& input, std::string_view field, std::string_view kinds,
                  std::string_view rule) {
  py::array array;
  try {
    array = py::reinterpret_steal<py::array>(
        py::detail::npy_api::get().PyArray_FromAny_(input.value.ptr(), nullptr, 0, 0, 0, nullptr));
    if (!array) throw py::error_already_set();
  } catch (py::error_already_set&) {  // rows of unequal length, or an object that refuses
    throw InvalidInput(field, short_repr(input.value), rule);
  }
  const bool empty = array.size() == 0;  // numpy reads [] as floats
  if (!empty && kinds.find(array.dtype().kind()) == std::string_view::npos)
    throw InvalidInput(field, short_repr(input.value), rule);
  return array;
}

template <class T>
py::array_t<T, py::array::c_style | py::array::forcecast> contiguous(const py::array& array) {
  return py::array_t < T, py::array::c_style | py::array::forcecast > (array);
}

template <int N>
Eigen::Matrix<double, N, 1> vector(const ArrayLike& input, std::string_view field) {
  const std::string rule = "must be " + std::to_string(N) + " numbers";
  const py::array array = numbers(input, field, "iuf", rule);
  if (array.ndim() != 1 || array.shape(0) != N)
    throw InvalidInput(field, "an array of shape " + shape_text(array), rule);
  return Eigen::Map<const Eigen::Matrix<double, N, 1>>(contiguous<double>(array).data());
}

py::array rows_of_three(const ArrayLike& input, const std::string& field, std::string_view kinds,
                        const std::string& rule) {
  py::array array = numbers(input, field, kinds, rule);
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw InvalidInput(field, "an array of shape " + shape_text(array), rule);
  return array;
}

}  // namespace

Eigen::Vector3d vector3(const ArrayLike& array, std::string_view field) {
  return vector<3>(array, field);
}

Eigen::Vector4d vector4(const ArrayLike& array, std::string_view field) {
  return vector<4>(array, field);
}

Eigen::Quaterniond orientation(const ArrayLike& array, std::string_view field) {
  return unit_quaternion(vector4(array, field), field);
}

Eigen::Matrix3d matrix3(const ArrayLike& array, std::string_view field) {
  const std::string rule = "must be numbers of shape (3, 3)";
  const py::array rows = rows_of_three(array, std::string(field), "iuf", rule);
  if (rows.shape(0) != 3) throw InvalidInput(field, "an array of shape " + shape_text(rows), rule);
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(contiguous<double>(rows).data());
}

Eigen::VectorXd numbers(const ArrayLike& input, std::string_view field) {
  const py::array array = numbers(input, field, "iuf", "must be numbers of shape (N,)");
  if (array.ndim() != 1)
    throw InvalidInput(field, "an array of shape " + shape_text(array),
                       "must be numbers of shape (N,)");
  return Eigen::Map<const Eigen::VectorXd>(contiguous<double>(array).data(), array.shape(0));
}

TriangleMesh::Vertices rows3(const ArrayLike& input, std::string_view field) {
  const py::array array =
      rows_of_three(input, std::string(field), "iuf", "must be numbers of shape (N, 3)");
  return Eigen::Map<const TriangleMesh::Vertices>(contiguous<double>(array).data(), array.shape(0),
                                                  3);
}

TriangleMesh triangle_mesh(const ArrayLike& vertices, const ArrayLike& faces,
                           std::string_view field) {
  const std::string at(field);
  const auto points = contiguous<double>(
      rows_of_three(vertices, at + ".vertices", "iuf", "must be numbers of shape (V, 3), m"));
  const auto indices = contiguous<std::int64_t>(
      rows_of_three(faces, at + ".faces", "iu", "must be whole numbers of shape (F, 3)"));

  TriangleMesh mesh;
  mesh.vertices = Eigen::Map<const TriangleMesh::Vertices>(points.data(), points.shape(0), 3);
  mesh.faces.resize(indices.shape(0), 3);
  for (py::ssize_t i = 0; i < indices.size(); ++i) {
    const std::int64_t index = indices.data()[i];
    // Before the narrowing, which could bring a huge index back into range.
    if (index < 0 || index >= points.shape(0))
      throw InvalidInput(at + ".faces[" + std::to_string(i / 3) + "]", std::to_string(index),
                         "must index vertices 0 to " + std::to_string(points.shape(0) - 1));
    mesh.faces.data()[i] = static_cast<int>(index);
  }
  return mesh;
}

BodyId body_id(const BodyLike& body, const Scene& scene) {
  if (py::isinstance<py::str>(body.value)) {
    const auto name = body.value.cast<std::string>();
    if (const auto id = scene.find(name)) return *id;
    py::list names;
    for (const auto& each : scene.bodies) names.append(each.name);
    const auto near = py::module_::import("carom.errors").attr("nearest")(name, names);
    throw InvalidInput("body", "'" + name + "'", "must name a body of the scene",
                       near.cast<std::string>());
  }
  const py::int_ number(body.value);
  const auto value = PyLong_AsLongLong(number.ptr());
  if (value == -1 && PyErr_Occurred()) PyErr_Clear();
  const BodyId id{static_cast<std::uint32_t>(value)};
  if (value < 0 || value > std::numeric_limits<std::uint32_t>::max() || !scene.row(id))
    throw InvalidInput("body", std::string(py::str(number)), "must be the id of a body");
  return id;
}

}  // namespace carom::python
