// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Does a driver send the same sweep again, under new stamps? Noise changes every point of a lidar
// that works, wherever it stands.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/scan/sweep.hpp"

namespace lio {

struct RepeatedSweepParameters {
  std::size_t num_compared = 256;  // chosen: points of a sweep, evenly spread; it costs nothing
  // A repeated sweep is not used where the body has moved by more than this since the one before.
  // Chosen: half a metre a second and 6 deg/s at 10 Hz; less may be the drift of a body that stands
  // in a simulator without noise.
  double moved_m = 0.05;
  double moved_rad = 0.01;
};

inline constexpr RepeatedSweepParameters kRepeatedSweep;

class RepeatedSweepDetector {
 public:
  // Are the points those of the sweep that was given before? Not so for one without points.
  [[nodiscard]] bool IsRepeated(const Sweep& sweep);

 private:
  std::size_t num_points_ = 0;
  std::vector<LidarPoint> compared_;
};

}  // namespace lio
