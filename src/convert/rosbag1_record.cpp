// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "rosbag1_record.hpp"

#include <array>

namespace lio {
namespace {

// A header holds a topic name at most, so a megabyte is no header.
constexpr std::uint32_t kMaxHeaderBytes = 1u << 20;

template <typename T>
std::optional<T> Number(std::string_view value) {
  if (value.size() != sizeof(T)) return {};
  return LoadAs<T>(reinterpret_cast<const std::uint8_t*>(value.data()));
}

std::optional<Timestamp> Time(std::string_view value) {
  if (value.size() != 8) return {};
  const std::int64_t seconds = *Number<std::uint32_t>(value.substr(0, 4));
  const std::int64_t nanoseconds = *Number<std::uint32_t>(value.substr(4));
  if (nanoseconds >= 1'000'000'000) return {};
  return Timestamp{seconds * 1'000'000'000 + nanoseconds};
}

bool ParseHeader(ByteView bytes, RecordHeader& header) {
  std::optional<std::uint8_t> op;
  const bool whole = VisitFields(bytes, [&](std::string_view name, std::string_view value) {
    if (name == "op") op = Number<std::uint8_t>(value);
    if (name == "conn") header.connection = Number<std::uint32_t>(value);
    if (name == "time") header.time = Time(value);
    if (name == "topic") header.topic = value;
    if (name == "compression") header.compression = value;
    if (name == "size") header.uncompressed_bytes = Number<std::uint32_t>(value).value_or(0);
    if (name == "index_pos") header.index_position = Number<std::uint64_t>(value);
    if (name == "conn_count") header.num_connections = Number<std::uint32_t>(value).value_or(0);
    if (name == "chunk_count") header.num_chunks = Number<std::uint32_t>(value).value_or(0);
  });
  if (!whole || !op || *op < 0x02 || *op > 0x07) return false;
  header.op = static_cast<RecordOp>(*op);
  return true;
}

}  // namespace

RecordStatus ReadRecordHeader(ByteSource& source, RecordHeader& header) {
  header = RecordHeader{};
  std::array<std::uint8_t, 4> length;
  const std::size_t got = source.Read(length);
  if (got == 0 && !source.damaged()) return RecordStatus::kEnd;
  if (got < length.size()) return RecordStatus::kCut;
  const auto header_bytes = LoadAs<std::uint32_t>(length.data());
  if (header_bytes == 0 || header_bytes > kMaxHeaderBytes) return RecordStatus::kBroken;
  std::vector<std::uint8_t> bytes;
  if (!ReadRecordData(source, header_bytes, bytes)) return RecordStatus::kCut;
  if (!ParseHeader(bytes, header)) return RecordStatus::kBroken;
  if (source.Read(length) < length.size()) return RecordStatus::kCut;
  header.data_bytes = LoadAs<std::uint32_t>(length.data());
  return RecordStatus::kOk;
}

}  // namespace lio
