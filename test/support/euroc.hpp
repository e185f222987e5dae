// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads recorded IMU samples with true poses: the EuRoC extract of the shared data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio::test {

struct RealDrive {
  std::vector<ImuSample> samples;  // 200 Hz
  StampedPoses T_world_imu;        // 20 Hz, the truth; z up
};

// `name` is V101 or MH04. The files' quaternions turn world to camera, although their description
// says the opposite: only this direction agrees with the IMU's rates and gravity. Throws
// std::runtime_error when a file cannot be read.
RealDrive ReadEuroc(const std::filesystem::path& folder, const std::string& name);

}  // namespace lio::test
