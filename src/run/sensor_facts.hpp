// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Looks at a log's beginning: which sensors are there, how fast they are, and which lidar it is.
#pragma once

#include <filesystem>

#include "lio/io/lidar_guess.hpp"
#include "lio/io/log_input.hpp"
#include "lio/io/stream_stats.hpp"

namespace lio {

struct SensorFacts {
  StreamStats imu;
  StreamStats lidar;  // by sweeps
  AccelerometerStats accelerometer;
  int num_rings = 0;
  LidarGuess guess;
};

// Reads the first half minute of the log. Throws std::runtime_error naming the file when it cannot
// be opened.
[[nodiscard]] SensorFacts LookAtLog(const std::filesystem::path& log);

}  // namespace lio
