// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The extension module liod._liod. The package around it (liod/) has the signatures that users see.
#include "lio/io/beam_table.hpp"
#include "python/bindings.hpp"

PYBIND11_MODULE(_liod, module) {
  module.doc() = "The C++ part of liod; use the package liod.";
  module.attr("__version__") = LIO_VERSION;
  module.def("config_directory", [] { return lio::ConfigDirectory().string(); });
  lio::python::AddErrors(module);
  lio::python::AddEstimates(module);
  lio::python::AddLog(module);
  lio::python::AddOdometry(module);
  lio::python::AddConvert(module);
  lio::python::AddEvaluate(module);
}
