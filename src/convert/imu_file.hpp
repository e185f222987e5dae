// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the inertial samples of a file that lies beside a recording without any: an LCM log, a ROS
// bag, or a table (CSV) of stamp, wx, wy, wz [rad/s], ax, ay, az [m/s^2], as EuRoC has them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "convert/packet_sweeps.hpp"

namespace lio {

struct ImuFile {
  std::vector<ReceivedImu> samples;  // in the order of reception; a table's are received at once
  std::int64_t num_damaged = 0;      // lines or messages that are no samples
  std::string description;           // for the user: "topic /imu of a ROS bag"
};

// A stamp without a point that is larger than 1e14 is in ns, others are in s. Throws InputError
// that names the file when it has no sample, and UsageError for a bag with several IMUs.
[[nodiscard]] ImuFile ReadImuFile(const std::filesystem::path& file);

}  // namespace lio
