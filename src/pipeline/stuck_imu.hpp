// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Has an axis of the IMU stopped, so that it reads the very same value again and again? Noise moves
// the last digit of any sensor, in some more seldom than in others: how seldom is learned from the
// samples before. An axis at the end of its range is another thing
// (stream/saturation_detector.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "lio/sensor/imu_sample.hpp"

namespace lio {

struct StuckImuParameters {
  // An axis has stopped that reads the same for so many samples, ... Chosen: half a scan at 100 Hz,
  // before matching loses the way of a hand that turns.
  int min_samples = 5;
  // ... and for so many times longer than it ever did. Chosen: a sensor whose noise is below its
  // last digit repeats itself by chance, seldom five times longer than it has in some seconds.
  int times_longer = 5;
  // An axis that has changed less often, as in a simulator without noise, tells nothing by standing
  // still. Chosen: two seconds at 100 Hz.
  int min_changes = 200;
};

inline constexpr StuckImuParameters kStuckImu;

enum class ImuSensor : std::int8_t { kGyro, kAccelerometer };

class StuckImuDetector {
 public:
  // Takes those samples up to `until` that are newer than the ones before.
  void Add(const std::deque<ImuSample>& samples, Timestamp until);

  struct Stuck {
    ImuSensor sensor = ImuSensor::kGyro;
    Vector3 axis_imu = Vector3::UnitX();
    ImuSample before;  // the last sample that is not in doubt
  };
  [[nodiscard]] std::optional<Stuck> found() const;

 private:
  struct Axis {
    std::int64_t num_equal = 0;  // readings in a row that were the same, the newest one included
    std::int64_t longest = 1;    // such a row that has ended
    std::int64_t num_changes = 0;
    ImuSample before_row;  // the last sample before this row's first one
    [[nodiscard]] bool is_stuck() const;
  };
  void Take(const ImuSample& sample);

  std::array<Axis, 6> axes_;  // the gyro has the first three
  std::optional<ImuSample> last_;
};

}  // namespace lio
