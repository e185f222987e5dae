// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the parts of a split recording (bags of ROS 1, MCAP files) one after the other, as if they
// were one bag.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "lio/convert/bag_reader.hpp"

namespace lio {

// Returns the .bag files of a folder, by name; empty where there are none.
[[nodiscard]] std::vector<std::filesystem::path> BagsOfFolder(const std::filesystem::path& folder);

struct BagParts {
  std::vector<std::filesystem::path> paths;
  std::unique_ptr<BagReader> (*open)(const std::filesystem::path&) = OpenRosbag1;
  std::int64_t num_messages = -1;  // in all parts together; -1: not known
};

// Joins the parts in the order of their first messages; a part that is not there is damage. Throws
// InputError that names the file that is no bag.
[[nodiscard]] std::unique_ptr<BagReader> JoinBags(BagParts parts);

}  // namespace lio
