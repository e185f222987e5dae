// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the increment of a state between two neighbouring inertial samples, in the imu frame at the
// first of them and without gravity. This is the only integration rule; the filter's process model
// and preintegration both use it:
//
//   R1 = R0 turn,   v1 = v0 + g dt + R0 velocity,   p1 = p0 + v0 dt + g dt^2/2 + R0 position.
//
// Rate and specific force are linear between the samples. The turn comes from the mean rate and the
// coning term dt^2/12 (w0 x w1); velocity and position come from the force at both ends in the
// first imu frame, linear between. The rule is of second order: half of dt gives a quarter of the
// error.
#pragma once

#include "lio/base/rotation.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

struct InertialIncrement {
  double dt_s = 0.0;
  Quaternion turn = Quaternion::Identity();
  Vector3 velocity = Vector3::Zero();  // m/s
  Vector3 position = Vector3::Zero();  // m
};

// Holds the derivatives by the biases, 3x3 each. The turn's is on the right: turn(bg + d) = turn
// Exp(turn_by_gyro d).
struct IncrementByBias {
  Matrix3 turn_by_gyro;
  Matrix3 velocity_by_gyro, velocity_by_accel;
  Matrix3 position_by_gyro, position_by_accel;
};

// Biases are in rad/s and m/s^2, imu. Needs to.stamp >= from.stamp.
InertialIncrement MakeIncrement(const ImuSample& from, const ImuSample& to,
                                const Vector3& gyro_bias, const Vector3& accel_bias);
// The same, and fills the derivatives.
InertialIncrement MakeIncrement(const ImuSample& from, const ImuSample& to,
                                const Vector3& gyro_bias, const Vector3& accel_bias,
                                IncrementByBias& by_bias);

}  // namespace lio
