// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the estimator's inputs of arrays. Values are the estimator's to judge, which counts those
// that are not finite; shapes, types and ranges are judged here, with a TypeError or a ValueError.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio::python {

// Takes one sample, or N: stamps [ns], rates [rad/s] and specific forces [m/s^2].
[[nodiscard]] std::vector<ImuSample> TakeSamples(const pybind11::object& stamps,
                                                 const pybind11::object& gyro,
                                                 const pybind11::object& accel);

// Takes a whole sweep: its stamp [ns], N points [m], and N times after the stamp [ns], rings and
// intensities, each of which may be None. The points are in any order.
[[nodiscard]] ScanChunk TakeScan(const pybind11::object& stamp, const pybind11::object& points,
                                 const pybind11::object& times, const pybind11::object& rings,
                                 const pybind11::object& intensity);

}  // namespace lio::python
