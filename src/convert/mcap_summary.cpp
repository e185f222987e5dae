// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "mcap_summary.hpp"

#include <algorithm>

#include "bag_limits.hpp"

namespace lio {
namespace {

constexpr std::uint64_t kCrcBytes = 4;  // the footer's last field
constexpr std::uint64_t kEndBytes =
    kMcapRecordHeaderBytes + kMcapFooterBytes + kMcapMagic.size();  // footer and magic

std::optional<McapFooter> ReadFooter(std::ifstream& file, std::uint64_t size_bytes) {
  if (size_bytes < kMcapMagic.size() + kEndBytes) return {};
  file.seekg(static_cast<std::streamoff>(size_bytes - kEndBytes));
  FileSpan end(file, kEndBytes);
  McapRecord record;
  std::vector<std::uint8_t> content;
  if (ReadMcapRecord(end, record) != RecordStatus::kOk || record.op != McapOp::kFooter ||
      record.content_bytes != kMcapFooterBytes || !ReadRecordData(end, kMcapFooterBytes, content)) {
    return {};
  }
  std::vector<std::uint8_t> magic;
  if (!ReadRecordData(end, kMcapMagic.size(), magic) ||
      !std::equal(magic.begin(), magic.end(), kMcapMagic.begin(),
                  [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); })) {
    return {};
  }
  return ParseMcapFooter(content);
}

// Returns false for a record that is none.
bool TakeRecord(const McapRecord& record, FileSpan& span, McapTopics& topics,
                McapSummary& summary) {
  const bool is_read = record.op == McapOp::kSchema || record.op == McapOp::kChannel ||
                       record.op == McapOp::kStatistics;
  if (!is_read) return span.Skip(record.content_bytes) == record.content_bytes;
  std::vector<std::uint8_t> content;
  if (record.content_bytes > kMaxDefinitionBytes ||
      !ReadRecordData(span, record.content_bytes, content)) {
    return false;
  }
  if (record.op == McapOp::kSchema) return topics.AddSchema(content);
  if (record.op == McapOp::kChannel) return topics.AddChannel(content);
  summary.statistics = ParseMcapStatistics(content);
  return summary.statistics.has_value();
}

}  // namespace

McapSummary ReadMcapSummary(std::ifstream& file, std::uint64_t size_bytes, McapTopics& topics) {
  McapSummary summary;
  const std::optional<McapFooter> footer = ReadFooter(file, size_bytes);
  summary.has_footer = footer.has_value();
  if (!footer || footer->summary_start == 0) return summary;
  const std::uint64_t end = size_bytes - kEndBytes;
  summary.is_damaged = footer->summary_start < kMcapMagic.size() || footer->summary_start > end;
  if (summary.is_damaged) return summary;
  const auto start = static_cast<std::streamoff>(footer->summary_start);
  const std::uint64_t checked_end = size_bytes - kMcapMagic.size() - kCrcBytes;
  file.seekg(start);
  FileSpan checked(file, checked_end - footer->summary_start);
  summary.is_damaged = footer->summary_crc != 0 && Crc32OfRest(checked) != footer->summary_crc;
  if (summary.is_damaged) return summary;
  file.clear();
  file.seekg(start);
  FileSpan span(file, end - footer->summary_start);
  McapRecord record;
  while (span.left() > 0 && !summary.is_damaged) {
    summary.is_damaged = ReadMcapRecord(span, record) != RecordStatus::kOk ||
                         !TakeRecord(record, span, topics, summary);
  }
  if (summary.is_damaged) summary.statistics.reset();
  return summary;
}

}  // namespace lio
