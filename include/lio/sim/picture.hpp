// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Pictures of a scenario from above: parallel rays from a slope, sun and shade, the way drawn in.
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
  double elevation_deg = 66.0;  // of the view: 90 is straight down
  double azimuth_deg = -60.0;   // of where the viewer stands, from x
};

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // rows from the top
};

// The same for any number of threads.
Picture DrawFromAbove(const Scenario& scenario, const PictureOptions& options, int num_threads);

// Binary PPM. Throws std::runtime_error when it cannot be written.
void WritePpm(const Picture& picture, const std::filesystem::path& path);

}  // namespace lio::sim
