// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "mcap_topics.hpp"

#include <algorithm>

#include "bag_limits.hpp"
#include "lio/convert/ros_cursor.hpp"
#include "lio/convert/ros_messages.hpp"
#include "lio/io/printable.hpp"

namespace lio {
namespace {

constexpr std::size_t kMaxDefinitionsBytes = 1u << 26;  // for all types and topics together

// Schemas of ROS 2 may be written as .msg or as .idl; the type is the same.
bool IsRos2Schema(std::string_view encoding) {
  return encoding == "ros2msg" || encoding == "ros2idl";
}

}  // namespace

bool McapTopics::AddSchema(ByteView content) {
  RosCursor fields(content, RosEncoding::kRos1);
  const auto id = fields.Read<std::uint16_t>();
  const std::string_view name = fields.ReadString();
  const std::string_view encoding = fields.ReadString();
  const std::string_view definition = fields.ReadString();
  if (!fields.ok()) return false;
  const auto [schema, is_new] = schemas_.try_emplace(id);
  if (!is_new) return true;
  schema->second.name = Excerpt(name, kMaxNameBytes);
  schema->second.encoding = Excerpt(encoding, kMaxNameBytes);
  const bool is_read = encoding == "ros1msg" || encoding == "ros2msg";
  if (is_read && IsRoomFor(definition)) schema->second.definition = definition;
  return true;
}

bool McapTopics::IsRoomFor(std::string_view definition) {
  if (definition.size() > kMaxDefinitionsBytes - num_definition_bytes_) return false;
  num_definition_bytes_ += definition.size();
  return true;
}

bool McapTopics::AddChannel(ByteView content) {
  RosCursor fields(content, RosEncoding::kRos1);
  const auto id = fields.Read<std::uint16_t>();
  const auto schema_id = fields.Read<std::uint16_t>();
  const std::string_view name = fields.ReadString();
  const std::string_view encoding = fields.ReadString();
  if (!fields.ok()) return false;
  if (index_of_channel_.contains(id)) return true;
  const auto found = schemas_.find(schema_id);
  const Schema unknown{"unknown type", "", ""};
  const Schema& schema = found == schemas_.end() ? unknown : found->second;
  BagTopic topic;
  topic.name = Excerpt(name, kMaxNameBytes);
  topic.type = Ros1TypeName(schema.name);
  topic.encoding = encoding == "cdr" ? RosEncoding::kCdr : RosEncoding::kRos1;
  const bool is_ros = (encoding == "ros1" && schema.encoding == "ros1msg") ||
                      (encoding == "cdr" && IsRos2Schema(schema.encoding));
  if (!is_ros) topic.type = schema.name + " as " + Excerpt(encoding, kMaxNameBytes);
  const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& other) {
    return other.name == topic.name && other.type == topic.type;
  });
  index_of_channel_[id] = static_cast<std::size_t>(same - topics_.begin());
  if (same != topics_.end()) return true;
  if (IsRoomFor(schema.definition)) topic.definition = schema.definition;
  topics_.push_back(std::move(topic));
  return true;
}

std::optional<std::size_t> McapTopics::IndexOf(std::uint16_t channel) const {
  const auto found = index_of_channel_.find(channel);
  if (found == index_of_channel_.end()) return {};
  return found->second;
}

}  // namespace lio
