// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "rosbag2_files.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <string>

#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

// Throws InputError for storage formats that this reader does not support.
void CheckStorage(const YAML::Node& info, const fs::path& path) {
  const auto storage = info["storage_identifier"].as<std::string>("sqlite3");
  if (storage != "sqlite3") {
    throw InputError(path.string() + ": storage '" + storage +
                     "' is not supported: convert it with 'ros2 bag convert' to sqlite3");
  }
  const auto compression = info["compression_format"].as<std::string>("");
  if (!compression.empty()) {
    throw InputError(path.string() + ": compression '" + compression +
                     "' is not supported: convert it with 'ros2 bag convert' to no compression");
  }
}

Rosbag2Files FilesOfMetadata(const fs::path& path) {
  Rosbag2Files files;
  RefuseIrregular(path);
  try {
    const YAML::Node info = YAML::LoadFile(path.string())["rosbag2_bagfile_information"];
    if (!info.IsMap()) throw InputError(path.string() + ": no metadata of a ROS 2 bag");
    CheckStorage(info, path);
    for (const YAML::Node& name : info["relative_file_paths"]) {
      // Old recorders wrote the folder's own name in front.
      const fs::path relative = name.as<std::string>();
      const fs::path direct = path.parent_path() / relative;
      files.databases.push_back(fs::exists(direct) ? direct
                                                   : path.parent_path() / relative.filename());
    }
    files.num_messages = std::max<std::int64_t>(-1, info["message_count"].as<std::int64_t>(-1));
  } catch (const YAML::Exception& error) {
    throw InputError(path.string() + ": cannot be read as YAML: " + error.what());
  }
  if (files.databases.empty()) throw InputError(path.string() + ": names no files");
  return files;
}

Rosbag2Files FindFiles(const fs::path& path) {
  if (fs::is_regular_file(path) && path.extension() == ".db3") return {{path}, -1};
  const fs::path metadata = fs::is_directory(path) ? path / "metadata.yaml" : path;
  if (fs::exists(metadata)) return FilesOfMetadata(metadata);
  Rosbag2Files files;  // a recorder that died leaves no metadata
  for (const auto& entry : fs::directory_iterator(path)) {
    if (entry.path().extension() == ".db3") files.databases.push_back(entry.path());
  }
  std::sort(files.databases.begin(), files.databases.end());
  if (files.databases.empty()) throw InputError(path.string() + ": no ROS 2 bag: no .db3 file");
  return files;
}

}  // namespace

Rosbag2Files FindRosbag2Files(const fs::path& path) {
  Rosbag2Files files = FindFiles(path);
  for (const fs::path& database : files.databases) RefuseIrregular(database);
  return files;
}

}  // namespace lio
