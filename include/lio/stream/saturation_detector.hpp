// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Is a sensor of the IMU saturated, at the end of its range? Its axis then reads the very same
// value again and again while the others go on changing; the motion beyond the range is unknown.
#pragma once

#include <array>

#include "lio/sensor/imu_sample.hpp"

namespace lio {

class SaturationDetector {
 public:
  // Sets is_rate_saturated and is_force_saturated. Samples come in the order of their arrival; the
  // scales take their units to rad/s and m/s^2.
  void Mark(ImuSample& sample, double rate_scale = 1.0, double force_scale = 1.0);

 private:
  // Holds three axes of a sensor.
  struct Triad {
    Vector3 last = Vector3::Zero();
    std::array<int, 3> num_equal{};  // readings in a row that were the same, by axis

    bool IsSaturated(const Vector3& reading, double min_range);
  };

  Triad rates_;
  Triad forces_;
};

}  // namespace lio
