// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes an MCAP file (mcap.dev/spec) of JSON messages: chunks with checksums and an index of each
// channel, and a summary with schemas, channels, chunk indices, statistics and offsets, so that a
// reader finds any time and topic without reading the rest.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/export/export_log.hpp"
#include "lio/io/mcap_format.hpp"
#include "lio/io/output_file.hpp"

namespace lio {

// Puts together the content of a record; numbers are little-endian.
class McapContent {
 public:
  McapContent& Op(McapOp op) { return Number(static_cast<std::uint8_t>(op), 1); }
  McapContent& U16(std::uint16_t value) { return Number(value, 2); }
  McapContent& U32(std::uint32_t value) { return Number(value, 4); }
  McapContent& U64(std::uint64_t value) { return Number(value, 8); }
  McapContent& Text(std::string_view text);  // behind its length in four bytes
  McapContent& Raw(std::string_view bytes);
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  void Clear() { bytes_.clear(); }

 private:
  McapContent& Number(std::uint64_t value, int num_bytes);

  std::string bytes_;
};

class McapFile {
 public:
  // Overwrites an existing file. All functions throw what OutputFile throws.
  McapFile(const std::filesystem::path& path, McapCompression compression);

  // Adds a topic of JSON messages of a type; `schema` is a JSON schema. Gives its number for Write.
  // Types of one name must have one schema.
  std::uint16_t AddTopic(const std::string& topic, const std::string& type,
                         std::string_view schema);
  void Write(std::uint16_t topic, Timestamp log_time, Timestamp publish_time,
             std::string_view json);
  // Writes the last chunk, the summary and the end.
  void Close();

  [[nodiscard]] std::uint64_t num_messages() const { return statistics_.num_messages; }

 private:
  struct Entry {
    std::uint64_t time_ns = 0;
    std::uint64_t offset = 0;  // in the chunk's records
  };
  struct Span {
    std::uint64_t begin_ns = 0;
    std::uint64_t end_ns = 0;
    bool is_empty = true;
    void Add(std::uint64_t time_ns);
  };
  struct Statistics {
    std::uint64_t num_messages = 0;
    std::uint32_t num_chunks = 0;
    Span span;
    std::map<std::uint16_t, std::uint64_t> num_of_topic;
  };

  void PutRecord(McapOp op, const McapContent& content);
  void PutBytes(std::string_view bytes);
  void FinishChunk();
  // Writes the index of each topic in the chunk; gives their places in the file.
  McapContent WriteIndices();
  std::string StatisticsContent() const;

  OutputFile file_;
  McapCompression compression_;
  std::uint64_t position_ = 0;  // in the file
  std::map<std::string, std::uint16_t> schema_ids_;
  std::uint16_t num_topics_ = 0;
  McapContent chunk_;  // records
  Span chunk_span_;
  std::map<std::uint16_t, std::vector<Entry>> chunk_entries_;
  std::string schema_records_, channel_records_, chunk_index_records_;  // repeated in the summary
  Statistics statistics_;
};

// Returns the CRC-32 of ISO 3309, as in zip files.
[[nodiscard]] std::uint32_t McapCrc(std::string_view bytes);

}  // namespace lio
