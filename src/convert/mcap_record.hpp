// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the records of an MCAP file (lio/io/mcap_format.hpp). Texts have a length of four bytes
// before them, as in messages of ROS 1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "byte_source.hpp"
#include "lio/io/lcm_codec.hpp"
#include "lio/io/mcap_format.hpp"

namespace lio {

struct McapRecord {
  McapOp op = McapOp::kHeader;
  std::uint64_t content_bytes = 0;
};

struct McapMessageHeader {
  std::uint16_t channel = 0;
  std::uint64_t log_time_ns = 0;
};

struct McapChunkHeader {
  std::uint64_t inflated_bytes = 0;
  std::uint32_t inflated_crc = 0;  // 0: there is none
  std::string compression;         // "", "lz4" (frames) or "zstd"
  std::uint64_t stored_bytes = 0;  // length of the records as they stand in the file
};

struct McapFooter {
  std::uint64_t summary_start = 0;  // from the file's begin; 0: there is no summary
  std::uint32_t summary_crc = 0;    // over the summary and the footer before this field; 0: none
};

struct McapStatistics {
  std::uint64_t num_messages = 0;
  std::uint32_t num_channels = 0;
};

// Reads opcode and length; the content comes next in `source`.
[[nodiscard]] RecordStatus ReadMcapRecord(ByteSource& source, McapRecord& record);

// These two read the beginning of a record's content; a message's data or a chunk's records come
// next in `source`. They return nothing when the source ends inside, or for an impossible length.
[[nodiscard]] std::optional<McapMessageHeader> ReadMcapMessageHeader(ByteSource& source);
[[nodiscard]] std::optional<McapChunkHeader> ReadMcapChunkHeader(ByteSource& source);

// These two return nothing for content that is too short.
[[nodiscard]] std::optional<McapFooter> ParseMcapFooter(ByteView content);
[[nodiscard]] std::optional<McapStatistics> ParseMcapStatistics(ByteView content);

// Delivers what the records of a chunk inflate to, at most as many bytes as its header says.
// Returns null for a compression that is not known.
[[nodiscard]] std::unique_ptr<ByteSource> MakeMcapChunkSource(const McapChunkHeader& header,
                                                              std::unique_ptr<ByteSource> stored);

// Returns the CRC-32 (of ISO 3309, as in zip files) of all that `source` still delivers.
[[nodiscard]] std::uint32_t Crc32OfRest(ByteSource& source);

}  // namespace lio
