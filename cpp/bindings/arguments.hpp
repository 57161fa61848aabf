// SPDX-License-Identifier: Apache-2.0
// How numbers from Python become Eigen values: anything numpy can read as numbers is taken, and
// what has the wrong shape or kind is refused by name.
#pragma once
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "carom/bodies/ids.hpp"
#include "carom/geometry/mesh.hpp"
#include "carom/scene/scene.hpp"

namespace carom::python {

/// An argument that should hold numbers; the function it is given to knows its name and shape.
struct ArrayLike {
  pybind11::object value;
};

/// A body by its id or by its name.
struct BodyLike {
  pybind11::object value;
};

/// @throws InvalidInput naming `field` when `array` is not `3` (or `4`) numbers
[[nodiscard]] Eigen::Vector3d vector3(const ArrayLike& array, std::string_view field);
[[nodiscard]] Eigen::Vector4d vector4(const ArrayLike& array, std::string_view field);

/// x y z w, of unit length up to tolerance::quaternion_norm. @throws InvalidInput naming `field`
[[nodiscard]] Eigen::Quaterniond orientation(const ArrayLike& array, std::string_view field);

/// Numbers of shape (3, 3), (N,) and (N, 3). @throws InvalidInput naming `field`
[[nodiscard]] Eigen::Matrix3d matrix3(const ArrayLike& array, std::string_view field);
[[nodiscard]] Eigen::VectorXd numbers(const ArrayLike& array, std::string_view field);
[[nodiscard]] TriangleMesh::Vertices rows3(const ArrayLike& array, std::string_view field);

/// vertices (V, 3) numbers, faces (F, 3) whole numbers. @throws InvalidInput naming
/// `field`.vertices or `field`.faces
[[nodiscard]] TriangleMesh triangle_mesh(const ArrayLike& vertices, const ArrayLike& faces,
                                         std::string_view field);

/// @throws InvalidInput where no body has this id or name, with the nearest name
[[nodiscard]] BodyId body_id(const BodyLike& body, const Scene& scene);

}  // namespace carom::python

namespace pybind11::detail {

template <>
struct type_caster<carom::python::ArrayLike> {
  PYBIND11_TYPE_CASTER(carom::python::ArrayLike, const_name("numpy.typing.ArrayLike"));
  bool load(handle source, bool) {
    value.value = reinterpret_borrow<object>(source);
    return !source.is_none();
  }
  static handle cast(const carom::python::ArrayLike& array, return_value_policy, handle) {
    return object(array.value).release();  // for default values
  }
};

template <>
struct type_caster<carom::python::BodyLike> {
  PYBIND11_TYPE_CASTER(carom::python::BodyLike, const_name("int | str"));
  bool load(handle source, bool) {
    value.value = reinterpret_borrow<object>(source);
    return isinstance<str>(source) || PyIndex_Check(source.ptr());
  }
};

template <>
struct type_caster<carom::BodyId> {
  PYBIND11_TYPE_CASTER(carom::BodyId, const_name("int"));
  bool load(handle source, bool convert) {
    make_caster<std::uint32_t> number;
    if (!number.load(source, convert)) return false;
    value.value = cast_op<std::uint32_t>(number);
    return true;
  }
  static handle cast(carom::BodyId id, return_value_policy, handle) {
    return PyLong_FromUnsignedLong(id.value);
  }
};

}  // namespace pybind11::detail
