// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a log, its truth and its rig from a recording of any kind.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lio/io/file_kind.hpp"
#include "lio/run/rig_draft.hpp"

namespace lio {

struct RecordingRequest {
  std::filesystem::path input;
  std::filesystem::path out;  // folder that exists
  std::optional<std::filesystem::path> truth;
  std::optional<std::string> lidar_topic, imu_topic, truth_topic;
  std::optional<std::filesystem::path> imu_file;  // beside a network capture
  std::function<void(double)> progress;           // called with the share done, 0..1; may be empty
  bool needs_rig = true;                          // false: the user gave one
  bool needs_truth = true;                        // false: none is looked for
};

struct PreparedRecording {
  std::filesystem::path log;
  std::optional<std::filesystem::path> truth;
  std::vector<std::filesystem::path> rig_files;  // the drafted one, or that beside the log
  bool is_mounting_assumed = false;              // by the draft: no turn and no shift
  std::string kind;                              // for users: "ROS bag"
  std::string report;                            // the converter's summary; empty for logs
  bool is_damaged = false;                       // some of the recording was lost
  std::vector<std::string> assumptions;          // sentences for users
};

// Converts into out/log.lcm what is no log, and drafts out/rig_draft.yaml where no rig is known.
// Throws UsageError for an ambiguous topic, InputError for what is no recording, and OutputError
// for a file that cannot be written.
[[nodiscard]] PreparedRecording PrepareRecording(const RecordingRequest& request);

}  // namespace lio
