// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Simulates a lidar and an IMU that turn together, for tests of calibration.
#pragma once

#include <cmath>
#include <vector>

#include "support/motion.hpp"

namespace lio::test {

inline const Vector3 kGyroBias(0.004, -0.003, 0.006);
inline const Quaternion kExtrinsic = ExpSo3(Vector3(0.3, -1.1, 2.0));  // R_imu_lidar
inline constexpr double kOffset_s = -0.0312;  // to be added to the lidar's stamps

// The head turns about all axes, at up to 1.2 rad/s.
inline Pose LookAbout(double t_s) {
  const Vector3 look(0.2 * std::sin(2.9 * t_s), 0.25 * std::sin(3.7 * t_s + 0.4),
                     0.8 * std::sin(1.5 * t_s));
  return {ExpSo3(look), Vector3::Zero()};
}

inline Pose TurnAboutZ(double t_s) {
  return {ExpSo3(Vector3(0, 0, std::sin(2.0 * t_s))), Vector3::Zero()};
}

inline Pose Stand(double) {
  return {};
}

// Returns the samples of the IMU up to `to_s` at 200 Hz.
inline std::vector<ImuSample> BiasedSamples(const Motion& motion, double to_s) {
  std::vector<ImuSample> samples = ExactSamples(motion, 0.0, to_s, 0.005);
  for (ImuSample& sample : samples) sample.w_imu_radps += kGyroBias;
  return samples;
}

}  // namespace lio::test
