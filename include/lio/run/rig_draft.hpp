// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes a first rig for a vehicle that nobody has described yet: every entry with the reason for
// it, to be corrected by hand.
#pragma once

#include <string>
#include <vector>

#include "lio/sensor/rig.hpp"

namespace lio {

struct RigDraft {
  Rig rig;
  bool use_imu = true;
  std::string input;               // the recording
  std::string command;             // a command that takes the corrected draft
  std::vector<std::string> about;  // lines on what the recording has
  std::string extrinsic_reason;
  std::string lidar_reason;
  std::string units_reason;
  std::string gravity_reason;
  std::string noise_reason;
};

// Returns the draft as YAML, which LoadOptions takes. Comments name what is assumed.
[[nodiscard]] std::string RigDraftYaml(const RigDraft& draft);

}  // namespace lio
