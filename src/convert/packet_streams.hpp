// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Looks through a capture for the lidars whose packets it has, and chooses one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "convert/ouster_metadata.hpp"
#include "convert/udp_capture.hpp"

namespace lio {

struct PacketStream {
  std::uint32_t source = 0;
  std::uint16_t port = 0;
  std::string model;  // "vlp16", "hdl32e" or "ouster"; empty for what is no supported lidar
  std::string what;   // for the user: "a Velodyne of product 40", "datagrams of 512 bytes"
  std::int64_t num_packets = 0;
  std::vector<double> delays_s;  // the first packets': received, minus the time that they tell

  [[nodiscard]] std::string name() const;  // "192.168.1.201:2368"
};

// Throws InputError as UdpCapture does.
[[nodiscard]] std::vector<PacketStream> FindStreams(const std::filesystem::path& capture,
                                                    const std::optional<OusterMetadata>& ouster);

// Throws UsageError for a name that is not there, and where several lidars are and none is named.
// Throws InputError that lists what there is when none of it is a supported lidar.
[[nodiscard]] PacketStream ChooseStream(const std::vector<PacketStream>& streams,
                                        const std::optional<std::string>& wanted);

}  // namespace lio
