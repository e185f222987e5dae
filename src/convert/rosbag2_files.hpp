// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The files of a ROS 2 bag: a folder with metadata.yaml and one or more SQLite or MCAP files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lio {

struct Rosbag2Files {
  std::vector<std::filesystem::path> paths;  // in the order in which they were written
  std::int64_t num_messages = -1;            // -1: not known
  bool is_mcap = false;                      // else they are SQLite databases
};

// `path` is the folder, its metadata.yaml or one of its .db3 or .mcap files; a folder without
// metadata, as a recorder that died leaves it, gives all its .db3 files, else its .mcap files.
// Throws InputError where there is none, and for a storage that is not supported.
[[nodiscard]] Rosbag2Files FindRosbag2Files(const std::filesystem::path& path);

}  // namespace lio
