// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds one inertial sample: angular rate and specific force in the imu frame, SI units.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "lio/base/rotation.hpp"
#include "lio/base/time.hpp"

namespace lio {

struct ImuSample {
  Timestamp stamp;
  Vector3 w_imu_radps = Vector3::Zero();  // angular rate of imu against an inertial frame, in imu
  Vector3 f_imu_mps2 = Vector3::Zero();   // specific force in imu: +g upward at rest
  bool is_rate_saturated = false;   // an axis is at the end of its range: the true rate is larger
  bool is_force_saturated = false;  // likewise for the force
  bool is_saturated() const { return is_rate_saturated || is_force_saturated; }
  // The true rate and force may be so far off, for all of a gap that a made-up sample fills, 1
  // sigma per axis. A measured one has zero.
  float made_up_w_std_radps = 0.f;
  float made_up_f_std_mps2 = 0.f;
  bool is_made_up() const { return made_up_w_std_radps > 0.f; }
  // It shows the motion as it was: no axis is at the end of its range, and it was sent.
  bool IsMeasured() const { return !is_made_up() && !is_saturated(); }
  std::int32_t seq = 0;  // the sender's number: one more for each sample, where it counts
};

[[nodiscard]] inline bool AreMeasured(std::span<const ImuSample> samples) {
  return std::ranges::all_of(samples, &ImuSample::IsMeasured);
}

}  // namespace lio
