// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/lidar_clock_corrector.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "stream/lone_clock_step.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {

std::vector<LidarClockCorrector::Arrival> LidarClockCorrector::Add(Arrival arrival,
                                                                   Timestamp newest_imu) {
  arrival.chunk.stamp = PutRight(arrival.chunk.stamp);
  const Judgement judgement = Judge(arrival.chunk, newest_imu);
  held_.push_back(std::move(arrival));
  if (judgement == Judgement::kUnclear && !HasHeldTooLong()) return {};
  if (judgement == Judgement::kUnclear) Forget();
  if (judgement == Judgement::kStepped) ShiftBack();
  return GiveOut();
}

std::vector<LidarClockCorrector::Arrival> LidarClockCorrector::GiveOut() {
  if (!held_.empty()) newest_ = held_.back().chunk.stamp;
  return std::exchange(held_, {});
}

// So it is where no inertial samples come any more.
bool LidarClockCorrector::HasHeldTooLong() const {
  const Duration held = held_.back().chunk.stamp - held_.front().chunk.stamp;
  const std::size_t num_points = std::accumulate(
      held_.begin(), held_.end(), std::size_t{0},
      [](std::size_t num, const Arrival& arrival) { return num + arrival.chunk.points.size(); });
  return held > kLidarClock.max_held || held_.size() > kLidarClock.max_num_held ||
         num_points > kLidarClock.max_points_held;
}

std::vector<LidarClockCorrector::Arrival> LidarClockCorrector::Release() {
  Forget();
  newest_imu_.reset();
  return GiveOut();
}

std::vector<LidarClockCorrector::Arrival> LidarClockCorrector::Release(Arrival arrival) {
  arrival.chunk.stamp = PutRight(arrival.chunk.stamp);
  held_.push_back(std::move(arrival));
  return Release();
}

LidarClockCorrector::Judgement LidarClockCorrector::Judge(const ScanChunk& chunk,
                                                          Timestamp newest_imu) {
  const bool is_in_burst = newest_imu_ == newest_imu;
  if (is_in_burst) return elsewhere_.empty() ? Judgement::kSteady : Judgement::kUnclear;
  const std::optional<Timestamp> before = std::exchange(newest_imu_, newest_imu);
  const Duration lag = newest_imu - chunk.stamp;
  const Duration last{chunk.points.empty() ? 0 : chunk.points.back().t_offset_ns};
  if (!before) {
    late_by_ = lag - last;
    return Judgement::kSteady;
  }
  const Sight sight{lag, newest_imu - *before, lag - last};
  if (known_.size() < kLidarClock.num_known || !IsElsewhere(sight.lag, UsualLag())) {
    elsewhere_.clear();
    known_.push_back(sight);
    if (known_.size() > kLidarClock.num_known) known_.pop_front();
    late_by_ = Usual(&Sight::late_by);
    return Judgement::kSteady;
  }
  return JudgeElsewhere(sight, newest_imu);
}

LidarClockCorrector::Judgement LidarClockCorrector::JudgeElsewhere(const Sight& sight,
                                                                   Timestamp newest_imu) {
  if (elsewhere_.empty()) elsewhere_since_ = newest_imu;
  const bool has_moved_again = !elsewhere_.empty() && IsElsewhere(sight.lag, elsewhere_.front());
  if (has_moved_again || (elsewhere_.empty() && HasPaused(sight))) {
    Forget();
    return Judgement::kSteady;
  }
  elsewhere_.push_back(sight.lag);
  if (newest_imu - elsewhere_since_ < kLidarClock.confirmed_after ||
      elsewhere_.size() < kLidarClock.num_confirmations) {
    return Judgement::kUnclear;
  }
  // Clocks that were apart and now agree have been set right.
  const bool is_set_right =
      Abs(UsualLag()) > kLidarClock.usual_lag && Abs(MedianOf(elsewhere_)) < Abs(UsualLag());
  if (!is_set_right) return Judgement::kStepped;
  Forget();
  return Judgement::kSteady;
}

void LidarClockCorrector::ShiftBack() {
  const Duration by = UsualLag() - MedianOf(elsewhere_);
  Duration shift = shift_ - by;
  if (Abs(shift) < kLidarClock.least_step) shift = {};  // it was set back to what it had been
  for (Arrival& arrival : held_) arrival.chunk.stamp = arrival.chunk.stamp + (shift - shift_);
  shift_ = shift;
  elsewhere_.clear();
  step_ = Step{held_.front().chunk.stamp, by, shift};
}

void LidarClockCorrector::Forget() {
  known_.clear();
  elsewhere_.clear();
}

Duration LidarClockCorrector::Usual(Duration Sight::*quantity) const {
  std::vector<Duration> values;
  std::ranges::transform(known_, std::back_inserter(values), quantity);
  return MedianOf(std::move(values));
}

bool LidarClockCorrector::HasPaused(const Sight& sight) const {
  return sight.stride.Seconds() > kLidarClock.pause_in_strides * Usual(&Sight::stride).Seconds();
}

// The lags of one clock spread by themselves, as drivers deliver.
bool LidarClockCorrector::IsElsewhere(Duration lag, Duration from) const {
  const auto [least, most] = std::ranges::minmax(known_, {}, &Sight::lag);
  return Abs(lag - from) > kLidarClock.least_step + (most.lag - least.lag);
}

}  // namespace lio
