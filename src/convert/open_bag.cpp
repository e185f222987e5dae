// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "inflating_reader.hpp"
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
  if (IsZstdFile(path)) {
    throw InputError(path.string() + ": is compressed; lio-convert and lio-run inflate it");
  }
  const fs::path extension = path.extension();
  const bool is_ros2 = fs::is_directory(path) || extension == ".db3" || extension == ".yaml";
  if (!is_ros2) return extension == ".mcap" || IsMcap(path) ? OpenMcap(path) : OpenRosbag1(path);
  const Rosbag2Files files = FindRosbag2Files(path);
  auto bag =
      files.is_mcap ? JoinBags({files.paths, OpenMcap, files.num_messages}) : OpenRosbag2(path);
  return files.has_zstd_messages ? InflateMessages(std::move(bag)) : std::move(bag);
}

}  // namespace lio
