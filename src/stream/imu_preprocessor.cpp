// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/imu_preprocessor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "lio/filter/sample_lookup.hpp"
#include "lio/sensor/gap.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {
namespace {

bool IsAsLong(double step_s, double as_s) {
  return as_s > 0.0 && std::abs(step_s - as_s) < std::min(kImuPreprocessor.max_set_right_error_s,
                                                          kImuPreprocessor.set_right_share * as_s);
}

}  // namespace

bool ImuPreprocessor::IsSane(const ImuSample& sample) {
  if (!sample.w_imu_radps.allFinite() || !sample.f_imu_mps2.allFinite()) {
    ++counters_->num_imu_nonfinite;
    counters_->ledgers.samples.Settle(SampleFate::kNonfinite);
    return false;
  }
  if (sample.w_imu_radps.norm() > max_rate_ ||
      sample.f_imu_mps2.norm() > kImuPreprocessor.max_force_mps2) {
    ++counters_->num_imu_out_of_range;
    counters_->ledgers.samples.Settle(SampleFate::kOutOfRange);
    return false;
  }
  return true;
}

bool ImuPreprocessor::IsFar(Timestamp stamp) const {
  return Abs(stamp - *newest_) > kImuGap.segment;
}

double ImuPreprocessor::MeanStep_s() const {
  if (recent_.size() < 2) return 0.0;
  return SecondsBetween(recent_.front().stamp, recent_.back().stamp) /
         static_cast<double>(recent_.size() - 1);
}

double ImuPreprocessor::ClockStepTo_s(Timestamp stamp) const {
  return SecondsBetween(*newest_, stamp) - MeanStep_s();
}

bool ImuPreprocessor::IsBehindHole(Timestamp stamp) const {
  return stamp - *newest_ > kImuGap.confirmed;
}

bool ImuPreprocessor::MayBeSetRight(Timestamp stamp) const {
  const Timestamp first = suspects_.empty() ? stamp : suspects_.front().stamp;
  return stamp >= first && IsAsLong(ClockStepTo_s(first), is_behind_s_);
}

// A sample contradicts the recent ones if its stamp lies where they leave no room for it, unless it
// is a copy of the one with its stamp.
bool ImuPreprocessor::Contradicts(const ImuSample& sample) const {
  const auto next = FirstNotBefore(recent_, sample.stamp);
  if (next == recent_.begin()) return true;  // it would have been told before the first that was
  if (next->stamp == sample.stamp) {
    return next->w_imu_radps != sample.w_imu_radps || next->f_imu_mps2 != sample.f_imu_mps2;
  }
  return SecondsBetween(std::prev(next)->stamp, next->stamp) <
         kImuPreprocessor.hole_in_mean_steps * MeanStep_s();
}

bool ImuPreprocessor::IsSuspect(const ImuSample& sample) const {
  if (!newest_) return false;
  if (IsFar(sample.stamp) || IsBehindHole(sample.stamp) || MayBeSetRight(sample.stamp)) return true;
  const Duration least = suspects_.empty() ? kImuPreprocessor.jitter : Duration{};
  return *newest_ - sample.stamp > least && Contradicts(sample);
}

std::vector<ImuSample> ImuPreprocessor::Release() {
  std::vector<ImuSample> released;
  for (const ImuSample& sample : std::exchange(suspects_, {})) {
    if (IsFar(sample.stamp)) {
      ++counters_->num_imu_out_of_range;
      counters_->ledgers.samples.Settle(SampleFate::kOutOfRange);
    } else {
      if (IsBehindHole(sample.stamp)) ++counters_->num_imu_gaps;
      released.push_back(sample);
      Accept(sample);
    }
  }
  return released;
}

ImuPreprocessor::Result ImuPreprocessor::Confirm() {
  Result result;
  const Timestamp first = suspects_.front().stamp;
  result.before = *newest_;
  result.clock_step_s = ClockStepTo_s(first);
  if (first < *newest_) {
    ++counters_->num_clock_jumps;
    result.step = Step::kSetBack;
    result.undoes_hole = IsAsLong(-result.clock_step_s, hole_s_);
    is_behind_s_ = result.undoes_hole ? 0.0 : is_behind_s_ - result.clock_step_s;
  } else if (MayBeSetRight(first)) {
    ++counters_->num_clock_jumps;
    result.step = Step::kSetRight;
    is_behind_s_ = 0.0;
  } else {
    ++counters_->num_imu_gaps;
    result.step = IsFar(first) ? Step::kGap : Step::kHole;
    is_behind_s_ = 0.0;
  }
  hole_s_ = result.step == Step::kHole ? result.clock_step_s : 0.0;
  result.accepted = std::exchange(suspects_, {});
  if (result.step != Step::kHole) {
    recent_.clear();
    newest_.reset();
  }
  step_after_ = first;
  for (const ImuSample& accepted : result.accepted) Accept(accepted);
  return result;
}

std::vector<ImuSample> ImuPreprocessor::Flush() {
  return newest_ ? Release() : std::vector<ImuSample>{};
}

void ImuPreprocessor::ForgetHole() {
  hole_s_ = 0.0;
}

void ImuPreprocessor::ShiftBy(Duration shift) {
  for (ImuSample& sample : recent_) {
    if (sample.stamp >= step_after_) sample.stamp = sample.stamp + shift;
  }
  newest_ = recent_.back().stamp;
  ForgetHole();
}

void ImuPreprocessor::Accept(const ImuSample& sample) {
  InsertByStamp(recent_, sample);
  if (!newest_ || sample.stamp > *newest_) newest_ = sample.stamp;
  while (*newest_ - recent_.front().stamp > kImuGap.segment ||
         recent_.size() > kStream.max_imu_samples) {
    recent_.pop_front();
  }
}

ImuPreprocessor::Result ImuPreprocessor::Add(const ImuSample& sample) {
  ++counters_->num_imu;
  if (!IsSane(sample)) return {};
  Result result;
  if (!suspects_.empty() && Abs(sample.stamp - suspects_.back().stamp) > kImuGap.confirmed) {
    result.accepted = Release();
  }
  if (!IsSuspect(sample)) {
    for (const ImuSample& held : Release()) result.accepted.push_back(held);
    Accept(sample);
    result.accepted.push_back(sample);
    return result;
  }
  suspects_.push_back(sample);
  if (suspects_.size() < kImuPreprocessor.confirmations) return result;
  return Confirm();
}

}  // namespace lio
