// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The files of a ROS 2 bag: a folder with metadata.yaml and one or more SQLite files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lio {

struct Rosbag2Files {
  std::vector<std::filesystem::path> databases;  // in the order in which they were written
  std::int64_t num_messages = -1;                // -1: not known
};

// `path` is the folder, its metadata.yaml or one of its .db3 files; a folder without metadata, as a
// recorder that died leaves it, gives all its .db3 files. Throws InputError where there is none,
// and for a storage that is not supported.
[[nodiscard]] Rosbag2Files FindRosbag2Files(const std::filesystem::path& path);

}  // namespace lio
