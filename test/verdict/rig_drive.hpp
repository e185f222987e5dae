// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Records a motion as a rig with known errors would show it: exact samples, and the poses that
// matching would give, with a little noise.
#pragma once

#include <random>
#include <vector>

#include "lio/verdict/motion_record.hpp"
#include "support/motion.hpp"

namespace lio::test {

struct RigDrive {
  Pose T_imu_lidar;                 // the truth
  Pose T_configured;                // the rig's
  double clock_offset_s = 0.0;      // to be added to the lidar's stamps
  double clock_correction_s = 0.0;  // added to them already by the estimate
  double duration_s = 40.0;
  double gyro_unit = 1.0;  // samples read so many times the rate
  double position_std_m = 0.002;
  double rotation_std_rad = 0.0005;
};

inline constexpr double kScanPeriod_s = 0.1;
inline constexpr double kAccelBiasStd_mps2 = 0.05;

// Matching measures this at the stamp t: the lidar's pose, as the rig makes it one of imu.
inline Pose MatchedPose(const RigDrive& drive, const Motion& motion, double t_s,
                        std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto noise = [&](double std) {
    return Vector3{std * normal(random), std * normal(random), std * normal(random)};
  };
  const Pose T =
      motion(t_s + drive.clock_offset_s) * drive.T_imu_lidar * drive.T_configured.Inverse();
  return {(T.rotation * ExpSo3(noise(drive.rotation_std_rad))).normalized(),
          T.translation + noise(drive.position_std_m)};
}

inline MotionRecord RecordDrive(const RigDrive& drive, const Motion& motion = Tumble()) {
  std::mt19937_64 random(1);
  MotionRecord record;
  for (double t_s = 1.0; t_s < drive.duration_s; t_s += kScanPeriod_s) {
    std::vector<ImuSample> samples = ExactSamples(motion, t_s - kScanPeriod_s - 0.05,
                                                  t_s + drive.clock_correction_s + 0.05, 0.005);
    for (ImuSample& sample : samples) sample.w_imu_radps *= drive.gyro_unit;
    record.Add({StampAt(t_s + drive.clock_correction_s), MatchedPose(drive, motion, t_s, random)},
               Duration::FromSeconds(drive.clock_correction_s), samples);
  }
  return record;
}

inline Pose ExamplePose() {
  return {ExpSo3(Vector3(0.02, -0.01, 0.4)), Vector3(0.3, -0.1, 0.5)};
}

// The rig is as it is configured.
inline RigDrive RightDrive() {
  return {.T_imu_lidar = ExamplePose(), .T_configured = ExamplePose()};
}

}  // namespace lio::test
