// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Livox's own message of a scan, livox_ros_driver/CustomMsg and livox_ros_driver2/CustomMsg, as a
// cloud: its points are fixed records of 19 bytes, which CDR pads to 20.
#pragma once

#include <optional>
#include <string_view>

#include "lio/convert/bag_reader.hpp"
#include "lio/convert/ros_messages.hpp"

namespace lio {

[[nodiscard]] bool IsLivoxType(std::string_view type);
// Returns whether messages of the type are scans of a lidar: PointCloud2, or Livox's.
[[nodiscard]] bool IsScanType(std::string_view type);

// The cloud is a view of `bytes`, with the fields x, y, z, reflectivity, tag, line and offset_time,
// in ns from the stamp, which is that of the first point. Returns nothing when sizes do not fit.
[[nodiscard]] std::optional<RosCloud> DecodeLivox(ByteView bytes, RosEncoding encoding);

// Decodes a message of the topic, which is of a scan's type.
[[nodiscard]] std::optional<RosCloud> DecodeScan(const BagTopic& topic, ByteView bytes);

}  // namespace lio
