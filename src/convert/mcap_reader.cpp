// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads an MCAP file from front to back. The summary at its end serves only two purposes: to know
// all topics early, and to find how many messages are missing.
#include "mcap_reader.hpp"

#include <algorithm>
#include <fstream>
#include <limits>

#include "bag_limits.hpp"
#include "chunked_reader.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/printable.hpp"
#include "mcap_record.hpp"
#include "mcap_summary.hpp"
#include "mcap_topics.hpp"

namespace lio {
namespace {

class McapReader : public ChunkedReader {
 public:
  explicit McapReader(const std::filesystem::path& path);

  const std::vector<BagTopic>& topics() const override { return topics_.topics(); }
  bool knows_all_topics() const override { return knows_all_topics_; }

 private:
  struct Chunk {
    McapChunkHeader header;
    std::uint64_t begin = 0;  // file positions of the present chunk's stored records
    std::uint64_t stored_end = 0;
    std::uint64_t end = 0;         // position of the file's next record
    std::uint64_t missing = 0;     // bytes of the last chunk that are missing from the file
    std::uint64_t understood = 0;  // bytes of the chunk's records that were sound
  };

  Step StepOutside(BagMessage& message) override;
  Step StepInside(BagMessage& message) override;
  void EnterChunk(const McapRecord& record);
  [[nodiscard]] std::unique_ptr<ByteSource> OpenChunk();
  [[nodiscard]] bool IsChunkSound();
  void DropChunk(const std::string& reason);
  void LeaveChunk(RecordStatus status);
  Step TakeMessage(const McapRecord& record, ByteSource& source, BagMessage& message);
  [[nodiscard]] bool TakeDefinition(const McapRecord& record, ByteSource& source);
  Step EndOfFile(const std::string& reason);
  void CountMissing() override;

  Chunk chunk_;

  McapSummary summary_;
  McapTopics topics_;
  bool knows_all_topics_ = false;
  std::uint64_t num_messages_ = 0;
};

McapReader::McapReader(const std::filesystem::path& path) {
  RefuseIrregular(path);
  if (!IsMcap(path)) throw InputError(path.string() + ": no MCAP file");
  file_.open(path, std::ios::binary);
  size_ = std::filesystem::file_size(path);
  summary_ = ReadMcapSummary(file_, size_, topics_);
  damage_.not_closed = !summary_.has_footer;
  if (summary_.is_damaged) {
    ++damage_.num_messages_damaged;
    position_ = size_;
    Damage("a damaged summary");
  }
  knows_all_topics_ = summary_.statistics && topics_.num_channels() > 0 &&
                      topics_.num_channels() >= summary_.statistics->num_channels;
  position_ = kMcapMagic.size();
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(position_));
  outside_ = std::make_unique<FileSpan>(file_, size_ - position_);
}

ChunkedReader::Step McapReader::StepOutside(BagMessage& message) {
  position_ = Here();
  McapRecord record;
  const RecordStatus status = ReadMcapRecord(*outside_, record);
  if (status == RecordStatus::kEnd) return Step::kEnd;
  if (status == RecordStatus::kBroken) return EndOfFile("bytes that are no record");
  const bool fits = status == RecordStatus::kOk && record.content_bytes <= outside_->left();
  const bool is_chunk = record.op == McapOp::kChunk && record.content_bytes <= kMaxChunkBytes;
  if (!fits && (status != RecordStatus::kOk || !is_chunk)) {
    return EndOfFile("the file ends inside a record");
  }
  switch (record.op) {
    case McapOp::kChunk:
      EnterChunk(record);
      return Step::kGoOn;
    case McapOp::kMessage:
      return TakeMessage(record, *outside_, message);
    case McapOp::kSchema:
    case McapOp::kChannel:
      if (TakeDefinition(record, *outside_)) return Step::kGoOn;
      return EndOfFile("the file ends inside a record");
    case McapOp::kDataEnd:
    case McapOp::kFooter:
      return Step::kEnd;
    default:
      outside_->Skip(record.content_bytes);
      return Step::kGoOn;
  }
}

// Nothing more can be read from `position_` on.
ChunkedReader::Step McapReader::EndOfFile(const std::string& reason) {
  damage_.cut_short = true;
  damage_.lost_bytes += static_cast<std::int64_t>(size_ - position_);
  Damage(reason);
  return Step::kEnd;
}

void McapReader::EnterChunk(const McapRecord& record) {
  chunk_ = Chunk{};
  const std::uint64_t said_end = Here() + record.content_bytes;
  const std::optional<McapChunkHeader> header = ReadMcapChunkHeader(*outside_);
  chunk_.begin = Here();
  chunk_.end = std::min(said_end, size_);
  chunk_.missing = said_end - chunk_.end;
  if (!header || chunk_.begin > said_end || header->stored_bytes > said_end - chunk_.begin) {
    DropChunk("a broken chunk");
    return;
  }
  chunk_.header = *header;
  const std::uint64_t stored_end = chunk_.begin + header->stored_bytes;
  chunk_.stored_end = std::min(stored_end, size_);
  if (stored_end > size_) {
    damage_.cut_short = true;
    Damage("the file ends inside a chunk");
  } else if (chunk_.missing > 0) {  // only the record's length is wrong
    ++damage_.num_chunks_damaged;
    Damage("a chunk of wrong length");
    chunk_.end = stored_end;
    chunk_.missing = 0;
  }
  inside_ = OpenChunk();
  if (!inside_) {
    DropChunk("a chunk of unknown compression '" + Excerpt(header->compression, 20) + "'");
  } else if (chunk_.missing == 0 && !IsChunkSound()) {
    DropChunk("a chunk whose checksum is wrong");
  }
}

std::unique_ptr<ByteSource> McapReader::OpenChunk() {
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(chunk_.begin));
  auto stored = std::make_unique<FileSpan>(file_, chunk_.stored_end - chunk_.begin);
  return MakeMcapChunkSource(chunk_.header, std::move(stored));
}

// Reads the chunk once to its end, so that no message of it is given before all are known to be
// sound: memory does not depend on the chunk's size, and inflating is much faster than converting.
bool McapReader::IsChunkSound() {
  if (chunk_.header.inflated_crc == 0) return true;
  const bool is_sound = Crc32OfRest(*inside_) == chunk_.header.inflated_crc;
  inside_ = OpenChunk();
  return is_sound;
}

void McapReader::DropChunk(const std::string& reason) {
  if (chunk_.missing == 0) ++damage_.num_chunks_damaged;
  damage_.cut_short = damage_.cut_short || chunk_.missing > 0;
  damage_.lost_bytes += static_cast<std::int64_t>(chunk_.end + chunk_.missing - position_);
  Damage(reason);
  GoOnBehindChunk(chunk_.end);
}

ChunkedReader::Step McapReader::StepInside(BagMessage& message) {
  chunk_.understood = inside_->num_delivered();
  McapRecord record;
  RecordStatus status = ReadMcapRecord(*inside_, record);
  if (status == RecordStatus::kOk && record.op == McapOp::kMessage) {
    return TakeMessage(record, *inside_, message);
  }
  if (status == RecordStatus::kOk) {
    const bool is_definition = record.op == McapOp::kSchema || record.op == McapOp::kChannel;
    const bool is_read = is_definition
                             ? TakeDefinition(record, *inside_)
                             : inside_->Skip(record.content_bytes) == record.content_bytes;
    if (is_read) return Step::kGoOn;
    status = RecordStatus::kBroken;
  }
  const bool is_short = chunk_.understood < chunk_.header.inflated_bytes;
  LeaveChunk(status == RecordStatus::kEnd && is_short ? RecordStatus::kCut : status);
  return Step::kGoOn;
}

// `status` is kEnd when the chunk ended between two records, as it should.
void McapReader::LeaveChunk(RecordStatus status) {
  if (status != RecordStatus::kEnd) {
    if (chunk_.missing == 0) ++damage_.num_chunks_damaged;
    Damage("a broken chunk");
    damage_.lost_bytes += LostBytes(chunk_.end - chunk_.begin + chunk_.missing, chunk_.understood,
                                    chunk_.header.inflated_bytes);
  }
  GoOnBehindChunk(chunk_.end);
}

ChunkedReader::Step McapReader::TakeMessage(const McapRecord& record, ByteSource& source,
                                            BagMessage& message) {
  const bool has_header = record.content_bytes >= kMcapMessageHeaderBytes;
  const auto header = has_header ? ReadMcapMessageHeader(source) : std::nullopt;
  const auto topic = header ? topics_.IndexOf(header->channel) : std::nullopt;
  const std::uint64_t data_bytes = record.content_bytes - (header ? kMcapMessageHeaderBytes : 0);
  const bool is_picked = topic && wanted_(topics_.topics()[*topic]);
  const bool is_sound = topic &&
                        data_bytes <= (is_picked ? kMaxWantedBytes : kMaxBagMessageBytes) &&
                        header->log_time_ns <= static_cast<std::uint64_t>(kMaxReceivedNs);
  const bool is_whole = is_sound && is_picked ? ReadRecordData(source, data_bytes, buffer_)
                                              : source.Skip(data_bytes) == data_bytes;
  if (!is_whole) {
    if (!inside_) return EndOfFile("the file ends inside a message");
    LeaveChunk(RecordStatus::kCut);
    return Step::kGoOn;
  }
  ++num_messages_;
  if (!is_sound) {
    ++damage_.num_messages_damaged;
    Damage("a message record without topic, or of impossible length or time");
    return Step::kGoOn;
  }
  const Timestamp received{static_cast<std::int64_t>(header->log_time_ns)};
  if (!begin_time_) begin_time_ = received;
  topics_.CountMessage(*topic);
  if (!is_picked) return Step::kGoOn;
  message.topic = *topic;
  message.received = received;
  message.data = buffer_;
  return Step::kMessage;
}

// Returns false when the source ends inside.
bool McapReader::TakeDefinition(const McapRecord& record, ByteSource& source) {
  std::vector<std::uint8_t> content;
  const bool is_sound = record.content_bytes <= kMaxDefinitionBytes;
  const bool is_whole = is_sound ? ReadRecordData(source, record.content_bytes, content)
                                 : source.Skip(record.content_bytes) == record.content_bytes;
  if (!is_whole) return false;
  const bool is_schema = record.op == McapOp::kSchema;
  if (!is_sound || !(is_schema ? topics_.AddSchema(content) : topics_.AddChannel(content))) {
    ++damage_.num_messages_damaged;
    Damage("a broken definition");
  }
  return true;
}

void McapReader::CountMissing() {
  if (!summary_.statistics || num_messages_ >= summary_.statistics->num_messages) return;
  const std::uint64_t missing = summary_.statistics->num_messages - num_messages_;
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
  damage_.num_messages_missing = static_cast<std::int64_t>(std::min(missing, kMost));
  damage_.cut_short = damage_.cut_short || !damage_.Any();
  Damage(std::to_string(num_messages_) + " of " +
         std::to_string(summary_.statistics->num_messages) + " messages exist");
}

}  // namespace

bool IsMcap(const std::filesystem::path& path) {
  std::string magic(kMcapMagic.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  return file.read(magic.data(), static_cast<std::streamsize>(magic.size())) && magic == kMcapMagic;
}

std::unique_ptr<BagReader> OpenMcap(const std::filesystem::path& path) {
  return std::make_unique<McapReader>(path);
}

}  // namespace lio
