// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/imu_noise_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lio {

ImuNoiseRatios NoiseRatiosOf(const ImuNoise& noise, const ImuRig& rig) {
  return {std::sqrt(noise.gyro_psd.maxCoeff()) / rig.gyro_noise_density,
          std::sqrt(noise.accel_psd.maxCoeff()) / rig.accel_noise_density};
}

ImuRig RaisedTo(const ImuNoise& shown, ImuRig rig) {
  rig.gyro_noise_density = std::max(rig.gyro_noise_density, std::sqrt(shown.gyro_psd.maxCoeff()));
  rig.accel_noise_density =
      std::max(rig.accel_noise_density, std::sqrt(shown.accel_psd.maxCoeff()));
  return rig;
}

bool ImuNoiseWatch::IsNews(double ratio, Sensor& sensor) {
  if (ratio < std::max(kImuNoiseWatch.min_ratio, kImuNoiseWatch.tell_again * sensor.told)) {
    sensor.num_in_row = 0;
    return false;
  }
  sensor.least_lately = sensor.num_in_row == 0 ? ratio : std::min(sensor.least_lately, ratio);
  if (++sensor.num_in_row < kImuNoiseWatch.min_scans_in_row) return false;
  sensor.told = sensor.least_lately;
  sensor.num_in_row = 0;
  return true;
}

std::optional<std::string> ImuNoiseWatch::Add(const ImuNoiseRatios& ratios) {
  const bool is_gyro_news = IsNews(ratios.gyro, gyro_);
  const bool is_accel_news = IsNews(ratios.accel, accel_);
  if (!is_gyro_news && !is_accel_news) return std::nullopt;
  const auto part = [](const char* name, const Sensor& sensor) {
    return fmt::format("{} is {:.0f} times noisier", name, sensor.told);
  };
  std::string what = is_accel_news ? part("accelerometer", accel_) : part("gyro", gyro_);
  if (is_gyro_news && is_accel_news) what += " and the " + part("gyro", gyro_);
  return fmt::format("the {} than the rig says: vibration; the filter takes what it shows", what);
}

}  // namespace lio
