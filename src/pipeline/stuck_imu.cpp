// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/stuck_imu.hpp"

#include <algorithm>

namespace lio {
namespace {

double Reading(const ImuSample& sample, std::size_t axis) {
  const Vector3& triad = axis < 3 ? sample.w_imu_radps : sample.f_imu_mps2;
  return triad[static_cast<Eigen::Index>(axis % 3)];
}

bool IsSaturated(const ImuSample& sample, std::size_t axis) {
  return axis < 3 ? sample.is_rate_saturated : sample.is_force_saturated;
}

}  // namespace

bool StuckImuDetector::Axis::is_stuck() const {
  return num_changes >= kStuckImu.min_changes &&
         num_equal >=
             std::max<std::int64_t>(kStuckImu.min_samples, kStuckImu.times_longer * longest);
}

void StuckImuDetector::Add(const std::deque<ImuSample>& samples, Timestamp until) {
  if (samples.empty()) return;
  const auto after = [](Timestamp stamp, const ImuSample& sample) { return stamp < sample.stamp; };
  // After a clock was set back all samples are of the time since.
  const bool are_all_new = !last_ || samples.back().stamp < last_->stamp;
  auto next = are_all_new ? samples.begin()
                          : std::upper_bound(samples.begin(), samples.end(), last_->stamp, after);
  for (; next != samples.end() && next->stamp <= until; ++next) {
    if (!next->is_made_up()) Take(*next);
  }
}

void StuckImuDetector::Take(const ImuSample& sample) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Axis& axis = axes_[i];
    if (last_ && !IsSaturated(sample, i) && Reading(sample, i) == Reading(*last_, i)) {
      ++axis.num_equal;
      continue;
    }
    // A sensor that had stopped does not show how it is while it works.
    if (!axis.is_stuck()) axis.longest = std::max(axis.longest, axis.num_equal);
    axis.num_equal = 1;
    ++axis.num_changes;
    axis.before_row = last_.value_or(sample);
  }
  last_ = sample;
}

std::optional<StuckImuDetector::Stuck> StuckImuDetector::found() const {
  const auto stuck = std::ranges::find_if(axes_, &Axis::is_stuck);
  if (stuck == axes_.end()) return std::nullopt;
  const auto index = stuck - axes_.begin();
  return Stuck{.sensor = index < 3 ? ImuSensor::kGyro : ImuSensor::kAccelerometer,
               .axis_imu = Vector3::Unit(index % 3),
               .before = stuck->before_row};
}

}  // namespace lio
