// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "rosbag2_files.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

// Returns whether the storage is MCAP. Throws InputError for those that are not supported.
bool IsStoredAsMcap(const YAML::Node& info, const fs::path& path) {
  const auto storage = info["storage_identifier"].as<std::string>("sqlite3");
  if (storage != "sqlite3" && storage != "mcap") {
    throw InputError(path.string() + ": storage '" + storage +
                     "' is not supported: convert it with 'ros2 bag convert' to sqlite3");
  }
  return storage == "mcap";
}

// Returns whether each message is compressed. Files that are compressed as a whole have another
// ending than the readers take.
bool HasZstdMessages(const YAML::Node& info, const fs::path& path) {
  const auto format = info["compression_format"].as<std::string>("");
  if (format.empty()) return false;
  auto mode = info["compression_mode"].as<std::string>("");
  std::transform(mode.begin(), mode.end(), mode.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (format != "zstd" || (mode != "message" && mode != "file")) {
    throw InputError(path.string() + ": compression '" + format + "' in mode '" + mode +
                     "' is not supported: convert it with 'ros2 bag convert' to no compression");
  }
  return mode == "message";
}

Rosbag2Files FilesOfMetadata(const fs::path& path) {
  Rosbag2Files files;
  RefuseIrregular(path);
  try {
    const YAML::Node info = YAML::LoadFile(path.string())["rosbag2_bagfile_information"];
    if (!info.IsMap()) throw InputError(path.string() + ": no metadata of a ROS 2 bag");
    files.is_mcap = IsStoredAsMcap(info, path);
    files.has_zstd_messages = HasZstdMessages(info, path);
    for (const YAML::Node& name : info["relative_file_paths"]) {
      // Old recorders wrote the folder's own name in front.
      const fs::path relative = name.as<std::string>();
      const fs::path direct = path.parent_path() / relative;
      files.paths.push_back(fs::exists(direct) ? direct : path.parent_path() / relative.filename());
    }
    files.num_messages = std::max<std::int64_t>(-1, info["message_count"].as<std::int64_t>(-1));
  } catch (const YAML::Exception& error) {
    throw InputError(path.string() + ": cannot be read as YAML: " + error.what());
  }
  if (files.paths.empty()) throw InputError(path.string() + ": names no files");
  return files;
}

std::vector<fs::path> FilesWithEnding(const fs::path& folder, std::string_view ending) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ending) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

Rosbag2Files FindFiles(const fs::path& path) {
  if (fs::is_regular_file(path) && path.extension() == ".db3") return {{path}};
  if (fs::is_regular_file(path) && path.extension() == ".mcap") return {{path}, -1, true};
  const fs::path metadata = fs::is_directory(path) ? path / "metadata.yaml" : path;
  if (fs::exists(metadata)) return FilesOfMetadata(metadata);
  // A recorder that died leaves no metadata.
  Rosbag2Files files{FilesWithEnding(path, ".db3")};
  if (!files.paths.empty()) return files;
  files = {FilesWithEnding(path, ".mcap"), -1, true};
  if (files.paths.empty()) throw InputError(path.string() + ": no ROS 2 bag: no .db3 or .mcap");
  return files;
}

}  // namespace

bool IsZstdFile(const fs::path& path) {
  constexpr std::array<char, 4> kZstdMagic = {'\x28', '\xB5', '\x2F', '\xFD'};
  if (path.extension() != kZstdEnding && path.extension() != ".zst") return false;
  const std::string inner = path.stem().extension();
  if (inner != ".mcap" && inner != ".db3" && inner != ".bag") return false;
  std::array<char, 4> bytes{};
  std::ifstream file(path, std::ios::binary);
  return file.read(bytes.data(), bytes.size()) && bytes == kZstdMagic;
}

Rosbag2Files FindRosbag2Files(const fs::path& path) {
  Rosbag2Files files = FindFiles(path);
  for (const fs::path& file : files.paths) RefuseIrregular(file);
  return files;
}

}  // namespace lio
