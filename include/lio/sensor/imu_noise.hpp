// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the white noise of an IMU as power spectral densities, per axis of imu: densities squared.
// It is zero where it is not known.
#pragma once

#include "lio/base/rotation.hpp"

namespace lio {

struct ImuNoise {
  Vector3 gyro_psd = Vector3::Zero();   // (rad/s)^2/Hz
  Vector3 accel_psd = Vector3::Zero();  // (m/s^2)^2/Hz
};

// Tells how many times the noise density that the samples show is that of the rig, on the noisiest
// axis; zero where it is not known.
struct ImuNoiseRatios {
  double gyro = 0.0;
  double accel = 0.0;
};

}  // namespace lio
