// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/stream_stats.hpp"

#include <algorithm>
#include <cmath>

#include "lcm_wire.hpp"
#include "lio/base/median.hpp"

namespace lio {
namespace {

constexpr std::size_t kNumFirst = 400;
// A gap is longer than so many typical periods. Chosen. sensor/gap.hpp has the gaps that change the
// estimate; these here tell a person that a recording of any rate, 1 Hz or 1 kHz, lacks messages.
constexpr double kGapRatio = 3.0;

}  // namespace

Timestamp ReceiveStamp(std::int64_t utime) {
  return Timestamp::FromMicroseconds(std::clamp(utime, -kMaxUtime, kMaxUtime));
}

void StreamStats::Add(Timestamp stamp, Timestamp received) {
  ++num_;
  delay_sum_s_ += SecondsBetween(stamp, received);
  if (!first_) first_ = stamp;
  if (last_) {
    const double period = SecondsBetween(*last_, stamp);
    if (period <= 0.0) ++num_backwards_;
    longest_s_ = std::max(longest_s_, period);
    if (first_periods_s_.size() < kNumFirst) {
      first_periods_s_.push_back(period);
      if (first_periods_s_.size() == kNumFirst) typical_s_ = UpperMedian(first_periods_s_);
    } else if (period > kGapRatio * *typical_s_) {
      ++num_gaps_after_;
    }
  }
  last_ = stamp;
}

double StreamStats::TypicalPeriod() const {
  return typical_s_.value_or(UpperMedian(first_periods_s_));
}

double StreamStats::rate_hz() const {
  const double period = TypicalPeriod();
  if (num_ < 2 || period <= 0.0) return 0.0;
  // Without gaps the mean is more exact than the median.
  const double mean = span_s() / static_cast<double>(num_ - 1);
  constexpr double kClose = 0.02;
  return 1.0 / (std::abs(mean / period - 1.0) < kClose ? mean : period);
}

double StreamStats::span_s() const {
  return first_ ? SecondsBetween(*first_, *last_) : 0.0;
}

std::int64_t StreamStats::num_gaps() const {
  const double limit = kGapRatio * TypicalPeriod();
  return num_gaps_after_ + std::count_if(first_periods_s_.begin(), first_periods_s_.end(),
                                         [&](double period) { return period > limit; });
}

double StreamStats::mean_delay_s() const {
  return num_ == 0 ? 0.0 : delay_sum_s_ / static_cast<double>(num_);
}

void AccelerometerStats::Add(const ImuSample& sample) {
  if (!sample.f_imu_mps2.allFinite() || !sample.w_imu_radps.allFinite()) {
    ++num_nonfinite_;
    return;
  }
  largest_rate_ = std::max(largest_rate_, sample.w_imu_radps.norm());
  if (window_begin_ && SecondsBetween(*window_begin_, sample.stamp) >= 1.0) {
    CloseWindow();
    window_begin_.reset();
  }
  if (!window_begin_) window_begin_ = sample.stamp;
  const double length = sample.f_imu_mps2.norm();
  for (Window* window : {&all_, &window_}) {
    ++window->num;
    window->sum += length;
    window->sum_sq += length * length;
  }
}

void AccelerometerStats::CloseWindow() {
  const auto num = static_cast<double>(window_.num);
  constexpr std::int64_t kMinSamples = 10;
  if (window_.num >= kMinSamples) {
    const double mean = window_.sum / num;
    const double variance = std::max(0.0, window_.sum_sq / num - mean * mean);
    if (quiet_variance_ < 0.0 || variance < quiet_variance_) {
      quiet_variance_ = variance;
      quiet_mean_ = mean;
    }
  }
  window_ = Window{};
}

double AccelerometerStats::mean_mps2() const {
  return all_.num == 0 ? 0.0 : all_.sum / static_cast<double>(all_.num);
}

double AccelerometerStats::quiet_mean_mps2() const {
  return quiet_variance_ < 0.0 ? mean_mps2() : quiet_mean_;
}

std::string AccelerometerStats::Suggestion() const {
  if (all_.num == 0) return "no finite sample";
  const double quiet = quiet_mean_mps2();
  if (quiet > 9.0 && quiet < 10.6) return "specific force in m/s^2, gravity present";
  if (quiet > 0.92 && quiet < 1.08) {
    return "looks like units of g, not m/s^2: multiply by 9.80665 before use";
  }
  if (quiet < 0.6) return "gravity seems to be removed already: set rig.imu.gravity to removed";
  return "neither 9.8 (m/s^2) nor 1 (g) nor 0 (gravity removed): check the driver's unit";
}

}  // namespace lio
