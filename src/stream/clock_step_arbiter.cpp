// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/clock_step_arbiter.hpp"

#include <algorithm>
#include <vector>

#include "stream/lone_clock_step.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {
namespace {

bool IsNearerAfter(const ClockStep& step, Timestamp stamp) {
  return Abs(stamp - step.after) < Abs(stamp - step.before);
}

}  // namespace

void ClockStepArbiter::Note(Timestamp chunk, std::optional<Timestamp> newest_imu) {
  chunks_.push_back(chunk);
  if (chunks_.size() > kClockStep.num_chunks) chunks_.pop_front();
  // While the inertial stream pauses nothing is learned of the lag.
  if (!newest_imu || newest_imu == newest_imu_) return;
  newest_imu_ = newest_imu;
  lags_.push_back(*newest_imu - chunk);
  if (lags_.size() > kClockStep.num_lags) lags_.pop_front();
}

bool ClockStepArbiter::SeesLidarAt(Timestamp imu) const {
  return !chunks_.empty() && Abs(imu - (chunks_.back() + Lag())) < kClockStep.silence;
}

Duration ClockStepArbiter::Lag() const {
  if (lags_.empty()) return {};
  return MedianOf({lags_.begin(), lags_.end()});
}

bool ClockStepArbiter::HasTimePassed(const ClockStep& step) const {
  if (chunks_.empty() || step.after < step.before) return false;
  for (std::size_t i = 1; i < chunks_.size(); ++i) {
    const Duration stride = chunks_[i] - chunks_[i - 1];
    if (stride + stride > step.after - step.before) return false;  // it has stepped itself
  }
  return IsNearerAfter(step, chunks_.back() + Lag());
}

StepVerdict ClockStepArbiter::Judge(const ClockStep& step, Timestamp chunk,
                                    Timestamp newest_imu) const {
  const Timestamp at_step = chunk + Lag() - (newest_imu - step.after);
  if (IsNearerAfter(step, at_step)) {
    const bool is_wild = Abs(at_step - step.after) > kClockStep.wild;
    return {is_wild ? LidarClock::kUnclear : LidarClock::kStepped, at_step};
  }
  const bool is_wild = Abs(at_step - step.before) > kClockStep.wild;
  const bool began_after = chunk > step.before + kClockStep.step_uncertainty;
  return {began_after && !is_wild ? LidarClock::kSteady : LidarClock::kUnclear, at_step};
}

}  // namespace lio
