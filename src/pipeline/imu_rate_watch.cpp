// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_rate_watch.hpp"

#include <fmt/format.h>

#include <vector>

#include "lio/base/median.hpp"
#include "lio/filter/sample_lookup.hpp"
#include "lio/sensor/gap.hpp"

namespace lio {

std::optional<std::string> ImuRateWatch::Add(const std::deque<ImuSample>& samples, Timestamp end) {
  if (is_told_) return std::nullopt;
  const auto from = FirstNotBefore(samples, end - kImuRateWatch.window);
  const auto to = FirstNotBefore(samples, end + Duration{1});
  const auto num = static_cast<std::size_t>(to - from);
  // Half of the periods are above their median, so that a window holds few of a slow unit.
  const bool is_fast = 0.5 * static_cast<double>(num) * kImuGap.sparse.Seconds() >
                       kImuRateWatch.window.Seconds() + kImuGap.sparse.Seconds();
  if (is_fast || num < kImuRateWatch.min_samples) return std::nullopt;
  std::vector<double> periods_s;
  for (auto sample = from; sample + 1 != to; ++sample) {
    periods_s.push_back(SecondsBetween(sample->stamp, (sample + 1)->stamp));
  }
  // Single samples that were lost do not change the median.
  const double period_s = UpperMedian(std::move(periods_s));
  if (period_s <= kImuGap.sparse.Seconds()) return std::nullopt;
  is_told_ = true;
  return fmt::format(
      "the IMU gives {:.0f} samples a second: motion between two of them looks like noise to the "
      "filter, so it is less certain than it could be; set the unit to 100 Hz or more if it can",
      1.0 / period_s);
}

}  // namespace lio
