// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the records of a ROS 1 bag, format 2.0: a header of name=value fields, then data. The
// format is described at wiki.ros.org/Bags/Format/2.0.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "byte_source.hpp"
#include "lio/base/time.hpp"
#include "lio/convert/byte_order.hpp"
#include "lio/io/lcm_codec.hpp"

namespace lio {

enum class RecordOp : std::uint8_t {
  kMessage = 0x02,
  kBagHeader = 0x03,
  kIndexData = 0x04,
  kChunk = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07,
};

// Fields that a record does not have stay empty.
struct RecordHeader {
  RecordOp op = RecordOp::kMessage;
  std::uint32_t data_bytes = 0;
  std::optional<std::uint32_t> connection;      // messages, connections
  std::optional<Timestamp> time;                // messages
  std::string topic;                            // connections
  std::string compression;                      // chunks
  std::uint32_t uncompressed_bytes = 0;         // chunks
  std::optional<std::uint64_t> index_position;  // bag header
  std::uint32_t num_connections = 0;            // bag header
  std::uint32_t num_chunks = 0;                 // bag header
};

// Reads header and data length; the data itself comes next in `source`.
[[nodiscard]] RecordStatus ReadRecordHeader(ByteSource& source, RecordHeader& header);

// Calls `visit(name, value)` for each field of a header. Returns false when the bytes are no
// header.
template <typename Visit>
[[nodiscard]] bool VisitFields(ByteView bytes, Visit&& visit) {
  std::size_t at = 0;
  while (at < bytes.size()) {
    if (bytes.size() - at < 4) return false;
    const auto length = LoadAs<std::uint32_t>(bytes.data() + at);
    at += 4;
    if (length > bytes.size() - at) return false;
    const std::string_view field(reinterpret_cast<const char*>(bytes.data()) + at, length);
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) return false;
    visit(field.substr(0, equals), field.substr(equals + 1));
    at += length;
  }
  return true;
}

}  // namespace lio
