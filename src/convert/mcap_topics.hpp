// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the topics of an MCAP file, from its schemas (types with their definitions) and channels (a
// topic each, several where several programs published on it).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lio/convert/bag_reader.hpp"
#include "lio/io/lcm_codec.hpp"

namespace lio {

class McapTopics {
 public:
  // `content` is that of a schema's or a channel's record; the first one with an id counts. Returns
  // false for what is no such record.
  [[nodiscard]] bool AddSchema(ByteView content);
  [[nodiscard]] bool AddChannel(ByteView content);

  // Returns the channel's index into topics().
  [[nodiscard]] std::optional<std::size_t> IndexOf(std::uint16_t channel) const;
  // Messages that are neither ROS 1's nor CDR have a type such as "foxglove.Imu as protobuf". Only
  // the first 64 MiB of definitions are kept.
  [[nodiscard]] const std::vector<BagTopic>& topics() const { return topics_; }
  [[nodiscard]] std::size_t num_channels() const { return index_of_channel_.size(); }

  void CountMessage(std::size_t topic) { ++topics_[topic].num_messages; }

 private:
  struct Schema {
    std::string name;
    std::string encoding;
    std::string definition;
  };

  // Counts the definition if there is room for it.
  [[nodiscard]] bool IsRoomFor(std::string_view definition);

  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, std::size_t> index_of_channel_;
  std::vector<BagTopic> topics_;
  std::size_t num_definition_bytes_ = 0;
};

}  // namespace lio
