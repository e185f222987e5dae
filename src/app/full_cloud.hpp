// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LIO_CLOUD_FULL: every finite point of a sweep, moved to where it stands in the map.
#pragma once

#include <memory>
#include <vector>

#include "lio/pipeline/registration_worker.hpp"

namespace lio {

struct FullCloudTask {
  std::shared_ptr<const Sweep> sweep;
  StampedPoses T_any_imu;  // covers the sweep, as in MatchJob
  Pose T_map_imu;          // at the sweep's middle, as matched
};

// Chunks of at most kMaxChunkPoints, in the order of the sweep. Stamp and offsets stay the points'
// own instants.
std::vector<ScanChunk> RegisterFullCloud(const FullCloudTask& task, const Pose& T_imu_lidar);

}  // namespace lio
