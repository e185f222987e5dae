// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/saturation_detector.hpp"

#include <cmath>

#include "stream/stream_parameters.hpp"

namespace lio {
void SaturationDetector::Mark(ImuSample& sample, double rate_scale, double force_scale) {
  sample.is_rate_saturated =
      rates_.IsSaturated(sample.w_imu_radps, kSaturation.min_rate_radps / rate_scale);
  sample.is_force_saturated =
      forces_.IsSaturated(sample.f_imu_mps2, kSaturation.min_force_mps2 / force_scale);
}

// If all three axes stay the same, the driver repeats itself: that is no saturation.
bool SaturationDetector::Triad::IsSaturated(const Vector3& reading, double min_range) {
  const bool is_repeat = reading == last;
  bool is_saturated = false;
  for (std::size_t i = 0; i < num_equal.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (reading[axis] != last[axis]) {
      num_equal[i] = 0;
    } else if (!is_repeat) {
      ++num_equal[i];
    }
    is_saturated |=
        num_equal[i] >= kSaturation.min_equal - 1 && std::abs(reading[axis]) > min_range;
  }
  last = reading;
  return is_saturated;
}

}  // namespace lio
