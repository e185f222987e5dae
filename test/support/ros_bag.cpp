// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/ros_bag.hpp"

#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace lio::test {
namespace {

void Append(std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& what) {
  to.reserve(to.size() + what.size());
  for (const std::uint8_t byte : what) to.push_back(byte);
}

template <typename T>
void AppendNumber(std::vector<std::uint8_t>& to, T value) {
  std::array<std::uint8_t, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  for (const std::uint8_t byte : raw) to.push_back(byte);
}

// Builds the fields of a record's header.
class Fields {
 public:
  Fields& Text(const std::string& name, const std::string& value) {
    AppendNumber(bytes_, static_cast<std::uint32_t>(name.size() + 1 + value.size()));
    const std::string field = name + "=" + value;
    bytes_.insert(bytes_.end(), field.begin(), field.end());
    return *this;
  }
  template <typename T>
  Fields& Number(const std::string& name, T value) {
    return Text(name, std::string(reinterpret_cast<const char*>(&value), sizeof(T)));
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::vector<std::uint8_t> Record(const Fields& header, const std::vector<std::uint8_t>& data) {
  std::vector<std::uint8_t> record;
  AppendNumber(record, static_cast<std::uint32_t>(header.bytes().size()));
  Append(record, header.bytes());
  AppendNumber(record, static_cast<std::uint32_t>(data.size()));
  Append(record, data);
  return record;
}

std::uint64_t RosTime(Timestamp stamp) {
  const auto seconds = static_cast<std::uint64_t>(stamp.ns / 1'000'000'000);
  const auto nanoseconds = static_cast<std::uint64_t>(stamp.ns % 1'000'000'000);
  return seconds | (nanoseconds << 32);
}

std::vector<std::uint8_t> Compress(const std::string& compression, std::vector<std::uint8_t> data) {
  std::vector<std::uint8_t> out;
  if (compression == "lz4") {
    out.resize(LZ4F_compressFrameBound(data.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), data.data(), data.size(), nullptr));
  } else if (compression == "bz2") {
    auto size = static_cast<unsigned>(data.size() + data.size() / 50 + 1000);
    out.resize(size);
    BZ2_bzBuffToBuffCompress(reinterpret_cast<char*>(out.data()), &size,
                             reinterpret_cast<char*>(data.data()),
                             static_cast<unsigned>(data.size()), 1, 0, 0);
    out.resize(size);
  } else {
    out = std::move(data);
  }
  return out;
}

template <typename T>
void Store(std::uint8_t* at, double value, bool big_endian) {
  const T number = static_cast<T>(value);
  std::memcpy(at, &number, sizeof(T));
  if (big_endian) std::reverse(at, at + sizeof(T));
}

void Execute(sqlite3* database, const std::string& sql) {
  char* message = nullptr;
  if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &message) != SQLITE_OK) {
    throw std::runtime_error(message);
  }
}

}  // namespace

RosBytes::RosBytes(RosEncoding encoding, bool big_endian)
    : encoding_(encoding), big_endian_(big_endian) {
  if (encoding == RosEncoding::kCdr) bytes_ = {0, std::uint8_t(big_endian ? 0 : 1), 0, 0};
}

void RosBytes::Align(std::size_t size) {
  if (encoding_ == RosEncoding::kRos1) return;
  while ((bytes_.size() - 4) % size != 0) bytes_.push_back(0);
}

void RosBytes::PutRaw(const void* value, std::size_t size) {
  bytes_.resize(bytes_.size() + size);
  std::memcpy(bytes_.data() + bytes_.size() - size, value, size);
  if (big_endian_) std::reverse(bytes_.end() - static_cast<std::ptrdiff_t>(size), bytes_.end());
}

RosBytes& RosBytes::PutString(const std::string& text) {
  const bool cdr = encoding_ == RosEncoding::kCdr;
  Put(static_cast<std::uint32_t>(text.size() + (cdr ? 1 : 0)));
  bytes_.insert(bytes_.end(), text.begin(), text.end());
  if (cdr) bytes_.push_back(0);
  return *this;
}

RosBytes& RosBytes::PutTime(Timestamp stamp) {
  Put(static_cast<std::uint32_t>(stamp.ns / 1'000'000'000));
  return Put(static_cast<std::uint32_t>(stamp.ns % 1'000'000'000));
}

RosBytes& RosBytes::PutHeader(Timestamp stamp, const std::string& frame_id) {
  if (encoding_ == RosEncoding::kRos1) Put(std::uint32_t{7});
  PutTime(stamp);
  return PutString(frame_id);
}

RosBytes& RosBytes::PutZeros(std::size_t num_doubles) {
  for (std::size_t i = 0; i < num_doubles; ++i) Put(0.0);
  return *this;
}

RosBytes& RosBytes::PutBlob(const std::vector<std::uint8_t>& data) {
  Put(static_cast<std::uint32_t>(data.size()));
  Append(bytes_, data);
  return *this;
}

void TestCloud::Resize(std::size_t num_points) {
  width = static_cast<std::uint32_t>(num_points) / height;
  data.resize(num_points * point_step);
}

void TestCloud::Set(std::size_t i, const std::string& field, double value) {
  for (const CloudField& f : fields) {
    if (f.name != field) continue;
    std::uint8_t* at = data.data() + i * point_step + f.offset;
    switch (f.type) {
      case FieldType::kInt8:
        return Store<std::int8_t>(at, value, big_endian);
      case FieldType::kUint8:
        return Store<std::uint8_t>(at, value, big_endian);
      case FieldType::kInt16:
        return Store<std::int16_t>(at, value, big_endian);
      case FieldType::kUint16:
        return Store<std::uint16_t>(at, value, big_endian);
      case FieldType::kInt32:
        return Store<std::int32_t>(at, value, big_endian);
      case FieldType::kUint32:
        return Store<std::uint32_t>(at, value, big_endian);
      case FieldType::kFloat32:
        return Store<float>(at, value, big_endian);
      case FieldType::kFloat64:
        return Store<double>(at, value, big_endian);
    }
  }
}

std::vector<std::uint8_t> ImuMessage(const ImuSample& sample, RosBytes bytes) {
  bytes.PutHeader(sample.stamp, "imu_link").PutZeros(4 + 9);
  for (int i = 0; i < 3; ++i) bytes.Put(sample.w_imu_radps[i]);
  bytes.PutZeros(9);
  for (int i = 0; i < 3; ++i) bytes.Put(sample.f_imu_mps2[i]);
  return bytes.PutZeros(9).bytes();
}

std::vector<std::uint8_t> CloudMessage(const TestCloud& cloud, RosBytes bytes) {
  bytes.PutHeader(cloud.stamp).Put(cloud.height).Put(cloud.width);
  bytes.Put(static_cast<std::uint32_t>(cloud.fields.size()));
  for (const CloudField& field : cloud.fields) {
    bytes.PutString(field.name).Put(field.offset).Put(static_cast<std::uint8_t>(field.type));
    bytes.Put(std::uint32_t{1});
  }
  const std::uint32_t row_step =
      cloud.row_step != 0 ? cloud.row_step : cloud.width * cloud.point_step;
  bytes.Put(std::uint8_t{cloud.big_endian}).Put(cloud.point_step).Put(row_step);
  return bytes.PutBlob(cloud.data).Put(std::uint8_t{1}).bytes();
}

namespace {

void PutPose(RosBytes& bytes, const Pose& pose) {
  for (int i = 0; i < 3; ++i) bytes.Put(pose.translation[i]);
  for (int i = 0; i < 4; ++i) bytes.Put(pose.rotation.coeffs()[i]);  // x y z w
}

}  // namespace

std::vector<std::uint8_t> OdometryMessage(const StampedPose& pose, RosBytes bytes) {
  bytes.PutHeader(pose.stamp, "world").PutString("body");
  PutPose(bytes, pose.pose);
  return bytes.PutZeros(36 + 6 + 36).bytes();
}

std::vector<std::uint8_t> PoseMessage(const StampedPose& pose, RosBytes bytes) {
  bytes.PutHeader(pose.stamp, "world");
  PutPose(bytes, pose.pose);
  return bytes.bytes();
}

Bag1Writer::Bag1Writer(const std::filesystem::path& path, Options options)
    : file_(path, std::ios::binary), options_(std::move(options)) {
  file_ << "#ROSBAG V2.0\n";
  WriteBagHeader(0);
}

void Bag1Writer::WriteBagHeader(std::uint64_t index_position) {
  Fields header;
  header.Number("op", std::uint8_t{3})
      .Number("index_pos", index_position)
      .Number("conn_count", static_cast<std::uint32_t>(connections_.size()))
      .Number("chunk_count", num_chunks_);
  constexpr std::size_t kRecordBytes = 4096;
  const std::vector<std::uint8_t> padding(kRecordBytes - 8 - header.bytes().size(), ' ');
  const auto record = Record(header, padding);
  file_.write(reinterpret_cast<const char*>(record.data()),
              static_cast<std::streamsize>(record.size()));
}

void Bag1Writer::Write(const std::string& topic, const std::string& type, Timestamp received,
                       const std::vector<std::uint8_t>& data, const std::string& definition) {
  auto known = std::find_if(connections_.begin(), connections_.end(),
                            [&](const Connection& c) { return c.topic == topic; });
  if (known == connections_.end()) {
    const auto id = static_cast<std::uint32_t>(connections_.size());
    Fields fields;
    fields.Text("topic", topic).Text("type", type).Text("md5sum", "*");
    fields.Text("message_definition", definition);
    Fields header;
    header.Number("op", std::uint8_t{7}).Number("conn", id).Text("topic", topic);
    connections_.push_back({id, topic, Record(header, fields.bytes()), false});
    known = connections_.end() - 1;
  }
  if (!known->in_chunk) Append(chunk_, known->record);
  known->in_chunk = true;
  Fields header;
  header.Number("op", std::uint8_t{2}).Number("conn", known->id).Number("time", RosTime(received));
  Append(chunk_, Record(header, data));
  if (chunk_.size() >= options_.chunk_bytes) FlushChunk();
}

void Bag1Writer::FlushChunk() {
  if (chunk_.empty()) return;
  Fields header;
  header.Number("op", std::uint8_t{5})
      .Text("compression", options_.compression)
      .Number("size", static_cast<std::uint32_t>(chunk_.size()));
  const auto record = Record(header, Compress(options_.compression, std::move(chunk_)));
  file_.write(reinterpret_cast<const char*>(record.data()),
              static_cast<std::streamsize>(record.size()));
  chunk_.clear();
  ++num_chunks_;
}

void Bag1Writer::Close() {
  FlushChunk();
  if (options_.with_index) {
    const auto index_position = static_cast<std::uint64_t>(file_.tellp());
    std::vector<std::uint8_t> index;
    for (const Connection& connection : connections_) Append(index, connection.record);
    for (std::uint32_t i = 0; i < num_chunks_; ++i) {
      Append(index, Record(Fields().Number("op", std::uint8_t{6}), {}));
    }
    file_.write(reinterpret_cast<const char*>(index.data()),
                static_cast<std::streamsize>(index.size()));
    file_.seekp(13);
    WriteBagHeader(index_position);
  }
  file_.close();
}

Bag2Writer::Bag2Writer(const std::filesystem::path& folder, int messages_per_file)
    : folder_(folder), messages_per_file_(messages_per_file) {
  std::filesystem::create_directories(folder);
  OpenFile();
}

Bag2Writer::~Bag2Writer() {
  CloseFile();
}

void Bag2Writer::OpenFile() {
  const auto file = folder_ / ("bag_" + std::to_string(num_files_++) + ".db3");
  if (sqlite3_open(file.c_str(), &database_) != SQLITE_OK) throw std::runtime_error("sqlite3");
  Execute(database_,
          "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
          "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
          "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
          "timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
          "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, "
          "encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL, "
          "type_description_hash TEXT NOT NULL);"
          "PRAGMA synchronous=OFF;CREATE INDEX timestamp_idx ON messages (timestamp ASC);BEGIN;");
}

void Bag2Writer::CloseFile() {
  if (database_ == nullptr) return;
  Execute(database_, "COMMIT;");
  sqlite3_close(database_);
  database_ = nullptr;
  topic_ids_.clear();
  num_in_file_ = 0;
}

void Bag2Writer::Write(const std::string& topic, const std::string& type, Timestamp received,
                       const std::vector<std::uint8_t>& data, const std::string& definition) {
  if (num_in_file_ == messages_per_file_) {
    CloseFile();
    OpenFile();
  }
  if (!topic_ids_.contains(topic)) {
    const int id = static_cast<int>(topic_ids_.size()) + 1;
    topic_ids_[topic] = id;
    Execute(database_, "INSERT INTO topics VALUES(" + std::to_string(id) + ",'" + topic + "','" +
                           type + "','cdr','');");
    if (!definition.empty()) {
      Execute(database_, "INSERT INTO message_definitions VALUES(NULL,'" + type + "','ros2msg','" +
                             definition + "','');");
    }
  }
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database_, "INSERT INTO messages VALUES(NULL,?,?,?)", -1, &statement, nullptr);
  sqlite3_bind_int(statement, 1, topic_ids_[topic]);
  sqlite3_bind_int64(statement, 2, received.ns);
  sqlite3_bind_blob(statement, 3, data.data(), static_cast<int>(data.size()), SQLITE_STATIC);
  sqlite3_step(statement);
  sqlite3_finalize(statement);
  ++num_in_file_;
  ++num_messages_;
}

void Bag2Writer::Close() {
  CloseFile();
  std::ofstream metadata(folder_ / "metadata.yaml");
  metadata << "rosbag2_bagfile_information:\n  version: 4\n  storage_identifier: sqlite3\n"
           << "  relative_file_paths:\n";
  for (int i = 0; i < num_files_; ++i) metadata << "    - bag_" << i << ".db3\n";
  metadata << "  message_count: " << num_messages_ << "\n  compression_format: \"\"\n"
           << "  compression_mode: \"\"\n";
}

}  // namespace lio::test
