// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_intake.hpp"

#include <utility>

namespace lio {
namespace {

constexpr double kMaxForce_mps2 = 2000.0;  // beyond any accelerometer (200 g)
constexpr Duration kJump{1'000'000'000};   // a longer step in stamps is a jump
constexpr Duration kSameStretch{200'000'000};
constexpr Duration kGap{200'000'000};
constexpr std::size_t kConfirmations = 5;

}  // namespace

bool ImuIntake::IsSane(const ImuSample& sample) {
  if (!sample.w_imu_radps.allFinite() || !sample.f_imu_mps2.allFinite()) {
    ++counters_->num_imu_nonfinite;
    return false;
  }
  if (sample.w_imu_radps.norm() > max_rate_ || sample.f_imu_mps2.norm() > kMaxForce_mps2) {
    ++counters_->num_imu_out_of_range;
    return false;
  }
  return true;
}

ImuIntake::Result ImuIntake::Add(const ImuSample& sample) {
  ++counters_->num_imu;
  if (!IsSane(sample)) return {};
  if (!newest_ || Abs(sample.stamp - *newest_) <= kJump) {
    counters_->num_imu_out_of_range += static_cast<std::int64_t>(suspects_.size());
    suspects_.clear();
    if (newest_ && sample.stamp - *newest_ > kGap) ++counters_->num_imu_gaps;
    if (!newest_ || sample.stamp > *newest_) newest_ = sample.stamp;
    return {{sample}, false};
  }
  if (!suspects_.empty() && Abs(sample.stamp - suspects_.back().stamp) > kSameStretch) {
    counters_->num_imu_out_of_range += static_cast<std::int64_t>(suspects_.size());
    suspects_.clear();
  }
  suspects_.push_back(sample);
  if (suspects_.size() < kConfirmations) return {};
  if (suspects_.front().stamp > *newest_) {
    ++counters_->num_imu_gaps;
  } else {
    ++counters_->num_clock_jumps;
  }
  Result result{std::exchange(suspects_, {}), true};
  newest_ = result.accepted.front().stamp;
  for (const ImuSample& accepted : result.accepted) {
    if (accepted.stamp > *newest_) newest_ = accepted.stamp;
  }
  return result;
}

}  // namespace lio
