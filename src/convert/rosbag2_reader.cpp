// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads ROS 2 bags: one or more SQLite files, in order.
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>

#include "bag_limits.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/convert/byte_order.hpp"
#include "lio/convert/ros_messages.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/printable.hpp"
#include "rosbag2_files.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinalizeStatement>;

std::string Text(sqlite3_stmt* row, int column) {
  const auto* text = sqlite3_column_text(row, column);
  return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

// Recorders make an index. Without it, sorting would copy the whole bag, so rows are read in the
// order in which they were written.
bool HasTimestampIndex(sqlite3* database) {
  sqlite3_stmt* raw = nullptr;
  sqlite3_prepare_v2(database,
                     "SELECT 1 FROM sqlite_master WHERE type = 'index' AND tbl_name = 'messages' "
                     "AND sql LIKE '%timestamp%'",
                     -1, &raw, nullptr);
  const Statement row(raw);
  return raw != nullptr && sqlite3_step(raw) == SQLITE_ROW;
}

// Returns true when the file is shorter than its SQLite header says.
bool IsCut(const fs::path& path) {
  std::array<std::uint8_t, 32> header{};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(header.data()), header.size());
  constexpr std::uint32_t kLargestPage = 65'536;  // stored as 1
  const std::uint32_t stored = LoadAs<std::uint16_t>(header.data() + 16, true);
  const std::uint64_t page_bytes = stored == 1 ? kLargestPage : stored;
  return fs::file_size(path) < page_bytes * LoadAs<std::uint32_t>(header.data() + 28, true);
}

class Rosbag2Reader : public BagReader {
 public:
  explicit Rosbag2Reader(const fs::path& path);

  const std::vector<BagTopic>& topics() const override { return topics_; }
  bool knows_all_topics() const override { return true; }
  void Select(std::function<bool(const BagTopic&)> wanted) override { wanted_ = std::move(wanted); }
  bool Next(BagMessage& message) override;
  const BagDamage& damage() const override { return damage_; }
  std::optional<Timestamp> begin_time() const override { return begin_time_; }
  std::int64_t position_bytes() const override;
  std::int64_t size_bytes() const override { return size_; }

 private:
  Database Open(const fs::path& path);
  void ReadTopics(sqlite3* database, std::map<std::int64_t, std::size_t>& topic_of_id);
  void ReadDefinitions(sqlite3* database);
  bool OpenNextFile();
  void CloseFile(int status);
  void Damage(const std::string& reason);

  Rosbag2Files files_;
  std::size_t next_file_ = 0;
  Database database_;  // declared before its statement, closed after it
  Statement rows_;
  std::map<std::int64_t, std::size_t> topic_of_id_;  // topics of the open file
  std::vector<BagTopic> topics_;
  std::function<bool(const BagTopic&)> wanted_ = [](const BagTopic&) { return true; };
  std::optional<Timestamp> begin_time_;
  std::int64_t num_rows_ = 0;
  std::int64_t bytes_read_ = 0;
  std::int64_t size_ = 0;
  BagDamage damage_;
};

Rosbag2Reader::Rosbag2Reader(const fs::path& path) : files_(FindRosbag2Files(path)) {
  for (const fs::path& file : files_.paths) {
    if (!fs::exists(file)) continue;
    size_ += static_cast<std::int64_t>(fs::file_size(file));
    std::map<std::int64_t, std::size_t> ignored;
    if (Database database = Open(file)) ReadTopics(database.get(), ignored);
  }
  damage_ = BagDamage{};  // damage is counted anew, and once, while reading
  if (topics_.empty()) throw InputError(path.string() + ": no ROS 2 bag: no topics in it");
}

Database Rosbag2Reader::Open(const fs::path& path) {
  sqlite3* raw = nullptr;
  // A recorder that died leaves a write-ahead log beside the file, which an immutable connection
  // would not see. Without such a log, an immutable connection makes read-only folders work.
  const bool has_log = fs::exists(path.string() + "-wal") && fs::file_size(path.string() + "-wal");
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    const bool special = c == '?' || c == '#' || c == '%';
    uri += special ? (c == '?' ? "%3f" : c == '#' ? "%23" : "%25") : std::string(1, c);
  }
  uri += has_log ? "" : "?immutable=1";
  const int status =
      sqlite3_open_v2(uri.c_str(), &raw, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  Database database(raw);
  if (status != SQLITE_OK) {
    Damage(path.filename().string() + ": " + (raw ? sqlite3_errmsg(raw) : "cannot be opened"));
    return {};
  }
  sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, static_cast<int>(kMaxBagMessageBytes));
  // This lets SQLite read a file that is shorter than its header says, as far as it goes.
  sqlite3_db_config(raw, SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, nullptr);
  return database;
}

void Rosbag2Reader::ReadTopics(sqlite3* database,
                               std::map<std::int64_t, std::size_t>& topic_of_id) {
  sqlite3_stmt* raw = nullptr;
  sqlite3_prepare_v2(database, "SELECT id, name, type, serialization_format FROM topics", -1, &raw,
                     nullptr);
  const Statement rows(raw);
  while (raw != nullptr && sqlite3_step(raw) == SQLITE_ROW) {
    BagTopic topic;
    topic.name = Excerpt(Text(raw, 1), kMaxNameBytes);
    topic.type = Ros1TypeName(Excerpt(Text(raw, 2), kMaxNameBytes));
    topic.encoding = Text(raw, 3) == "ros1" ? RosEncoding::kRos1 : RosEncoding::kCdr;
    const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& other) {
      return other.name == topic.name && other.type == topic.type;
    });
    topic_of_id[sqlite3_column_int64(raw, 0)] = static_cast<std::size_t>(same - topics_.begin());
    if (same == topics_.end()) topics_.push_back(std::move(topic));
  }
  ReadDefinitions(database);
}

// Recorders since ROS 2 Iron store the definitions in a table of their own.
void Rosbag2Reader::ReadDefinitions(sqlite3* database) {
  sqlite3_stmt* raw = nullptr;
  sqlite3_prepare_v2(database,
                     "SELECT topic_type, encoded_message_definition FROM message_definitions "
                     "WHERE encoding = 'ros2msg'",
                     -1, &raw, nullptr);
  const Statement rows(raw);
  while (raw != nullptr && sqlite3_step(raw) == SQLITE_ROW) {
    const std::string type = Ros1TypeName(Text(raw, 0));
    for (BagTopic& topic : topics_) {
      if (topic.type == type) topic.definition = Text(raw, 1);
    }
  }
}

bool Rosbag2Reader::OpenNextFile() {
  while (next_file_ < files_.paths.size()) {
    const fs::path& path = files_.paths[next_file_++];
    if (!fs::exists(path)) {
      Damage(path.filename().string() + " is missing");
      damage_.cut_short = true;
      continue;
    }
    database_ = Open(path);
    if (!database_) {
      damage_.cut_short = true;
      continue;
    }
    topic_of_id_.clear();
    ReadTopics(database_.get(), topic_of_id_);
    // A truncated file may lack pages of the index that are needed early: more can be read through
    // its table.
    const bool in_time_order = HasTimestampIndex(database_.get()) && !IsCut(path);
    const std::string query = std::string("SELECT topic_id, timestamp, data FROM messages") +
                              (in_time_order ? " ORDER BY timestamp, id" : "");
    sqlite3_stmt* raw = nullptr;
    const int status = sqlite3_prepare_v2(database_.get(), query.c_str(), -1, &raw, nullptr);
    rows_.reset(raw);
    if (status == SQLITE_OK) return true;
    CloseFile(status);
  }
  return false;
}

void Rosbag2Reader::CloseFile(int status) {
  if (status != SQLITE_DONE && status != SQLITE_OK) {
    damage_.cut_short = true;
    Damage(files_.paths[next_file_ - 1].filename().string() + ": " +
           sqlite3_errmsg(database_.get()));
  }
  rows_.reset();
  database_.reset();
}

bool Rosbag2Reader::Next(BagMessage& message) {
  while (rows_ || OpenNextFile()) {
    const int status = sqlite3_step(rows_.get());
    if (status != SQLITE_ROW) {
      CloseFile(status);
      continue;
    }
    ++num_rows_;
    const auto topic = topic_of_id_.find(sqlite3_column_int64(rows_.get(), 0));
    if (topic == topic_of_id_.end()) {
      ++damage_.num_messages_damaged;
      Damage("a message without topic");
      continue;
    }
    const Timestamp received{sqlite3_column_int64(rows_.get(), 1)};
    if (received.ns < 0 || received.ns > kMaxReceivedNs) {
      ++damage_.num_messages_damaged;
      Damage("a message received at an impossible time");
      continue;
    }
    if (!begin_time_) begin_time_ = received;
    ++topics_[topic->second].num_messages;
    if (!wanted_(topics_[topic->second])) continue;
    const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(rows_.get(), 2));
    const int size = sqlite3_column_bytes(rows_.get(), 2);
    bytes_read_ += size;
    message.topic = topic->second;
    message.received = received;
    message.data = ByteView(data, data == nullptr ? 0 : static_cast<std::size_t>(size));
    return true;
  }
  damage_.num_messages_missing = std::max<std::int64_t>(0, files_.num_messages - num_rows_);
  if (damage_.num_messages_missing > 0) {
    damage_.cut_short = true;
    Damage(std::to_string(num_rows_) + " of " + std::to_string(files_.num_messages) +
           " messages exist");
  }
  return false;
}

std::int64_t Rosbag2Reader::position_bytes() const {
  return std::min(bytes_read_, size_);
}

void Rosbag2Reader::Damage(const std::string& reason) {
  if (damage_.first_reason.empty()) damage_.first_reason = reason;
}

}  // namespace

std::unique_ptr<BagReader> OpenRosbag2(const fs::path& path) {
  return std::make_unique<Rosbag2Reader>(path);
}

}  // namespace lio
