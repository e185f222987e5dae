// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "filter/inertial_increment.hpp"

namespace lio {
namespace {

// Holds bias-corrected samples at both ends of the step.
struct Ends {
  double dt_s;
  Vector3 rotation;     // rotation vector of the turn
  Vector3 rate_change;  // second sample minus the first, rad/s
  Vector3 force0;       // specific force at both ends, each in its own imu frame, m/s^2
  Vector3 force1;
};

Ends MakeEnds(const ImuSample& from, const ImuSample& to, const Vector3& gyro_bias,
              const Vector3& accel_bias) {
  Ends ends;
  ends.dt_s = SecondsBetween(from.stamp, to.stamp);
  const Vector3 w0 = from.w_imu_radps - gyro_bias;
  const Vector3 w1 = to.w_imu_radps - gyro_bias;
  ends.rotation = 0.5 * ends.dt_s * (w0 + w1) + ends.dt_s * ends.dt_s / 12.0 * w0.cross(w1);
  ends.rate_change = w1 - w0;
  ends.force0 = from.f_imu_mps2 - accel_bias;
  ends.force1 = to.f_imu_mps2 - accel_bias;
  return ends;
}

InertialIncrement Integrate(const Ends& ends, const Quaternion& turn, const Vector3& force1_in_0) {
  const double dt = ends.dt_s;
  return {dt, turn, 0.5 * dt * (ends.force0 + force1_in_0),
          dt * dt / 6.0 * (2.0 * ends.force0 + force1_in_0)};
}

}  // namespace

InertialIncrement MakeIncrement(const ImuSample& from, const ImuSample& to,
                                const Vector3& gyro_bias, const Vector3& accel_bias) {
  const Ends ends = MakeEnds(from, to, gyro_bias, accel_bias);
  const Quaternion turn = ExpSo3(ends.rotation);
  return Integrate(ends, turn, turn * ends.force1);
}

InertialIncrement MakeIncrement(const ImuSample& from, const ImuSample& to,
                                const Vector3& gyro_bias, const Vector3& accel_bias,
                                IncrementByBias& by_bias) {
  const Ends ends = MakeEnds(from, to, gyro_bias, accel_bias);
  const Quaternion turn = ExpSo3(ends.rotation);
  const Matrix3 R = turn.toRotationMatrix();
  const double dt = ends.dt_s;
  const Matrix3 rotation_by_gyro =
      dt * dt / 12.0 * Hat(ends.rate_change) - dt * Matrix3::Identity();
  by_bias.turn_by_gyro = RightJacobianSo3(ends.rotation) * rotation_by_gyro;
  const Matrix3 force1_by_gyro = -R * Hat(ends.force1) * by_bias.turn_by_gyro;
  by_bias.velocity_by_gyro = 0.5 * dt * force1_by_gyro;
  by_bias.position_by_gyro = dt * dt / 6.0 * force1_by_gyro;
  by_bias.velocity_by_accel = -0.5 * dt * (Matrix3::Identity() + R);
  by_bias.position_by_accel = -dt * dt / 6.0 * (2.0 * Matrix3::Identity() + R);
  return Integrate(ends, turn, R * ends.force1);
}

}  // namespace lio
