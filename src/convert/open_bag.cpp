// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "joined_bags.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"

namespace lio {

namespace fs = std::filesystem;

std::unique_ptr<BagReader> OpenBag(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(path.string() + ": no such file or folder");
  RefuseIrregular(path);
  const fs::path extension = path.extension();
  if (fs::is_directory(path) && !fs::exists(path / "metadata.yaml")) {
    const std::vector<fs::path> bags = BagsOfFolder(path);
    if (!bags.empty()) return JoinBags(bags);
  }
  const bool is_ros2 = fs::is_directory(path) || extension == ".db3" || extension == ".yaml";
  if (extension == ".mcap") {
    throw InputError(path.string() +
                     ": MCAP is not supported: convert it with 'ros2 bag convert' to sqlite3");
  }
  return is_ros2 ? OpenRosbag2(path) : OpenRosbag1(path);
}

}  // namespace lio
