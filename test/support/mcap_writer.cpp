// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/mcap_writer.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <array>
#include <boost/crc.hpp>
#include <cstring>

namespace lio::test {
namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";

class Content {
 public:
  template <typename T>
  Content& Put(T value) {
    std::array<std::uint8_t, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    for (const std::uint8_t byte : raw) bytes_.push_back(byte);
    return *this;
  }
  Content& Text(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  Content& Raw(const std::vector<std::uint8_t>& raw) {
    bytes_.reserve(bytes_.size() + raw.size());
    for (const std::uint8_t byte : raw) bytes_.push_back(byte);
    return *this;
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::vector<std::uint8_t> Record(std::uint8_t op, const std::vector<std::uint8_t>& content) {
  return Content().Put(op).Put(std::uint64_t{content.size()}).Raw(content).bytes();
}

std::uint32_t Crc(const std::vector<std::uint8_t>& bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

std::vector<std::uint8_t> Compress(const std::string& compression,
                                   const std::vector<std::uint8_t>& data) {
  std::vector<std::uint8_t> out = data;
  if (compression == "lz4") {
    out.resize(LZ4F_compressFrameBound(data.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), data.data(), data.size(), nullptr));
  } else if (compression == "zstd") {
    out.resize(ZSTD_compressBound(data.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), data.data(), data.size(), 1));
  }
  return out;
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path, Options options)
    : file_(path, std::ios::binary), options_(std::move(options)) {
  file_ << kMagic;
  const bool is_ros1 = options_.encoding == RosEncoding::kRos1;
  WriteToFile(Record(0x01, Content().Text(is_ros1 ? "ros1" : "ros2").Text("test").bytes()));
}

void McapWriter::WriteToFile(const std::vector<std::uint8_t>& bytes) {
  file_.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
}

std::uint16_t McapWriter::Channel(const std::string& topic, const std::string& type,
                                  const std::string& definition) {
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  const auto [channel, is_new] = channels_.try_emplace(topic, id);
  if (!is_new) return channel->second;
  const bool is_ros1 = options_.encoding == RosEncoding::kRos1;
  Content schema;
  schema.Put(id).Text(type).Text(is_ros1 ? "ros1msg" : "ros2msg").Text(definition);
  Content fields;
  fields.Put(id).Put(id).Text(topic).Text(is_ros1 ? "ros1" : "cdr").Put(std::uint32_t{0});
  for (const auto& record : {Record(0x03, schema.bytes()), Record(0x04, fields.bytes())}) {
    definitions_.insert(definitions_.end(), record.begin(), record.end());
    chunk_.insert(chunk_.end(), record.begin(), record.end());
  }
  return id;
}

void McapWriter::Write(const std::string& topic, const std::string& type, Timestamp received,
                       const std::vector<std::uint8_t>& data, const std::string& definition) {
  const auto sequence = static_cast<std::uint32_t>(num_messages_++);
  Content message;
  message.Put(Channel(topic, type, definition)).Put(sequence);
  message.Put(std::uint64_t(received.ns)).Put(std::uint64_t{0}).Raw(data);
  WriteRecord(0x05, message.bytes());
}

void McapWriter::WriteRecord(std::uint8_t op, const std::vector<std::uint8_t>& content) {
  const auto record = Record(op, content);
  chunk_.insert(chunk_.end(), record.begin(), record.end());
  if (chunk_.size() >= options_.chunk_bytes) FlushChunk();
}

void McapWriter::FlushChunk() {
  if (options_.chunk_bytes == 0) {
    WriteToFile(chunk_);
  } else if (!chunk_.empty()) {
    const auto stored = Compress(options_.compression, chunk_);
    Content content;
    content.Put(std::uint64_t{0}).Put(std::uint64_t{0}).Put(std::uint64_t{chunk_.size()});
    content.Put(options_.with_crc ? Crc(chunk_) : 0).Text(options_.compression);
    WriteToFile(Record(0x06, content.Put(std::uint64_t{stored.size()}).Raw(stored).bytes()));
    WriteToFile(Record(0x07, Content().Put(std::uint16_t{1}).Put(std::uint32_t{0}).bytes()));
  }
  chunk_.clear();
}

void McapWriter::Close() {
  FlushChunk();
  WriteToFile(Record(0x0F, Content().Put(std::uint32_t{0}).bytes()));
  const auto start = static_cast<std::uint64_t>(file_.tellp());
  const auto num_channels = static_cast<std::uint32_t>(channels_.size());
  Content statistics;
  statistics.Put(num_messages_).Put(static_cast<std::uint16_t>(num_channels)).Put(num_channels);
  for (int i = 0; i < 7; ++i) statistics.Put(std::uint32_t{0});  // counts and times, not read
  Content summary;
  if (options_.with_summary) {
    summary.Raw(definitions_).Raw(Record(0x0B, statistics.Put(std::uint32_t{0}).bytes()));
  }
  // The footer's opcode, length and first two fields belong to the summary's checksum.
  summary.Put(std::uint8_t{0x02}).Put(std::uint64_t{20});
  summary.Put(options_.with_summary ? start : 0).Put(std::uint64_t{0});
  const std::uint32_t crc = options_.with_crc ? Crc(summary.bytes()) : 0;
  WriteToFile(summary.Put(crc).bytes());
  file_ << kMagic;
  file_.close();
}

}  // namespace lio::test
