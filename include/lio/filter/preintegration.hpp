// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns the inertial samples of an interval into one measurement of relative motion. Its
// derivatives by the biases are kept, so that it need not be integrated again when the estimated
// biases change.
//
//   R_to = R_from rotation,  v_to = v_from + g t + R_from velocity,
//   p_to = p_from + v_from t + g t^2/2 + R_from position,   t = to - from.
//
// Errors are ordered as in the filter's state: position (m), rotation (rad, right), velocity (m/s).
// Integration: filter/inertial_increment.hpp. Noise: white densities; the biases count as constant.
// Source: Forster et al., "On-Manifold Preintegration", TRO 2017, sections V and VI.
#pragma once

#include <span>

#include "lio/filter/process_model.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

struct Preintegration {
  Timestamp from;
  Timestamp to;
  Quaternion rotation = Quaternion::Identity();
  Vector3 velocity = Vector3::Zero();    // m/s, in imu at `from`, without gravity
  Vector3 position = Vector3::Zero();    // m, likewise
  Vector3 gyro_bias = Vector3::Zero();   // subtracted from the samples, rad/s
  Vector3 accel_bias = Vector3::Zero();  // likewise, m/s^2
  // Rows are in error order; columns are gyro bias (rad/s), accel bias (m/s^2).
  Eigen::Matrix<double, 9, 6> by_bias = Eigen::Matrix<double, 9, 6>::Zero();
  Eigen::Matrix<double, 9, 9> cov = Eigen::Matrix<double, 9, 9>::Zero();

  double span_s() const { return SecondsBetween(from, to); }
};

struct Biases {
  Vector3 gyro = Vector3::Zero();   // rad/s
  Vector3 accel = Vector3::Zero();  // m/s^2
};

// `samples` ascend in time. The signal is linear between them and constant before the first and
// after the last. Throws std::invalid_argument without samples or when `to` is before `from`.
Preintegration Preintegrate(std::span<const ImuSample> samples, Timestamp from, Timestamp to,
                            const Biases& biases, const ProcessNoise& noise);

}  // namespace lio
