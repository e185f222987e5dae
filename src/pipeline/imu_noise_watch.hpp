// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells the user when the IMU is much noisier than the rig says: mostly vibration, seldom a wrong
// entry. The filter uses what the samples show either way (imu/imu_noise_estimator.hpp).
#pragma once

#include <optional>
#include <string>

#include "lio/sensor/imu_noise.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

[[nodiscard]] ImuNoiseRatios NoiseRatiosOf(const ImuNoise& noise, const ImuRig& rig);
// Returns the rig with its densities raised to the noise that the samples show on the noisiest
// axis.
[[nodiscard]] ImuRig RaisedTo(const ImuNoise& shown, ImuRig rig);

struct ImuNoiseWatchParameters {
  double min_ratio = 3.0;     // chosen: less is within what data sheets leave open
  double tell_again = 3.0;    // said again when it has grown by so much; chosen: as min_ratio
  int min_scans_in_row = 20;  // chosen: two seconds at 10 Hz; a kerb is no vibration
};

inline constexpr ImuNoiseWatchParameters kImuNoiseWatch;

class ImuNoiseWatch {
 public:
  // Takes the ratios at a scan; returns what to announce.
  [[nodiscard]] std::optional<std::string> Add(const ImuNoiseRatios& ratios);

 private:
  struct Sensor {
    double told = 0.0;        // the ratio that was announced last
    double least_lately = 0;  // the least ratio in the present row of scans much noisier than told
    int num_in_row = 0;
  };
  static bool IsNews(double ratio, Sensor& sensor);

  Sensor gyro_;
  Sensor accel_;
};

}  // namespace lio
