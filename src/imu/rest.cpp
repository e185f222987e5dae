// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/rest.hpp"

#include <algorithm>
#include <cmath>

namespace lio {

ImuStatistics Summarise(std::span<const ImuSample> samples) {
  ImuStatistics statistics;
  statistics.num_samples = static_cast<int>(samples.size());
  if (samples.empty()) return statistics;
  statistics.span_s = SecondsBetween(samples.front().stamp, samples.back().stamp);
  const auto n = static_cast<double>(samples.size());
  for (const ImuSample& sample : samples) {
    statistics.mean_w_radps += sample.w_imu_radps / n;
    statistics.mean_f_mps2 += sample.f_imu_mps2 / n;
  }
  Vector3 w_sq = Vector3::Zero();
  Vector3 f_sq = Vector3::Zero();
  for (const ImuSample& sample : samples) {
    w_sq += (sample.w_imu_radps - statistics.mean_w_radps).cwiseAbs2() / n;
    f_sq += (sample.f_imu_mps2 - statistics.mean_f_mps2).cwiseAbs2() / n;
  }
  statistics.gyro_std_radps = std::sqrt(w_sq.maxCoeff());
  statistics.accel_std_mps2 = std::sqrt(f_sq.maxCoeff());
  return statistics;
}

bool IsCalm(const ImuStatistics& statistics, const ImuRig& imu, const VibrationLevel& vibration) {
  const double root_step = std::sqrt(statistics.span_s / std::max(1, statistics.num_samples - 1));
  const auto limit = [&](double density, double vibration_std) {
    return kRest.max_spread_ratio * std::hypot(density / root_step, vibration_std);
  };
  return statistics.gyro_std_radps < limit(imu.gyro_noise_density, vibration.gyro_std_radps) &&
         statistics.accel_std_mps2 < limit(imu.accel_noise_density, vibration.accel_std_mps2);
}

}  // namespace lio
