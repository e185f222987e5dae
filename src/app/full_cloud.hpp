// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Publishes the cloud LIO_CLOUD_FULL: every finite point of a sweep, deskewed and in the frame
// `map`.
#pragma once

#include <memory>
#include <vector>

#include "lio/pipeline/registration_worker.hpp"

namespace lio {

struct FullCloudTask {
  std::shared_ptr<const Sweep> sweep;
  StampedPoses T_any_imu;  // covers the sweep, as in MatchJob
  Pose T_imu_lidar;        // likewise
  Pose T_map_imu;          // at the sweep's middle, as matched
};

// Gives chunks of at most kMaxChunkPoints points, in the order of the sweep. Stamps and offsets are
// still the points' own instants.
[[nodiscard]] std::vector<ScanChunk> RegisterFullCloud(const FullCloudTask& task);

}  // namespace lio
