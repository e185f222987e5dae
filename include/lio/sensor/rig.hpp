// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The fixed properties of a vehicle: where its sensors sit and how noisy they are. The extrinsic
// has no default, because a wrong one costs metres and looks like a bad filter.
#pragma once

#include <optional>
#include <string>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"

namespace lio {

// Points inside the box (lidar frame, m) are the vehicle itself.
struct OwnVehicleBox {
  Vector3 min_m = Vector3::Zero();
  Vector3 max_m = Vector3::Zero();
};

struct LidarRig {
  std::string model = "generic";  // a beam table in config/lidars/, or generic for none
  double min_range_m = 1.5;       // nearer returns are dropped: the sensor's housing, the roof
  double max_range_m = 120.0;     // farther returns are dropped
  double clock_offset_s = 0.0;    // imu clock = lidar clock + this
  std::optional<OwnVehicleBox> own_vehicle_box;
};

// Units of the inertial messages' specific force and rates. `automatic` detects units and axes
// (imu/imu_classifier.hpp).
enum class ImuUnits { kAutomatic, kSi, kG, kDeg, kGAndDeg };

// Whether the measured specific force contains gravity. `automatic` decides from the mean at rest.
enum class GravityInput { kAutomatic, kPresent, kRemoved };

// Noise of the IMU as continuous-time densities, one number for the three axes. Defaults: data
// sheet of the Xsens MTi-10, about doubled for vibration.
struct ImuRig {
  double gyro_noise_density = 1.0e-3;       // rad/s/sqrt(Hz)
  double accel_noise_density = 2.0e-3;      // m/s^2/sqrt(Hz)
  double gyro_bias_walk_density = 2.0e-5;   // rad/s^2/sqrt(Hz)
  double accel_bias_walk_density = 2.0e-4;  // m/s^3/sqrt(Hz)
  double gyro_bias_std_radps = 5.0e-3;      // turn-on bias before anything is known, 1 sigma
  double accel_bias_std_mps2 = 0.05;
  ImuUnits units = ImuUnits::kAutomatic;
  GravityInput gravity = GravityInput::kAutomatic;
};

struct Rig {
  std::optional<Pose> T_imu_lidar;  // p_imu = T_imu_lidar * p_lidar; required with an IMU
  // p_base = T_base_imu * p_imu: a frame of the vehicle whose motion is published, too.
  std::optional<Pose> T_base_imu;
  LidarRig lidar;
  ImuRig imu;
  double gravity_mps2 = 9.80665;
};

}  // namespace lio
