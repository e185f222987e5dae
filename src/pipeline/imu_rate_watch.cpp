// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_rate_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

// Single samples that were lost do not change the median.
Duration MedianPeriod(std::span<const ImuSample> samples) {
  std::vector<Duration> periods;
  periods.reserve(samples.size());
  for (std::size_t i = 1; i < samples.size(); ++i) {
    periods.push_back(samples[i].stamp - samples[i - 1].stamp);
  }
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

}  // namespace

std::optional<std::string> ImuRateWatch::Add(std::span<const ImuSample> samples) {
  if (is_told_ || samples.size() < kImuRateWatch.min_samples) return std::nullopt;
  const Duration period = MedianPeriod(samples);
  if (period <= kImuGap.sparse) return std::nullopt;
  is_told_ = true;
  return fmt::format(
      "the IMU gives {:.0f} samples a second: motion between two of them looks like noise to the "
      "filter, so it is less certain than it could be; set the unit to 100 Hz or more if it can",
      1.0 / period.Seconds());
}

}  // namespace lio
