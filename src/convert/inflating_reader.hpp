// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads a ROS 2 bag each message of which is a Zstandard frame (compression mode "message").
#pragma once

#include <memory>

#include "lio/convert/bag_reader.hpp"

namespace lio {

// A message that does not inflate, or would take more than 256 MiB, is counted as damaged and
// passed over.
[[nodiscard]] std::unique_ptr<BagReader> InflateMessages(std::unique_ptr<BagReader> bag);

}  // namespace lio
