// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <stdexcept>

#include "fuzz/scratch_file.hpp"
#include "fuzz/targets.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/convert/kitti_files.hpp"
#include "lio/convert/oxts.hpp"
#include "lio/convert/pointcloud2_layout.hpp"
#include "lio/convert/ros_messages.hpp"
#include "lio/convert/ros_schema.hpp"

namespace lio::fuzz {
namespace {

void ReadCloud(ByteView bytes, RosEncoding encoding) {
  const std::optional<RosCloud> cloud = DecodeRosCloud(bytes, encoding);
  if (!cloud) return;
  const std::optional<PointLayout> layout = FindLayout(cloud->fields);
  (void)DescribeFields(cloud->fields);
  CloudPoints points;
  if (layout) ReadPoints(*cloud, *layout, points);
}

void ReadMessage(ByteView bytes, RosEncoding encoding) {
  (void)DecodeRosImu(bytes, encoding);
  (void)DecodeRosOdometry(bytes, encoding);
  (void)DecodeRosPoseStamped(bytes, encoding);
  ReadCloud(bytes, encoding);
}

void ReadBag(const char* name, ByteView bytes) {
  try {
    const std::unique_ptr<BagReader> bag = OpenBag(ScratchFile(name, bytes));
    BagMessage message;
    while (bag->Next(message)) {
      const BagTopic& topic = bag->topics().at(message.topic);
      ReadMessage(message.data, topic.encoding);
      if (const auto schema = RosSchema::Parse(topic.definition, topic.type)) {
        (void)schema->Read(message.data, topic.encoding);
      }
    }
  } catch (const std::runtime_error&) {  // the file is refused
  }
}

std::string_view TextOf(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void Rosbag1(ByteView bytes) {
  ReadBag("bag.bag", bytes);
}

void Rosbag2(ByteView bytes) {
  ReadBag("bag.db3", bytes);
}

void Mcap(ByteView bytes) {
  ReadBag("bag.mcap", bytes);
}

// A definition ends at the first zero byte, and a message of that type comes after it.
void RosMessages(ByteView bytes) {
  const auto end = std::find(bytes.begin(), bytes.end(), 0);
  const auto length = static_cast<std::size_t>(end - bytes.begin());
  const ByteView message = bytes.subspan(std::min(length + 1, bytes.size()));
  const auto schema = RosSchema::Parse(TextOf(bytes.first(length)), "pkg/Type");
  for (const RosEncoding encoding : {RosEncoding::kRos1, RosEncoding::kCdr}) {
    ReadMessage(bytes, encoding);
    if (schema) (void)schema->Read(message, encoding);
  }
}

void Kitti(ByteView bytes) {
  try {
    (void)ReadKittiScan(ScratchFile("0000000000.bin", bytes));
    (void)ReadKittiScan(ScratchFile("0000000000.txt", bytes));
    (void)ParseOxts(std::string(TextOf(bytes)));
    (void)ParseKittiStamp(TextOf(bytes));
    for (const auto& [key, row] : ReadKittiCalibration(ScratchFile("calib.txt", bytes))) {
      if (row.size() >= 12)
        (void)ToPose({row.begin(), row.begin() + 9}, {row.end() - 3, row.end()}, key);
    }
    (void)ReadKittiStamps(ScratchFile("timestamps.txt", bytes));
  } catch (const std::runtime_error&) {  // the file is refused
  }
}

}  // namespace lio::fuzz
