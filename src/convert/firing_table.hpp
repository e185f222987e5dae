// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// When and whither each channel of a lidar's packets fires, from config/lidars/MODEL.yaml.
#pragma once

#include <string>
#include <vector>

namespace lio {

struct FiringTable {
  // Channels are in the order of firing, which is that of a packet.
  struct Channel {
    std::uint16_t ring = 0;  // 0 is the lowest beam
    double elevation_rad = 0.0;
    double azimuth_offset_rad = 0.0;  // counter-clockwise from the head's azimuth
    double fire_time_s = 0.0;         // since the first channel
  };
  std::vector<Channel> channels;
  double period_s = 0.0;  // from one round of all channels to the next
};

// Throws UsageError for an unknown model and InputError for a file that is damaged.
[[nodiscard]] FiringTable LoadFiringTable(const std::string& model);

}  // namespace lio
