// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "python/errors.hpp"

#include "python/bindings.hpp"

namespace py = pybind11;

namespace lio::python {
namespace {

// Makes a class of Python that stands for the exception of C++. A derived one must come later than
// its base, since the last one is tried first.
template <typename Exception>
py::object AddError(py::module_& module, const char* name, const py::object& base,
                    const char* meaning) {
  py::object error = py::register_exception<Exception>(module, name, base.ptr());
  error.attr("__module__") = "liod";
  error.attr("__doc__") = meaning;
  return error;
}

}  // namespace

void AddErrors(py::module_& module) {
  const py::object base = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "liod.Error", "The base of all errors of liod.", PyExc_RuntimeError, nullptr));
  module.attr("Error") = base;
  AddError<UsageError>(module, "UsageError", base,
                       "The call asks for something impossible, e.g. an ambiguous topic.");
  AddError<ConfigurationError>(module, "ConfigurationError", base,
                               "The configuration is faulty, or the data contradict it.");
  AddError<InputError>(module, "InputError", base,
                       "The input is missing, of an unknown kind or unusable.");
  const py::object output =
      AddError<OutputError>(module, "OutputError", base, "A file cannot be created.");
  AddError<WriteError>(module, "WriteError", output, "A file cannot be written in full.");
}

}  // namespace lio::python
