// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Decides what a drafted rig says, from what a recording shows of its sensors.
#pragma once

#include <optional>

#include "lio/run/recording.hpp"
#include "run/sensor_facts.hpp"

namespace lio {

// The source of the log knows this beyond the log.
struct SourceKnowledge {
  std::string lidar_name = "the lidar";  // its topic, where there is one
  std::string imu_name = "the IMU";
  std::optional<Rig> rig;  // the rig of a known vehicle, named in `rig_reason`
  std::string rig_reason;
  std::optional<Pose> T_imu_lidar;  // from /tf_static
  std::string extrinsic_reason;     // why it is known, or why it is not
  bool never_uses_imu = false;
};

// Writes out/rig_draft.yaml, and adds it and what it assumes to `prepared`.
void WriteRigDraft(const RecordingRequest& request, const SourceKnowledge& known,
                   PreparedRecording& prepared);

}  // namespace lio
