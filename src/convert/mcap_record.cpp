// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "mcap_record.hpp"

#include <algorithm>
#include <array>
#include <boost/crc.hpp>

#include "bag_limits.hpp"
#include "lio/convert/ros_cursor.hpp"

namespace lio {
namespace {

constexpr std::size_t kMaxCompressionBytes = 64;  // the name of one

RosCursor Numbers(ByteView bytes) {
  return RosCursor(bytes, RosEncoding::kRos1);
}

}  // namespace

RecordStatus ReadMcapRecord(ByteSource& source, McapRecord& record) {
  std::array<std::uint8_t, kMcapRecordHeaderBytes> header;
  const std::size_t got = source.Read(header);
  if (got == 0 && !source.damaged()) return RecordStatus::kEnd;
  if (got < header.size()) return RecordStatus::kCut;
  if (header[0] == 0) return RecordStatus::kBroken;
  record.op = static_cast<McapOp>(header[0]);
  record.content_bytes = LoadAs<std::uint64_t>(header.data() + 1);
  return RecordStatus::kOk;
}

std::optional<McapMessageHeader> ReadMcapMessageHeader(ByteSource& source) {
  std::array<std::uint8_t, kMcapMessageHeaderBytes> bytes;
  if (source.Read(bytes) < bytes.size()) return {};
  RosCursor numbers = Numbers(bytes);
  McapMessageHeader header;
  header.channel = numbers.Read<std::uint16_t>();
  (void)numbers.Read<std::uint32_t>();  // the sequence number
  header.log_time_ns = numbers.Read<std::uint64_t>();
  return header;
}

std::optional<McapChunkHeader> ReadMcapChunkHeader(ByteSource& source) {
  constexpr std::size_t kTimesBytes = 16;  // the times of the first and the last message
  std::array<std::uint8_t, kTimesBytes + 16> bytes;
  if (source.Read(bytes) < bytes.size()) return {};
  McapChunkHeader header;
  RosCursor numbers = Numbers(ByteView(bytes).subspan(kTimesBytes));
  header.inflated_bytes = numbers.Read<std::uint64_t>();
  header.inflated_crc = numbers.Read<std::uint32_t>();
  const auto name_bytes = numbers.Read<std::uint32_t>();
  if (name_bytes > kMaxCompressionBytes) return {};
  std::array<std::uint8_t, kMaxCompressionBytes + 8> rest;
  const std::size_t rest_bytes = name_bytes + sizeof(std::uint64_t);
  if (source.Read(std::span(rest).first(rest_bytes)) < rest_bytes) return {};
  header.compression.assign(rest.begin(), rest.begin() + name_bytes);
  header.stored_bytes = LoadAs<std::uint64_t>(rest.data() + name_bytes);
  return header;
}

std::optional<McapFooter> ParseMcapFooter(ByteView content) {
  RosCursor numbers = Numbers(content);
  McapFooter footer;
  footer.summary_start = numbers.Read<std::uint64_t>();
  (void)numbers.Read<std::uint64_t>();  // position of the summary's own index
  footer.summary_crc = numbers.Read<std::uint32_t>();
  if (!numbers.ok()) return {};
  return footer;
}

std::optional<McapStatistics> ParseMcapStatistics(ByteView content) {
  RosCursor numbers = Numbers(content);
  McapStatistics statistics;
  statistics.num_messages = numbers.Read<std::uint64_t>();
  (void)numbers.Read<std::uint16_t>();  // the number of schemas
  statistics.num_channels = numbers.Read<std::uint32_t>();
  if (!numbers.ok()) return {};
  return statistics;
}

std::unique_ptr<ByteSource> MakeMcapChunkSource(const McapChunkHeader& header,
                                                std::unique_ptr<ByteSource> stored) {
  // A chunk that inflates to more than it says is a bomb.
  const std::uint64_t max_bytes = std::min(header.inflated_bytes, kMaxChunkBytes);
  if (header.compression.empty()) return stored;
  if (header.compression == "lz4") return Limited(MakeLz4Source(std::move(stored)), max_bytes);
  if (header.compression == "zstd") return Limited(MakeZstdSource(std::move(stored)), max_bytes);
  return nullptr;
}

std::uint32_t Crc32OfRest(ByteSource& source) {
  constexpr std::size_t kStepBytes = 1u << 16;
  std::vector<std::uint8_t> bytes(kStepBytes);
  boost::crc_32_type crc;
  for (std::size_t got = bytes.size(); got == bytes.size();) {
    got = source.Read(bytes);
    crc.process_bytes(bytes.data(), got);
  }
  return crc.checksum();
}

}  // namespace lio
