// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Stamps messages as clocks of their own and a busy host do: the truth has the IMU's mean clock.
#pragma once

#include <cstdint>

#include "lio/base/time.hpp"
#include "lio/sim/messages.hpp"

namespace lio::sim {

struct ClockErrors {
  // Stamps jitter by this, 1 sigma, cut at three: between a stamp of the sensor's hardware
  // (microseconds) and one of the host at receipt (a millisecond). An Xsens MTi counts its samples'
  // time in steps of 0.1 ms.
  double imu_jitter_std_s = 0.0;
  double lidar_jitter_std_s = 0.0;  // a chunk's
  // The lidar's clock runs at another rate than the IMU's by this, 1 sigma. The manual of the MTi
  // states 30 ppm at most for its clock, as usual for quartz.
  double drift_std_ratio = 0.0;
};

class Clocks {
 public:
  // Both clocks agree at `begin`.
  Clocks(const ClockErrors& errors, std::uint64_t seed, Timestamp begin);

  // Changes the message's stamp; a chunk keeps its points' offsets.
  void Stamp(Message& message) const;
  double drift_ratio() const { return drift_ratio_; }

 private:
  ClockErrors errors_;
  std::uint64_t seed_;
  Timestamp begin_;
  double drift_ratio_;
};

}  // namespace lio::sim
