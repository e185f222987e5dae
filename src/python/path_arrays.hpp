// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a path of arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "lio/io/trajectory_file.hpp"

namespace lio::python {

// Takes a tuple of stamps [ns], shape (N,) and increasing, and poses, shape (N, 4, 4), whose upper
// left 3 x 3 are rotations. Throws a TypeError or a ValueError that names `what`.
[[nodiscard]] Trajectory TakeTrajectory(const pybind11::tuple& given, const char* what);

}  // namespace lio::python
