// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "export/mcap_file.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <stdexcept>
#include <utility>

namespace lio {
namespace {

constexpr std::size_t kChunkBytes = 1u << 20;  // length of the records before compression
constexpr int kZstdLevel = 3;

std::string Record(McapOp op, std::string_view content) {
  return McapContent().Op(op).U64(content.size()).Raw(content).bytes();
}

std::string_view Name(McapCompression compression) {
  constexpr std::string_view kNames[] = {"", "lz4", "zstd"};
  return kNames[static_cast<std::size_t>(compression)];
}

std::string Compressed(const std::string& records, McapCompression compression) {
  std::string out;
  std::size_t size = 0;
  if (compression == McapCompression::kNone) return records;
  if (compression == McapCompression::kLz4) {
    out.resize(LZ4F_compressFrameBound(records.size(), nullptr));
    size = LZ4F_compressFrame(out.data(), out.size(), records.data(), records.size(), nullptr);
    if (LZ4F_isError(size) != 0) throw std::runtime_error("LZ4 failed");
  } else {
    out.resize(ZSTD_compressBound(records.size()));
    size = ZSTD_compress(out.data(), out.size(), records.data(), records.size(), kZstdLevel);
    if (ZSTD_isError(size) != 0) throw std::runtime_error("Zstandard failed");
  }
  out.resize(size);
  return out;
}

std::uint64_t Nanoseconds(Timestamp stamp) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, stamp.ns));
}

}  // namespace

std::uint32_t McapCrc(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

McapContent& McapContent::Number(std::uint64_t value, int num_bytes) {
  for (int i = 0; i < num_bytes; ++i) bytes_.push_back(static_cast<char>(value >> (8 * i)));
  return *this;
}

McapContent& McapContent::Text(std::string_view text) {
  U32(static_cast<std::uint32_t>(text.size()));
  return Raw(text);
}

McapContent& McapContent::Raw(std::string_view bytes) {
  bytes_.append(bytes);
  return *this;
}

void McapFile::Span::Add(std::uint64_t time_ns) {
  begin_ns = is_empty ? time_ns : std::min(begin_ns, time_ns);
  end_ns = is_empty ? time_ns : std::max(end_ns, time_ns);
  is_empty = false;
}

McapFile::McapFile(const std::filesystem::path& path, McapCompression compression)
    : file_(path), compression_(compression) {
  PutBytes(kMcapMagic);
  PutRecord(McapOp::kHeader, McapContent().Text("").Text("liod"));
}

void McapFile::PutBytes(std::string_view bytes) {
  file_.Write(bytes);
  position_ += bytes.size();
}

void McapFile::PutRecord(McapOp op, const McapContent& content) {
  PutBytes(Record(op, content.bytes()));
}

std::uint16_t McapFile::AddTopic(const std::string& topic, const std::string& type,
                                 std::string_view schema) {
  const auto next = static_cast<std::uint16_t>(schema_ids_.size() + 1);  // 0 stands for none
  const auto [schema_id, is_new] = schema_ids_.try_emplace(type, next);
  if (is_new) {
    const std::string record =
        Record(McapOp::kSchema,
               McapContent().U16(next).Text(type).Text("jsonschema").Text(schema).bytes());
    schema_records_ += record;
    chunk_.Raw(record);
  }
  const std::uint16_t id = num_topics_++;
  McapContent channel;
  channel.U16(id).U16(schema_id->second).Text(topic).Text("json").U32(0);
  const std::string record = Record(McapOp::kChannel, channel.bytes());
  channel_records_ += record;
  chunk_.Raw(record);
  statistics_.num_of_topic[id] = 0;
  return id;
}

void McapFile::Write(std::uint16_t topic, Timestamp log_time, Timestamp publish_time,
                     std::string_view json) {
  const std::uint64_t time_ns = Nanoseconds(log_time);
  std::uint64_t& num = statistics_.num_of_topic.at(topic);
  chunk_entries_[topic].push_back({time_ns, chunk_.size()});
  chunk_span_.Add(time_ns);
  statistics_.span.Add(time_ns);
  ++statistics_.num_messages;
  chunk_.Op(McapOp::kMessage).U64(kMcapMessageHeaderBytes + json.size());
  chunk_.U16(topic).U32(static_cast<std::uint32_t>(num++));
  chunk_.U64(time_ns).U64(Nanoseconds(publish_time)).Raw(json);
  if (chunk_.size() >= kChunkBytes) FinishChunk();
}

McapContent McapFile::WriteIndices() {
  McapContent places;
  for (auto& [topic, entries] : chunk_entries_) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.time_ns < b.time_ns; });
    places.U16(topic).U64(position_);
    McapContent index;
    index.U16(topic).U32(static_cast<std::uint32_t>(entries.size() * 16));
    for (const Entry& entry : entries) index.U64(entry.time_ns).U64(entry.offset);
    PutRecord(McapOp::kMessageIndex, index);
  }
  return places;
}

void McapFile::FinishChunk() {
  if (chunk_.size() == 0) return;
  const std::string& records = chunk_.bytes();
  const std::string stored = Compressed(records, compression_);
  const std::uint64_t chunk_start = position_;
  McapContent chunk;
  chunk.U64(chunk_span_.begin_ns).U64(chunk_span_.end_ns).U64(records.size()).U32(McapCrc(records));
  chunk.Text(Name(compression_)).U64(stored.size()).Raw(stored);
  PutRecord(McapOp::kChunk, chunk);
  const std::uint64_t chunk_bytes = position_ - chunk_start;
  const std::uint64_t indices_start = position_;
  const McapContent places = WriteIndices();
  McapContent index;
  index.U64(chunk_span_.begin_ns).U64(chunk_span_.end_ns).U64(chunk_start).U64(chunk_bytes);
  index.Text(places.bytes()).U64(position_ - indices_start);
  index.Text(Name(compression_)).U64(stored.size()).U64(records.size());
  chunk_index_records_ += Record(McapOp::kChunkIndex, index.bytes());
  ++statistics_.num_chunks;
  chunk_.Clear();
  chunk_span_ = {};
  chunk_entries_.clear();
}

std::string McapFile::StatisticsContent() const {
  McapContent counts;
  for (const auto& [topic, num] : statistics_.num_of_topic) counts.U16(topic).U64(num);
  McapContent content;
  content.U64(statistics_.num_messages).U16(static_cast<std::uint16_t>(schema_ids_.size()));
  content.U32(num_topics_).U32(0).U32(0).U32(statistics_.num_chunks);
  content.U64(statistics_.span.begin_ns).U64(statistics_.span.end_ns).Text(counts.bytes());
  return content.bytes();
}

void McapFile::Close() {
  FinishChunk();
  PutRecord(McapOp::kDataEnd, McapContent().U32(0));
  const std::uint64_t summary_start = position_;
  const std::pair<McapOp, std::string> groups[] = {
      {McapOp::kSchema, schema_records_},
      {McapOp::kChannel, channel_records_},
      {McapOp::kStatistics, Record(McapOp::kStatistics, StatisticsContent())},
      {McapOp::kChunkIndex, chunk_index_records_}};
  McapContent summary;
  McapContent offsets;
  for (const auto& [op, records] : groups) {
    if (records.empty()) continue;
    const std::uint64_t start = summary_start + summary.size();
    offsets.Raw(Record(McapOp::kSummaryOffset,
                       McapContent().Op(op).U64(start).U64(records.size()).bytes()));
    summary.Raw(records);
  }
  const std::uint64_t offsets_start = summary_start + summary.size();
  summary.Raw(offsets.bytes());
  // The checksum covers the footer up to itself, too.
  summary.Op(McapOp::kFooter).U64(kMcapFooterBytes).U64(summary_start).U64(offsets_start);
  const std::uint32_t crc = McapCrc(summary.bytes());
  summary.U32(crc);
  PutBytes(summary.bytes());
  PutBytes(kMcapMagic);
  file_.Close();
}

}  // namespace lio
