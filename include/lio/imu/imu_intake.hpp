// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Decides what to believe of the inertial stream before anything is integrated: drops what is not
// finite, out of range or a repeat, and holds samples whose stamp jumps until the samples after
// them say whether one stamp was wrong or the clock has moved. Only stamps decide, never the wall
// clock.
#pragma once

#include <optional>
#include <vector>

#include "lio/imu/imu_reading.hpp"
#include "lio/pipeline/outputs.hpp"

namespace lio {

class ImuIntake {
 public:
  // Counts into `counters`, which outlives this. Rates beyond `max_rate`, in the samples' unit, are
  // no gyro's.
  explicit ImuIntake(Counters& counters, double max_rate = kMaxGyroRate_radps)
      : counters_(&counters), max_rate_(max_rate) {}

  struct Result {
    std::vector<ImuSample> accepted;  // mostly one; several when a jump is confirmed
    bool jumped = false;  // the samples begin a new stretch of time, after a gap or a step
  };
  Result Add(const ImuSample& sample);

 private:
  bool IsSane(const ImuSample& sample);

  Counters* counters_;
  double max_rate_;
  std::optional<Timestamp> newest_;
  std::vector<ImuSample> suspects_;  // on a new stretch of time, not yet believed
};

}  // namespace lio
