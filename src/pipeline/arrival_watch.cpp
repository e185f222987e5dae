// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/arrival_watch.hpp"

#include <algorithm>
#include <vector>

namespace lio {
namespace {

// The step is somewhere between two inertial samples, which need not come on time.
constexpr Duration kUnsure{30'000'000};
constexpr std::size_t kNumLags = 9;  // the lidar may step a message earlier: their median counts

bool IsNearerAfter(const ClockStep& step, Timestamp stamp) {
  return Abs(stamp - step.after) < Abs(stamp - step.before);
}

}  // namespace

void ArrivalWatch::Note(Timestamp chunk, std::optional<Timestamp> newest_imu) {
  last_stride_ = last_chunk_ ? chunk - *last_chunk_ : Duration{};
  last_chunk_ = chunk;
  // While the inertial stream pauses nothing is learned of the lag.
  if (!newest_imu || newest_imu == newest_imu_) return;
  newest_imu_ = newest_imu;
  lags_.push_back(*newest_imu - chunk);
  if (lags_.size() > kNumLags) lags_.pop_front();
}

Duration ArrivalWatch::Lag() const {
  if (lags_.empty()) return {};
  std::vector<Duration> lags(lags_.begin(), lags_.end());
  const auto middle = lags.begin() + static_cast<std::ptrdiff_t>(lags.size() / 2);
  std::nth_element(lags.begin(), middle, lags.end());
  return *middle;
}

bool ArrivalWatch::HasTimePassed(const ClockStep& step) const {
  if (!last_chunk_ || step.after < step.before) return false;
  const bool has_stepped_itself = last_stride_ + last_stride_ > step.after - step.before;
  return !has_stepped_itself && IsNearerAfter(step, *last_chunk_ + Lag());
}

LidarClock ArrivalWatch::Judge(const ClockStep& step, Timestamp chunk, Timestamp newest_imu) const {
  const Timestamp at_step = chunk + Lag() - (newest_imu - step.after);
  if (IsNearerAfter(step, at_step)) return LidarClock::kStepped;
  return chunk > step.before + kUnsure ? LidarClock::kSteady : LidarClock::kUnclear;
}

}  // namespace lio
