// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the files of a ROS 2 bag: a folder with metadata.yaml and one or more SQLite or MCAP files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace lio {

// Recorders append this ending to the name of a file that they compress.
inline constexpr std::string_view kZstdEnding = ".zstd";

// Returns whether it is a bag's file that is compressed as a whole, by ending and first bytes.
[[nodiscard]] bool IsZstdFile(const std::filesystem::path& path);

struct Rosbag2Files {
  std::vector<std::filesystem::path> paths;  // in the order in which they were written
  std::int64_t num_messages = -1;            // -1: not known
  bool is_mcap = false;                      // else they are SQLite databases
  bool has_zstd_messages = false;            // each message is compressed by itself
};

// `path` is the folder, its metadata.yaml or one of its .db3 or .mcap files; a folder without
// metadata, as a recorder that died leaves it, gives all its .db3 files, else its .mcap files.
// Files that are compressed as a whole are inflated before (PlainBag). Throws InputError where
// there is none, and for a storage that is not supported.
[[nodiscard]] Rosbag2Files FindRosbag2Files(const std::filesystem::path& path);

}  // namespace lio
