// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/invalid_input.hpp"

#include "module.hpp"

namespace py = pybind11;

void bind_errors(py::module_&) {
  // The class lives in Python, where file readers and the node raise it too; it is looked up when
  // first needed because the package is still being imported now.
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const carom::InvalidInput& e) {
      const py::object type = py::module_::import("carom.errors").attr("InvalidInput");
      const py::object value = type(e.field, e.value, e.rule, e.remedy);
      PyErr_SetObject(type.ptr(), value.ptr());
    }
  });
}
