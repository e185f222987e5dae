// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads a ROS 1 bag from front to back. The index at its end serves only two purposes: to know all
// topics early, and to find how much of a truncated bag is missing.
#include <algorithm>
#include <fstream>
#include <limits>
#include <map>

#include "bag_limits.hpp"
#include "chunked_reader.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/printable.hpp"
#include "rosbag1_record.hpp"

namespace lio {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";

class Rosbag1Reader : public ChunkedReader {
 public:
  explicit Rosbag1Reader(const std::filesystem::path& path);

  const std::vector<BagTopic>& topics() const override { return topics_; }
  bool knows_all_topics() const override { return knows_all_topics_; }

 private:
  struct Chunk {
    std::uint64_t begin = 0;  // file positions of the present chunk's data
    std::uint64_t end = 0;
    std::uint64_t missing = 0;     // bytes of the last chunk that are missing from the file
    std::uint64_t inflated = 0;    // size to which the present chunk should inflate
    std::uint64_t understood = 0;  // bytes of the chunk's records that were sound
  };

  void ReadBagHeader();
  void ReadTopicsOfIndex();
  Step StepOutside(BagMessage& message) override;
  Step StepInside(BagMessage& message) override;
  void EnterChunk(const RecordHeader& header);
  void LeaveChunk(RecordStatus status);
  Step TakeMessage(const RecordHeader& header, ByteSource& source, BagMessage& message);
  bool TakeConnection(const RecordHeader& header, ByteSource& source);
  void CountMissing() override;

  Chunk chunk_;

  RecordHeader bag_header_;
  std::uint32_t num_chunks_ = 0;
  std::uint32_t num_chunk_infos_ = 0;
  std::vector<BagTopic> topics_;
  bool knows_all_topics_ = false;
  std::map<std::uint32_t, std::size_t> topic_of_connection_;
};

Rosbag1Reader::Rosbag1Reader(const std::filesystem::path& path) {
  RefuseIrregular(path);
  file_.open(path, std::ios::binary);
  std::string magic(kMagic.size(), '\0');
  if (!file_ || !file_.read(magic.data(), static_cast<std::streamsize>(magic.size())) ||
      magic != kMagic) {
    throw InputError(path.string() + ": no ROS 1 bag of format 2.0");
  }
  size_ = std::filesystem::file_size(path);
  outside_ = std::make_unique<FileSpan>(file_, size_ - kMagic.size());
  position_ = kMagic.size();
  ReadBagHeader();
  ReadTopicsOfIndex();
}

void Rosbag1Reader::ReadBagHeader() {
  const RecordStatus status = ReadRecordHeader(*outside_, bag_header_);
  if (status != RecordStatus::kOk || bag_header_.op != RecordOp::kBagHeader) {
    damage_.cut_short = true;
    Damage("there is no bag header");
    damage_.lost_bytes += static_cast<std::int64_t>(size_ - position_);
    finished_ = true;
    return;
  }
  outside_->Skip(bag_header_.data_bytes);
  damage_.not_closed = bag_header_.index_position.value_or(0) == 0;
}

void Rosbag1Reader::ReadTopicsOfIndex() {
  const std::uint64_t index = bag_header_.index_position.value_or(0);
  if (finished_ || index == 0 || index >= size_) return;
  const std::uint64_t here = Here();
  file_.seekg(static_cast<std::streamoff>(index));
  FileSpan span(file_, size_ - index);
  RecordHeader header;
  std::uint32_t num_connections = 0;
  while (ReadRecordHeader(span, header) == RecordStatus::kOk &&
         header.op == RecordOp::kConnection) {
    if (!TakeConnection(header, span)) break;
    ++num_connections;
  }
  knows_all_topics_ = num_connections == bag_header_.num_connections;
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(here));
}

ChunkedReader::Step Rosbag1Reader::StepOutside(BagMessage& message) {
  position_ = Here();
  RecordHeader header;
  const RecordStatus status = ReadRecordHeader(*outside_, header);
  if (status == RecordStatus::kEnd) return Step::kEnd;
  const bool fits = header.data_bytes <= outside_->left();
  if (status != RecordStatus::kOk || (!fits && header.op != RecordOp::kChunk)) {
    damage_.cut_short = true;
    damage_.lost_bytes += static_cast<std::int64_t>(size_ - position_);
    Damage(status == RecordStatus::kBroken ? "bytes that are no record"
                                           : "the file ends inside a record");
    return Step::kEnd;
  }
  if (header.op == RecordOp::kChunk) {
    EnterChunk(header);
    return Step::kGoOn;
  }
  if (header.op == RecordOp::kMessage) return TakeMessage(header, *outside_, message);
  if (header.op == RecordOp::kConnection) {
    TakeConnection(header, *outside_);
    return Step::kGoOn;
  }
  if (header.op == RecordOp::kChunkInfo) ++num_chunk_infos_;
  outside_->Skip(header.data_bytes);
  return Step::kGoOn;
}

// A chunk that inflates to more than it says is a bomb. A size of zero says nothing.
std::uint64_t MaxInflated(const RecordHeader& header) {
  const std::uint64_t claimed = header.uncompressed_bytes;
  return claimed == 0 ? kMaxChunkBytes : std::min(claimed, kMaxChunkBytes);
}

void Rosbag1Reader::EnterChunk(const RecordHeader& header) {
  ++num_chunks_;
  chunk_.begin = Here();
  // A recorder that dies leaves the size of its last chunk at zero.
  const bool open = header.data_bytes == 0 && damage_.not_closed;
  chunk_.end = open ? size_ : chunk_.begin + header.data_bytes;
  chunk_.inflated = header.uncompressed_bytes;
  if (chunk_.end > size_) {
    damage_.cut_short = true;
    Damage("the file ends inside a chunk");
    chunk_.missing = chunk_.end - size_;
    chunk_.end = size_;
  }
  auto span = std::make_unique<FileSpan>(file_, chunk_.end - chunk_.begin);
  if (header.compression == "none") {
    inside_ = std::move(span);
  } else if (header.compression == "lz4") {
    inside_ = Limited(MakeLz4Source(std::move(span)), MaxInflated(header));
  } else if (header.compression == "bz2") {
    inside_ = Limited(MakeBz2Source(std::move(span)), MaxInflated(header));
  } else {
    ++damage_.num_chunks_damaged;
    damage_.lost_bytes += static_cast<std::int64_t>(chunk_.end - chunk_.begin);
    Damage("chunk of unknown compression '" + Excerpt(header.compression, 20) + "'");
    inside_ = std::make_unique<FileSpan>(file_, 0);
  }
}

ChunkedReader::Step Rosbag1Reader::StepInside(BagMessage& message) {
  chunk_.understood = inside_->num_delivered();
  RecordHeader header;
  const RecordStatus status = ReadRecordHeader(*inside_, header);
  if (status == RecordStatus::kOk && header.op == RecordOp::kMessage) {
    return TakeMessage(header, *inside_, message);
  }
  if (status == RecordStatus::kOk && header.op == RecordOp::kConnection) {
    if (TakeConnection(header, *inside_)) return Step::kGoOn;
    LeaveChunk(RecordStatus::kCut);
    return Step::kGoOn;
  }
  LeaveChunk(status == RecordStatus::kOk ? RecordStatus::kBroken : status);
  return Step::kGoOn;
}

// `status` is kEnd when the chunk ended between two records, as it should.
void Rosbag1Reader::LeaveChunk(RecordStatus status) {
  if (status != RecordStatus::kEnd && chunk_.end == size_) {
    damage_.cut_short = true;
    Damage("the last chunk is incomplete");
  } else if (status != RecordStatus::kEnd) {
    ++damage_.num_chunks_damaged;
    Damage("broken chunk");
    damage_.lost_bytes += LostBytes(chunk_.end - chunk_.begin, chunk_.understood, chunk_.inflated);
  }
  GoOnBehindChunk(chunk_.end);
}

ChunkedReader::Step Rosbag1Reader::TakeMessage(const RecordHeader& header, ByteSource& source,
                                               BagMessage& message) {
  const auto topic = header.connection ? topic_of_connection_.find(*header.connection)
                                       : topic_of_connection_.end();
  const bool known = topic != topic_of_connection_.end() && header.time;
  const bool is_picked = known && wanted_(topics_[topic->second]);
  const bool sound =
      known && header.data_bytes <= (is_picked ? kMaxWantedBytes : kMaxBagMessageBytes);
  const bool wanted = sound && is_picked;
  const bool whole = wanted ? ReadRecordData(source, header.data_bytes, buffer_)
                            : source.Skip(header.data_bytes) == header.data_bytes;
  if (!whole) {
    if (inside_) {
      LeaveChunk(RecordStatus::kCut);
      return Step::kGoOn;
    }
    damage_.cut_short = true;
    Damage("the file ends inside a message");
    return Step::kEnd;
  }
  if (!sound) {
    ++damage_.num_messages_damaged;
    Damage("a message record without topic or time, or of impossible length");
    return Step::kGoOn;
  }
  if (!begin_time_) begin_time_ = header.time;
  ++topics_[topic->second].num_messages;
  if (!wanted) return Step::kGoOn;
  message.topic = topic->second;
  message.received = *header.time;
  message.data = buffer_;
  return Step::kMessage;
}

// Returns false when the source ends inside.
bool Rosbag1Reader::TakeConnection(const RecordHeader& header, ByteSource& source) {
  std::vector<std::uint8_t> data;
  if (header.data_bytes > kMaxDefinitionBytes) return false;
  if (!ReadRecordData(source, header.data_bytes, data)) return false;
  if (!header.connection || topic_of_connection_.contains(*header.connection)) return true;
  BagTopic topic;
  topic.name = Excerpt(header.topic, kMaxNameBytes);
  (void)VisitFields(data, [&](std::string_view name, std::string_view value) {
    if (name == "type") topic.type = Excerpt(value, kMaxNameBytes);
    if (name == "message_definition") topic.definition = value;
  });
  const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& other) {
    return other.name == topic.name && other.type == topic.type;
  });
  topic_of_connection_[*header.connection] = static_cast<std::size_t>(same - topics_.begin());
  if (same == topics_.end()) topics_.push_back(std::move(topic));
  return true;
}

void Rosbag1Reader::CountMissing() {
  const std::uint64_t index = bag_header_.index_position.value_or(0);
  const std::uint64_t missing = std::max(chunk_.missing, index > size_ ? index - size_ : 0);
  if (missing > 0) damage_.cut_short = true;
  // A damaged header may state any position.
  const std::int64_t most = std::numeric_limits<std::int64_t>::max() - damage_.lost_bytes;
  damage_.lost_bytes +=
      static_cast<std::int64_t>(std::min(missing, static_cast<std::uint64_t>(most)));
  const bool complete =
      num_chunks_ >= bag_header_.num_chunks && num_chunk_infos_ >= bag_header_.num_chunks;
  if (index > 0 && !complete) {
    damage_.cut_short = true;
    Damage(std::to_string(num_chunks_) + " of " + std::to_string(bag_header_.num_chunks) +
           " chunks exist");
  }
}

}  // namespace

std::unique_ptr<BagReader> OpenRosbag1(const std::filesystem::path& path) {
  return std::make_unique<Rosbag1Reader>(path);
}

}  // namespace lio
