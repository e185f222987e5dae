// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes ROS messages and bags for tests: ROS 1 (any chunk compression, with and without index) and
// ROS 2 (SQLite, CDR of either byte order).
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "lio/convert/ros_messages.hpp"

struct sqlite3;

namespace lio::test {

// When a bag's messages came, where it does not matter.
inline constexpr Timestamp kReceived{1'600'000'000'000'000'000};

// Tells how a message is laid out in bytes.
struct RosForm {
  RosEncoding encoding;
  bool big_endian;
};

// Serialises values in order.
class RosBytes {
 public:
  explicit RosBytes(RosEncoding encoding = RosEncoding::kRos1, bool big_endian = false);

  template <typename T>
  RosBytes& Put(T value) {
    Align(sizeof(T));
    PutRaw(&value, sizeof(T));
    return *this;
  }
  RosBytes& PutString(const std::string& text);
  RosBytes& PutTime(Timestamp stamp);
  RosBytes& PutHeader(Timestamp stamp, const std::string& frame_id = "velodyne");
  RosBytes& PutZeros(std::size_t num_doubles);
  RosBytes& PutBlob(const std::vector<std::uint8_t>& data);  // length and bytes

  RosEncoding encoding() const { return encoding_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  void Align(std::size_t size);
  void PutRaw(const void* value, std::size_t size);

  RosEncoding encoding_;
  bool big_endian_;
  std::vector<std::uint8_t> bytes_;
};

// Builds a cloud whose points are written field by field.
struct TestCloud {
  Timestamp stamp;
  std::uint32_t height = 1;
  std::uint32_t width = 0;
  std::vector<CloudField> fields;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;  // 0: packed
  bool big_endian = false;
  std::vector<std::uint8_t> data;

  // Appends zeroed points; `width` grows.
  void Resize(std::size_t num_points);
  // Stores `value` in the named field of point `i`, in the field's type.
  void Set(std::size_t i, const std::string& field, double value);
};

std::vector<std::uint8_t> ImuMessage(const ImuSample& sample, RosBytes bytes = RosBytes());
std::vector<std::uint8_t> CloudMessage(const TestCloud& cloud, RosBytes bytes = RosBytes());
std::vector<std::uint8_t> OdometryMessage(const StampedPose& pose, RosBytes bytes = RosBytes());
std::vector<std::uint8_t> PoseMessage(const StampedPose& pose, RosBytes bytes = RosBytes());

class Bag1Writer {
 public:
  struct Options {
    std::string compression = "none";  // "lz4", "bz2"
    std::size_t chunk_bytes = 100'000;
    bool with_index = true;
  };

  Bag1Writer(const std::filesystem::path& path, Options options);
  explicit Bag1Writer(const std::filesystem::path& path) : Bag1Writer(path, Options{}) {}

  void Write(const std::string& topic, const std::string& type, Timestamp received,
             const std::vector<std::uint8_t>& data, const std::string& definition = "");
  void Close();

 private:
  struct Connection {
    std::uint32_t id = 0;
    std::string topic;
    std::vector<std::uint8_t> record;
    bool in_chunk = false;
  };

  void FlushChunk();
  void WriteBagHeader(std::uint64_t index_position);

  std::ofstream file_;
  Options options_;
  std::vector<Connection> connections_;
  std::vector<std::uint8_t> chunk_;
  std::uint32_t num_chunks_ = 0;
};

class Bag2Writer {
 public:
  // Makes the folder with metadata.yaml and bag_0.db3, bag_1.db3, ...; each file holds
  // `messages_per_file`.
  explicit Bag2Writer(const std::filesystem::path& folder, int messages_per_file = 1'000'000);
  ~Bag2Writer();
  Bag2Writer(const Bag2Writer&) = delete;
  Bag2Writer& operator=(const Bag2Writer&) = delete;

  // `type` is in ROS 2's form, "sensor_msgs/msg/Imu".
  void Write(const std::string& topic, const std::string& type, Timestamp received,
             const std::vector<std::uint8_t>& data, const std::string& definition = "");
  void Close();

 private:
  void OpenFile();
  void CloseFile();

  std::filesystem::path folder_;
  int messages_per_file_;
  int num_in_file_ = 0;
  int num_messages_ = 0;
  int num_files_ = 0;
  sqlite3* database_ = nullptr;
  std::map<std::string, int> topic_ids_;  // topics of the open file
};

}  // namespace lio::test
