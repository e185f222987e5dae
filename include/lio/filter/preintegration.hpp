// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The inertial samples of a stretch of time as one measurement of relative motion, whose dependence
// on the biases is known to first order, so that it need not be integrated again when they change.
//
//   R_to = R_from rotation,  v_to = v_from + g t + R_from velocity,
//   p_to = p_from + v_from t + g t^2/2 + R_from position,   t = to - from.
//
// Error order as in the filter's state: position (m), rotation (rad, right), velocity (m/s).
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
  Vector3 velocity = Vector3::Zero();   // m/s, in imu at `from`, without gravity
  Vector3 position = Vector3::Zero();   // m, likewise
  Vector3 gyro_bias = Vector3::Zero();  // what the samples were corrected by
  Vector3 accel_bias = Vector3::Zero();
  // Rows in error order; columns gyro bias, accel bias.
  Eigen::Matrix<double, 9, 6> by_bias = Eigen::Matrix<double, 9, 6>::Zero();
  Eigen::Matrix<double, 9, 9> cov = Eigen::Matrix<double, 9, 9>::Zero();

  double span_s() const { return SecondsBetween(from, to); }
};

struct Biases {
  Vector3 gyro = Vector3::Zero();   // rad/s
  Vector3 accel = Vector3::Zero();  // m/s^2
};

// `samples` ascend in time; between them the reading is linear, before the first and after the last
// it is held. Throws std::invalid_argument without samples or when `to` is before `from`.
Preintegration Preintegrate(std::span<const ImuSample> samples, Timestamp from, Timestamp to,
                            const Biases& biases, const ProcessNoise& noise);

}  // namespace lio
