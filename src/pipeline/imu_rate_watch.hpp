// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells the user when the IMU samples too slowly to follow the motion: the filter goes on, but
// motion between two samples looks like noise to it.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "lio/base/time.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

struct ImuRateWatchParameters {
  Duration window{1'000'000'000};  // chosen: ten samples of the slowest units
  std::size_t min_samples = 8;     // chosen: fewer are a unit that has just begun
};

inline constexpr ImuRateWatchParameters kImuRateWatch;

class ImuRateWatch {
 public:
  // Looks at the samples of the window before a scan's end; returns what to announce, once.
  [[nodiscard]] std::optional<std::string> Add(const std::deque<ImuSample>& samples, Timestamp end);

 private:
  bool is_told_ = false;
};

}  // namespace lio
