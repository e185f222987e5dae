// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How the numbers of an inertial message are to be understood: their units, and which way the axes
// point that they are given in.
#pragma once

#include <array>
#include <string>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

inline constexpr double kMaxGyroRate_radps = 100.0;  // beyond any gyro

struct ImuConvention {
  bool is_in_g = false;    // else m/s^2
  bool is_in_deg = false;  // else rad/s
  // From the axes of the messages to those that rig.T_imu_lidar is about: one of the 24 turns.
  Matrix3 R_imu_sent = Matrix3::Identity();

  bool operator==(const ImuConvention&) const = default;
  double force_scale() const;  // m/s^2 per unit sent
  double rate_scale() const;   // rad/s per unit sent
};

// The turns of a cube onto itself; the first is none at all.
inline constexpr std::size_t kNumQuarterTurns = 24;
std::array<Matrix3, kNumQuarterTurns> QuarterTurns();

// From a sample as sent to SI units in the axes of imu, and back.
ImuSample ToSi(const ImuConvention& reading, ImuSample sent);
ImuSample FromSi(const ImuConvention& reading, ImuSample sample);

// What configuration says of the units; SI where it leaves that open.
ImuConvention ConventionOf(ImuUnits units);
ImuUnits UnitsOf(const ImuConvention& reading);  // never kAutomatic; axes do not count

// For people: "accelerometer in g, gyro in deg/s, its x -y -z are the rig's x y z (z down)".
std::string Describe(const ImuConvention& reading);

}  // namespace lio
