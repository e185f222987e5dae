// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds one whole turn of the lidar, as a program that links the estimator hands it over.
#pragma once

#include <vector>

#include "lio/base/time.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

struct LidarSweep {
  Timestamp stamp;                 // instant of t_offset_ns = 0, by the sensor's clock
  std::vector<LidarPoint> points;  // in any order
};

}  // namespace lio
