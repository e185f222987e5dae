// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the error model of an IMU as its data file in config/imus/ describes it.
#pragma once

#include <string>

namespace lio::sim {

// Describes three equal axes of one kind; the unit is rad/s for a gyro and m/s^2 for an
// accelerometer.
struct InertialModel {
  double noise_density = 0.0;      // unit/sqrt(Hz)
  double bias_walk_density = 0.0;  // unit/s/sqrt(Hz)
  double bias_instability = 0.0;   // unit, 1 sigma of a first-order Gauss-Markov process
  double bias_instability_time_s = 300.0;
  double turn_on_bias_std = 0.0;  // unit
  double scale_std_ratio = 0.0;
  double misalignment_std_rad = 0.0;
  // A moving body vibrates by this: white from sample to sample, 1 sigma, per m/s of its speed.
  double vibration_std_per_mps = 0.0;  // unit s/m
  // The next three may be absent in a data file: 0. Each is 1 sigma of an axis.
  double bias_per_kelvin_std = 0.0;     // unit/K
  double bias_per_vibration_std = 0.0;  // unit per (m/s^2)^2 of vibration: rectification
  double bias_per_force_std = 0.0;      // unit per m/s^2 of specific force: g-sensitivity
  double full_scale = 0.0;              // unit; 0: no saturation
  double step = 0.0;                    // unit; 0: no quantization
};

struct ImuModel {
  std::string name;
  double rate_hz = 100.0;
  double warm_up_kelvin = 0.0;  // how much warmer it gets after it is switched on
  double warm_up_time_s = 200.0;
  InertialModel gyro;
  InertialModel accel;
};

// `name_or_path` is a model of config/imus/ or a file of that form. Throws std::runtime_error that
// says what is missing or wrong and lists the models.
[[nodiscard]] ImuModel LoadImuModel(const std::string& name_or_path);

}  // namespace lio::sim
