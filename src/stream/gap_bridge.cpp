// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/gap_bridge.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lio/filter/sample_lookup.hpp"
#include "lio/imu/rest.hpp"
#include "stream/stream_parameters.hpp"

namespace lio {
namespace {

std::vector<ImuSample> MeasuredSince(Timestamp from, const std::deque<ImuSample>& sent,
                                     const ImuConvention& convention) {
  std::vector<ImuSample> measured;
  for (auto at = FirstNotBefore(sent, from); at != sent.end(); ++at) {
    const bool is_readable = ToSi(convention, *at).w_imu_radps.norm() <= kMaxGyroRate_radps;
    if (is_readable && !at->is_made_up()) measured.push_back(*at);
  }
  return measured;
}

// Returns the root mean square of one axis, from `mean`. It is never zero, so that a made-up sample
// is told from a measured one.
float StdAround(const Vector3& mean, const std::vector<ImuSample>& samples,
                Vector3 ImuSample::*value) {
  double sum_sq = kStream.min_made_up_std * kStream.min_made_up_std;
  for (const ImuSample& sample : samples) sum_sq += (sample.*value - mean).squaredNorm();
  return static_cast<float>(std::sqrt(sum_sq / (3.0 * static_cast<double>(1 + samples.size()))));
}

// Returns the time in which the correlation of the rates with later ones falls to 1/e, by that at
// one lag. It is zero where they hardly change.
double CorrelationTime_s(const Vector3& mean_w, const std::vector<ImuSample>& samples) {
  double covariance = 0.0;
  double variance = kStream.min_made_up_std * kStream.min_made_up_std;
  const double least_covariance = variance;
  auto later = samples.begin();
  for (const ImuSample& sample : samples) {
    const Timestamp at = sample.stamp + kStream.correlation_lag;
    while (later != samples.end() && later->stamp < at) ++later;
    if (later == samples.end()) break;
    const Vector3 deviation = sample.w_imu_radps - mean_w;
    covariance += deviation.dot(later->w_imu_radps - mean_w);
    variance += deviation.squaredNorm();
  }
  if (covariance <= least_covariance) return 0.0;
  const double correlation = std::min(covariance / variance, kStream.max_correlation);
  return -kStream.correlation_lag.Seconds() / std::log(correlation);
}

}  // namespace

GapBridge::GapBridge(const std::deque<ImuSample>& sent, const ImuConvention& convention)
    : last_(sent.back()), mean_(sent.back()) {
  const Timestamp from = last_.stamp - Duration::FromSeconds(kStream.mean_before_gap_s);
  const ImuStatistics before =
      Summarise(std::vector<ImuSample>(FirstNotBefore(sent, from), sent.cend()));
  mean_.w_imu_radps = before.mean_w_radps;
  mean_.f_imu_mps2 = before.mean_f_mps2;
  const std::vector<ImuSample> measured = MeasuredSince(
      last_.stamp - Duration::FromSeconds(kStream.spread_before_gap_s), sent, convention);
  mean_.made_up_w_std_radps = StdAround(mean_.w_imu_radps, measured, &ImuSample::w_imu_radps);
  mean_.made_up_f_std_mps2 = StdAround(mean_.f_imu_mps2, measured, &ImuSample::f_imu_mps2);
  correlation_time_s_ = CorrelationTime_s(mean_.w_imu_radps, measured);
}

ImuSample GapBridge::At(Timestamp stamp) const {
  ImuSample sample = mean_;
  sample.stamp = stamp;
  sample.w_imu_radps += KeptAt(stamp) * (last_.w_imu_radps - mean_.w_imu_radps);
  return sample;
}

// The integral of the kept share is the correlation time times its decrease.
ImuSample GapBridge::BeginLine(Timestamp from, Timestamp to) const {
  const double integral_s = correlation_time_s_ * (KeptAt(from) - KeptAt(to));
  const double kept = 2.0 * integral_s / SecondsBetween(from, to) - KeptAt(to);
  ImuSample sample = mean_;
  sample.stamp = from;
  sample.w_imu_radps += kept * (last_.w_imu_radps - mean_.w_imu_radps);
  return sample;
}

double GapBridge::KeptAt(Timestamp stamp) const {
  if (correlation_time_s_ <= 0.0) return 0.0;
  return std::exp(-SecondsBetween(last_.stamp, stamp) / correlation_time_s_);
}

}  // namespace lio
