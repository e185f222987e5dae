// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes MCAP files for tests, as mcap.dev/spec describes them: with and without chunks, checksums
// and summary, each compression, messages of ROS 1 or ROS 2.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "lio/convert/bag_reader.hpp"

namespace lio::test {

class McapWriter {
 public:
  struct Options {
    std::string compression;            // "", "lz4" or "zstd"
    std::size_t chunk_bytes = 100'000;  // 0: messages stand outside of chunks
    bool with_summary = true;
    bool with_crc = true;
    RosEncoding encoding = RosEncoding::kRos1;
  };

  McapWriter(const std::filesystem::path& path, Options options);

  // `type` is in the form of the encoding: "sensor_msgs/Imu" or "sensor_msgs/msg/Imu".
  void Write(const std::string& topic, const std::string& type, Timestamp received,
             const std::vector<std::uint8_t>& data, const std::string& definition = "");
  // Writes any record where a message would stand.
  void WriteRecord(std::uint8_t op, const std::vector<std::uint8_t>& content);
  // Ends the data and writes summary, footer and magic.
  void Close();
  // Writes the messages that are waiting for a full chunk.
  void FlushChunk();

 private:
  std::uint16_t Channel(const std::string& topic, const std::string& type,
                        const std::string& definition);
  void WriteToFile(const std::vector<std::uint8_t>& bytes);

  std::ofstream file_;
  Options options_;
  std::map<std::string, std::uint16_t> channels_;
  std::vector<std::uint8_t> definitions_;  // records of all schemas and channels
  std::vector<std::uint8_t> chunk_;
  std::uint64_t num_messages_ = 0;
};

// Copies all messages of a bag of ROS 1 into an MCAP file. `in_form` gives a message's bytes.
template <typename InForm>
void CopyToMcap(const std::filesystem::path& bag, const std::filesystem::path& mcap,
                const McapWriter::Options& options, InForm&& in_form) {
  McapWriter writer(mcap, options);
  const auto reader = OpenBag(bag);
  for (BagMessage message; reader->Next(message);) {
    const BagTopic& topic = reader->topics()[message.topic];
    std::string type = topic.type;
    if (options.encoding == RosEncoding::kCdr) type.insert(type.find('/'), "/msg");
    writer.Write(topic.name, type, message.received, in_form(topic, message), topic.definition);
  }
  writer.Close();
}

}  // namespace lio::test
