// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Opens one MCAP file of ROS 1 or ROS 2 messages, as ROS 2 recorders write by default.
#pragma once

#include <filesystem>
#include <memory>

#include "lio/convert/bag_reader.hpp"

namespace lio {

// Gives the messages in the order in which they stand in the file, received at their log times.
// Chunks may be stored plainly, as LZ4 frames or with Zstandard. A chunk whose checksum is wrong is
// left out and counted; a file without an end gives all that was written. Throws InputError that
// names the path for a file of another kind.
[[nodiscard]] std::unique_ptr<BagReader> OpenMcap(const std::filesystem::path& path);

// Returns whether the file begins as MCAP does.
[[nodiscard]] bool IsMcap(const std::filesystem::path& path);

}  // namespace lio
