// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The records of an MCAP file, as mcap.dev/spec describes them: an opcode of one byte, the length
// of the content in eight, then the content. Numbers are little-endian and packed.
#pragma once

#include <cstdint>
#include <string_view>

namespace lio {

inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";  // at the file's begin and end

// There are others, for attachments, metadata and extensions (from 0x80 on).
enum class McapOp : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

inline constexpr std::uint64_t kMcapRecordHeaderBytes = 9;
inline constexpr std::uint64_t kMcapFooterBytes = 20;
inline constexpr std::uint64_t kMcapMessageHeaderBytes = 22;

}  // namespace lio
