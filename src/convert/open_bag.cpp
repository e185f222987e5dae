// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "joined_bags.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "mcap_reader.hpp"
#include "rosbag2_files.hpp"

namespace lio {

namespace fs = std::filesystem;

std::unique_ptr<BagReader> OpenBag(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(path.string() + ": no such file or folder");
  RefuseIrregular(path);
  if (fs::is_directory(path) && !fs::exists(path / "metadata.yaml")) {
    const std::vector<fs::path> bags = BagsOfFolder(path);
    if (!bags.empty()) return JoinBags({bags});
  }
  const fs::path extension = path.extension();
  const bool is_ros2 = fs::is_directory(path) || extension == ".db3" || extension == ".yaml";
  if (!is_ros2) return extension == ".mcap" || IsMcap(path) ? OpenMcap(path) : OpenRosbag1(path);
  const Rosbag2Files files = FindRosbag2Files(path);
  if (files.is_mcap) return JoinBags({files.paths, OpenMcap, files.num_messages});
  return OpenRosbag2(path);
}

}  // namespace lio
