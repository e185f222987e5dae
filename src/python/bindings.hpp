// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The parts of the Python module; each is added to it by the source of its name.
#pragma once

#include <pybind11/pybind11.h>

namespace lio::python {

void AddErrors(pybind11::module_& module);
void AddEstimates(pybind11::module_& module);
void AddLog(pybind11::module_& module);
void AddOdometry(pybind11::module_& module);
void AddConvert(pybind11::module_& module);
void AddEvaluate(pybind11::module_& module);

}  // namespace lio::python
