// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Draws pictures of a scenario from above with parallel rays at a slope, with sun and shade, and
// marks the sensor's path.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "lio/sim/scenario.hpp"

namespace lio::sim {

struct PictureOptions {
  int width = 960;
  int height = 640;
  int samples = 3;              // per pixel and axis
  double elevation_deg = 66.0;  // viewer's elevation; 90 looks straight down
  double azimuth_deg = -60.0;   // viewer's azimuth from x
};

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // rows from the top
};

// The picture is the same for any number of threads.
[[nodiscard]] Picture DrawFromAbove(const Scenario& scenario, const PictureOptions& options,
                                    int num_threads);

// Writes a binary PPM. Throws std::runtime_error when it cannot be written.
void WritePpm(const Picture& picture, const std::filesystem::path& path);

}  // namespace lio::sim
