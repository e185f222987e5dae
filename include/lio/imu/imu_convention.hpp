// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The IMU convention: the units of an inertial message, and the direction of the axes it is given
// in. The standard gravity of data sheets, 9.80665 m/s^2, is 1 g. Nothing here throws.
#pragma once

#include <array>
#include <string>

#include "lio/imu/imu_convention_parameters.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

// rad/s. No gyro measures more: a larger rate is a fault, or in another unit.
inline constexpr double kMaxGyroRate_radps = kImuConventionParameters.max_gyro_rate_radps;

struct ImuConvention {
  bool is_in_g = false;    // else m/s^2
  bool is_in_deg = false;  // else rad/s
  // Rotates the axes of the messages into the imu axes of rig.T_imu_lidar: one of the 24 turns.
  Matrix3 R_imu_sent = Matrix3::Identity();

  bool operator==(const ImuConvention&) const = default;
  double force_scale() const;  // m/s^2 per unit sent
  double rate_scale() const;   // rad/s per unit sent
};

// A cube has so many rotations onto itself; the first is the identity.
inline constexpr std::size_t kNumQuarterTurns = 24;
std::array<Matrix3, kNumQuarterTurns> QuarterTurns();

// Converts a sample as sent to SI units in the axes of imu, and back.
ImuSample ToSi(const ImuConvention& convention, ImuSample sent);
ImuSample FromSi(const ImuConvention& convention, ImuSample sample);

// Returns the extrinsic for an imu whose axes are those of the messages, from one in the axes that
// they are read in.
Pose InAxesOfMessages(const Pose& T_imu_lidar, const ImuConvention& convention);

// Returns the convention that a configuration states; SI under kAutomatic.
ImuConvention ConventionOf(ImuUnits units);
ImuUnits UnitsOf(const ImuConvention& convention);  // never kAutomatic; ignores the axes

// A message to users: "accelerometer in g, gyro in deg/s, its x -y -z are the rig's x y z (z
// down)".
std::string Describe(const ImuConvention& convention);

}  // namespace lio
