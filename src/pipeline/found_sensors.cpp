// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/found_sensors.hpp"

namespace lio {

FoundSensors InAxesOfMessages(FoundSensors found, const Rig& rig) {
  if (!found.convention || found.convention->R_imu_sent == Matrix3::Identity()) return found;
  const Pose T_imu_lidar = found.T_imu_lidar.value_or(rig.T_imu_lidar.value_or(Extrinsic{}));
  found.T_imu_lidar = InAxesOfMessages(T_imu_lidar, *found.convention);
  if (found.extrinsic_std) {
    const Matrix3 to_sent = found.convention->R_imu_sent.transpose().cwiseAbs();
    ExtrinsicStd& std = *found.extrinsic_std;
    std = {to_sent * std.rotation_rad, to_sent * std.lever_m};
  }
  found.convention->R_imu_sent = Matrix3::Identity();
  return found;
}

Options WithFound(Options options, const FoundSensors& found) {
  options.rig.lidar.clock_offset_s += found.clock.mean[0];
  if (!found.T_imu_lidar) return options;
  if (!options.rig.T_imu_lidar) options.rig.T_imu_lidar.emplace();
  static_cast<Pose&>(*options.rig.T_imu_lidar) = *found.T_imu_lidar;
  return options;
}

}  // namespace lio
