// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/clock_offset.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lio/base/chi_square.hpp"
#include "lio/filter/preintegration.hpp"
#include "lio/filter/sample_lookup.hpp"
#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

constexpr ClockOffsetParameters kParameters = kFilterParameters.clock_offset;

// The change of rate between two scans that must be exceeded, rad/s: below it the change may be
// the gyro's noise or the vehicle's vibration.
double MinRateChange(std::span<const ImuSample> samples, const ImuRig& imu) {
  const double span_s = SecondsBetween(samples.front().stamp, samples.back().stamp);
  const double noise_radps =
      imu.gyro_noise_density * std::sqrt(static_cast<double>(samples.size()) / span_s);
  return std::max(kParameters.min_rate_change_radps,
                  kParameters.min_rate_change_in_noise * noise_radps);
}

}  // namespace

double ClockOffset::std_s() const {
  return std::sqrt(var_s2_);
}

void ClockOffset::Interrupt() {
  last_.reset();
  samples_.clear();
}

void ClockOffset::Add(const Scan& scan, std::span<const ImuSample> samples) {
  for (const ImuSample& sample : samples) {
    if (samples_.empty() || sample.stamp > samples_.back().stamp) samples_.push_back(sample);
  }
  if (last_ && scan.stamp > last_->stamp) Update(scan);
  Follow();
  last_ = scan;
  const Timestamp begin = scan.stamp - kScanGap.unrelated;
  while (!samples_.empty() && samples_.front().stamp < begin) samples_.pop_front();
}

void ClockOffset::Update(const Scan& scan) {
  const double span_s = SecondsBetween(last_->stamp, scan.stamp);
  var_s2_ =
      std::min(var_s2_ + kParameters.walk_s_per_sqrt_s * kParameters.walk_s_per_sqrt_s * span_s,
               kParameters.max_std_s * kParameters.max_std_s);
  if (scan.stamp - last_->stamp > kScanGap.unrelated || samples_.size() < 3) return;
  const std::vector<ImuSample> samples(samples_.begin(), samples_.end());
  ProcessNoise noise;
  noise.gyro_density = imu_.gyro_noise_density;
  const Preintegration gyro =
      Preintegrate(samples, last_->stamp, scan.stamp, {scan.gyro_bias, Vector3::Zero()}, noise);
  const Quaternion matched = last_->R_map_imu.conjugate() * scan.R_map_imu;
  const Vector3 residual = LogSo3(gyro.rotation.conjugate() * matched);
  const Vector3 w = SampleAt(samples, scan.stamp).w_imu_radps - scan.gyro_bias;
  const Vector3 w_last =
      gyro.rotation.conjugate() * (SampleAt(samples, last_->stamp).w_imu_radps - scan.gyro_bias);
  const Vector3 h = w - w_last;
  if (h.norm() < MinRateChange(samples, imu_)) return;

  const Vector3 innovation =
      residual + w * scan.moved_by_s - w_last * last_->moved_by_s - h * offset_s_;
  const double turn_var = scan.rotation_var + last_->rotation_var +
                          kParameters.turn_std_rad * kParameters.turn_std_rad +
                          imu_.gyro_noise_density * imu_.gyro_noise_density * span_s;
  const Matrix3 S = var_s2_ * h * h.transpose() + turn_var * Matrix3::Identity();
  const Vector3 weighted = S.inverse() * innovation;
  if (innovation.dot(weighted) > kChiSquare3At999) return;
  offset_s_ = std::clamp(offset_s_ + var_s2_ * h.dot(weighted), -kMax_s, kMax_s);
  var_s2_ = 1.0 / (1.0 / var_s2_ + h.squaredNorm() / turn_var);
}

void ClockOffset::Follow() {
  const bool is_known = std_s() <= kParameters.known_std_s;
  const bool is_sure = std::abs(offset_s_ - move_by_s_) > kParameters.sure_sigmas * std_s();
  if (!is_known && !is_sure) return;
  move_by_s_ += std::clamp(offset_s_ - move_by_s_, -kParameters.max_step_s, kParameters.max_step_s);
}

}  // namespace lio
