// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/saturation_detector.hpp"

#include <cmath>

namespace lio {
namespace {

constexpr int kMinEqual = 5;  // fewer may be chance, where readings are coarse
// No range is smaller. An axis that never reads anything, or gravity without noise, is not clipped.
constexpr double kMinRate_radps = 0.04;
constexpr double kMinForce_mps2 = 12.0;

}  // namespace

void SaturationDetector::Mark(ImuSample& sample, double rate_scale, double force_scale) {
  sample.is_rate_saturated = rates_.IsClipped(sample.w_imu_radps, kMinRate_radps / rate_scale);
  sample.is_force_saturated = forces_.IsClipped(sample.f_imu_mps2, kMinForce_mps2 / force_scale);
}

// Where all axes stay the same the driver repeats itself.
bool SaturationDetector::Triad::IsClipped(const Vector3& reading, double min_range) {
  const bool is_repeat = reading == last;
  bool is_clipped = false;
  for (std::size_t i = 0; i < num_equal.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (reading[axis] != last[axis]) {
      num_equal[i] = 0;
    } else if (!is_repeat) {
      ++num_equal[i];
    }
    is_clipped |= num_equal[i] >= kMinEqual - 1 && std::abs(reading[axis]) > min_range;
  }
  last = reading;
  return is_clipped;
}

}  // namespace lio
