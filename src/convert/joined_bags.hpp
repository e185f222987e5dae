// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the parts of a split ROS 1 recording one after the other, as if they were one bag.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "lio/convert/bag_reader.hpp"

namespace lio {

// The .bag files of a folder, by name; empty where there are none.
[[nodiscard]] std::vector<std::filesystem::path> BagsOfFolder(const std::filesystem::path& folder);

// Joins the bags in the order of their first messages. Throws InputError that names the file that
// is no bag.
[[nodiscard]] std::unique_ptr<BagReader> JoinBags(const std::vector<std::filesystem::path>& bags);

}  // namespace lio
