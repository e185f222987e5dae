// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <memory>

#include "convert/livox_message.hpp"
#include "fuzz/scratch_file.hpp"
#include "fuzz/target_helpers.hpp"
#include "fuzz/targets.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/convert/inspvax.hpp"
#include "lio/convert/kitti_files.hpp"
#include "lio/convert/oxts.hpp"
#include "lio/convert/pointcloud2_layout.hpp"
#include "lio/convert/ros_messages.hpp"
#include "lio/convert/ros_schema.hpp"
#include "lio/convert/static_transforms.hpp"

namespace lio::fuzz {
namespace {

void ReadCloud(const std::optional<RosCloud>& cloud) {
  if (!cloud) return;
  const std::optional<PointLayout> layout = FindLayout(cloud->fields);
  (void)DescribeFields(cloud->fields);
  CloudPoints points;
  if (layout) ReadPoints(*cloud, *layout, points);
}

void ReadTransforms(ByteView bytes, RosEncoding encoding) {
  const auto links = DecodeRosTransforms(bytes, encoding);
  if (!links || links->empty()) return;
  FrameTree tree;
  for (const FrameLink& link : *links) tree.Add(link);
  (void)tree.Find(links->front().parent, links->back().child);
}

void ReadPosition(const RosNumbers& numbers) {
  const auto row = ToInspvaxRow(numbers, Timestamp{1'700'000'000'000'000'000});
  if (!row) return;
  (void)InspvaxAttitude(row->roll_rad, row->pitch_rad, row->azimuth_rad);
  LocalFrame frame;
  (void)frame.ToLocal(row->latitude_rad, row->longitude_rad, row->ellipsoid_height_m);
}

void ReadMessage(ByteView bytes, RosEncoding encoding) {
  (void)DecodeRosImu(bytes, encoding);
  (void)DecodeRosOdometry(bytes, encoding);
  (void)DecodeRosPoseStamped(bytes, encoding);
  ReadCloud(DecodeRosCloud(bytes, encoding));
  ReadCloud(DecodeLivox(bytes, encoding));
  ReadTransforms(bytes, encoding);
}

void ReadBySchema(const std::optional<RosSchema>& schema, ByteView bytes, RosEncoding encoding) {
  if (!schema) return;
  if (const auto numbers = schema->Read(bytes, encoding)) ReadPosition(*numbers);
}

void ReadBag(const char* name, ByteView bytes) {
  MayRefuse([&] {
    const std::unique_ptr<BagReader> bag = OpenBag(ScratchFile(name, bytes));
    BagMessage message;
    while (bag->Next(message)) {
      const BagTopic& topic = bag->topics().at(message.topic);
      ReadMessage(message.data, topic.encoding);
      ReadBySchema(RosSchema::Parse(topic.definition, topic.type), message.data, topic.encoding);
    }
  });
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
  ByteView message = bytes;
  const auto schema = RosSchema::Parse(TextOf(CutPart(message)), "pkg/Type");
  for (const RosEncoding encoding : {RosEncoding::kRos1, RosEncoding::kCdr}) {
    ReadMessage(bytes, encoding);
    ReadBySchema(schema, message, encoding);
  }
}

void Kitti(ByteView bytes) {
  MayRefuse([&] {
    (void)ReadKittiScan(ScratchFile("0000000000.bin", bytes));
    (void)ReadKittiScan(ScratchFile("0000000000.txt", bytes));
    (void)ParseOxts(std::string(TextOf(bytes)));
    (void)ParseKittiStamp(TextOf(bytes));
    for (const auto& [key, row] : ReadKittiCalibration(ScratchFile("calib.txt", bytes))) {
      if (row.size() >= 12)
        (void)ToPose({row.begin(), row.begin() + 9}, {row.end() - 3, row.end()}, key);
    }
    (void)ReadKittiStamps(ScratchFile("timestamps.txt", bytes));
  });
}

}  // namespace lio::fuzz
