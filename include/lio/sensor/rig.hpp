// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The fixed properties of a vehicle: where its sensors sit and how noisy they are. The extrinsic
// has no default, because a wrong one costs metres and looks like a bad filter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"

namespace lio {

// Points inside the box (lidar frame, m) are the vehicle itself.
struct OwnVehicleBox {
  Vector3 min_m = Vector3::Zero();
  Vector3 max_m = Vector3::Zero();

  // Returns true on the sides, too. `point`: lidar frame, m.
  [[nodiscard]] bool Contains(const Vector3& point) const {
    return (point.array() >= min_m.array()).all() && (point.array() <= max_m.array()).all();
  }
};

// The errors of the lidar's beams as an earlier drive found them (sensor/beam_errors.hpp), measured
// minus true, and their standard deviations: lists by ring, lowest first, and the encoder's sine as
// cosine and sine of the azimuth. beams.yaml of a run has them in this form.
struct LidarBeams {
  std::vector<double> range_m;
  std::vector<double> range_std_m;
  std::vector<double> elevation_rad;
  std::vector<double> elevation_std_rad;
  std::vector<double> azimuth_rad;
  std::vector<double> azimuth_std_rad;
  std::vector<double> encoder_rad;  // 2
  std::vector<double> encoder_std_rad;
};

struct LidarRig {
  std::string model = "generic";  // a beam table in config/lidars/, or generic for none
  // Nearer returns are dropped: the sensor's housing, the roof. Chosen for cars; in an office 0.6 m
  // did no better (docs/experiments/narrow_places.md).
  double min_range_m = 1.5;
  // Farther returns are dropped. Data sheets: the HDL-64E and the OS1-64 report echoes up to there.
  double max_range_m = 120.0;
  double clock_offset_s = 0.0;  // imu clock = lidar clock + this; chosen: clocks that agree
  std::optional<OwnVehicleBox> own_vehicle_box;
  std::optional<LidarBeams> beams;  // absent: as the beam table says, to within the data sheet
};

// Units of the inertial messages' specific force and rates. `automatic` detects units and axes
// (imu/imu_classifier.hpp).
enum class ImuUnits { kAutomatic, kSi, kG, kDeg, kGAndDeg };

// Whether the measured specific force contains gravity. `automatic` decides from the mean at rest.
enum class GravityInput { kAutomatic, kPresent, kRemoved };

// Noise of the IMU as continuous-time densities, one number for the three axes.
struct ImuRig {
  // rad/s/sqrt(Hz), m/s^2/sqrt(Hz). White noise. Data sheet of the Xsens MTi-10 (5.2e-4, 7.9e-4),
  // about doubled for vibration.
  double gyro_noise_density = 1.0e-3;
  double accel_noise_density = 2.0e-3;
  // rad/s^2/sqrt(Hz), m/s^3/sqrt(Hz). Walk of the biases. Chosen: no data sheet has it; those of
  // the simulated MTi-10 (config/imus/xsens_mti10.yaml).
  double gyro_bias_walk_density = 2.0e-5;
  double accel_bias_walk_density = 2.0e-4;
  // Turn-on bias before anything is known, 1 sigma. Chosen: about twice the simulated MTi-10's.
  double gyro_bias_std_radps = 5.0e-3;
  double accel_bias_std_mps2 = 0.05;
  // Chosen: logs of all conventions start without a word of them.
  ImuUnits units = ImuUnits::kAutomatic;
  GravityInput gravity = GravityInput::kAutomatic;
};

// The pose of the lidar in the IMU's frame, p_imu = T_imu_lidar * p_lidar, and how well it is
// known: 1 sigma of each axis. The motion corrects what it surely contradicts, but never a part
// whose standard deviation is 0.
struct Extrinsic : Pose {
  Extrinsic() = default;
  Extrinsic(const Pose& pose) : Pose(pose) {}  // NOLINT: a pose is one of ordinary care
  // Chosen: a tape measure and an inclinometer.
  double std_m = 0.03;
  double std_deg = 1.0;
};

struct Rig {
  std::optional<Extrinsic> T_imu_lidar;  // required with an IMU
  // p_base = T_base_imu * p_imu: a frame of the vehicle whose motion is published, too.
  std::optional<Pose> T_base_imu;
  LidarRig lidar;
  ImuRig imu;
  double gravity_mps2 = 9.80665;  // standard gravity (CGPM 1901)
};

}  // namespace lio
