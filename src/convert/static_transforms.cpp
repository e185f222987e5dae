// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/static_transforms.hpp"

#include <cmath>

#include "lio/convert/bag_reader.hpp"
#include "lio/convert/ros_messages.hpp"
#include "plain_bag.hpp"

namespace lio {
namespace {

constexpr std::size_t kMinTransformBytes = 3 * 4 + 7 * sizeof(double);
constexpr std::size_t kMaxChain = 100;  // a chain of frames that is longer is a loop
constexpr double kSearchSeconds = 60.0;

// tf of ROS 1 allowed a slash before a frame's name.
std::string FrameName(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return std::string(name);
}

bool IsStaticTransform(const BagTopic& topic) {
  return topic.name.ends_with("tf_static") &&
         (topic.type == "tf2_msgs/TFMessage" || topic.type == "tf/tfMessage");
}

std::optional<FrameLink> ReadLink(RosCursor& cursor) {
  FrameLink link;
  link.parent = FrameName(ReadHeader(cursor).frame_id);
  link.child = FrameName(cursor.ReadString());
  double values[7] = {};
  for (double& value : values) value = cursor.Read<double>();
  link.T_parent_child.translation = Vector3(values[0], values[1], values[2]);
  const Quaternion rotation(values[6], values[3], values[4], values[5]);
  constexpr double kMaxNormError = 0.01;
  const bool is_rotation = std::abs(rotation.norm() - 1.0) < kMaxNormError;
  if (!is_rotation || !link.T_parent_child.translation.allFinite()) return {};
  link.T_parent_child.rotation = rotation.normalized();
  return link;
}

}  // namespace

std::optional<std::vector<FrameLink>> DecodeRosTransforms(ByteView bytes, RosEncoding encoding) {
  RosCursor cursor(bytes, encoding);
  std::vector<FrameLink> links;
  const std::uint32_t count = cursor.ReadCount(kMinTransformBytes);
  for (std::uint32_t i = 0; i < count && cursor.ok(); ++i) {
    if (auto link = ReadLink(cursor)) links.push_back(std::move(*link));
  }
  if (!cursor.AtEnd()) return {};
  return links;
}

void FrameTree::Add(const FrameLink& link) {
  links_[link.child] = link;
}

std::vector<FrameTree::Ancestor> FrameTree::AncestorsOf(const std::string& frame) const {
  std::vector<Ancestor> ancestors = {{frame, Pose::Identity()}};
  while (ancestors.size() < kMaxChain) {
    const auto up = links_.find(ancestors.back().frame);
    if (up == links_.end()) break;
    ancestors.push_back(
        {up->second.parent, up->second.T_parent_child * ancestors.back().T_ancestor_frame});
  }
  return ancestors;
}

std::optional<Pose> FrameTree::Find(const std::string& target, const std::string& source) const {
  for (const Ancestor& of_target : AncestorsOf(FrameName(target))) {
    for (const Ancestor& of_source : AncestorsOf(FrameName(source))) {
      if (of_target.frame != of_source.frame) continue;
      return of_target.T_ancestor_frame.Inverse() * of_source.T_ancestor_frame;
    }
  }
  return std::nullopt;
}

MountedSensors FindMounting(const std::filesystem::path& bag_path, const std::string& lidar_topic,
                            const std::string& imu_topic) {
  const PlainBag plain(bag_path);
  const auto bag = OpenBag(plain.path());
  bag->Select([&](const BagTopic& topic) {
    return topic.name == lidar_topic || topic.name == imu_topic || IsStaticTransform(topic);
  });
  MountedSensors mounted;
  FrameTree tree;
  BagMessage message;
  while (!mounted.T_imu_lidar && bag->Next(message)) {
    if (SecondsBetween(*bag->begin_time(), message.received) > kSearchSeconds) break;
    const BagTopic& topic = bag->topics()[message.topic];
    if (IsStaticTransform(topic)) {
      const auto links = DecodeRosTransforms(message.data, topic.encoding);
      for (const FrameLink& link : links.value_or(std::vector<FrameLink>{})) tree.Add(link);
      mounted.has_static_transforms = !tree.empty();
    } else {
      RosCursor cursor(message.data, topic.encoding);
      const std::string frame(ReadHeader(cursor).frame_id);
      (topic.name == lidar_topic ? mounted.lidar_frame : mounted.imu_frame) = frame;
    }
    const bool knows_frames = !mounted.lidar_frame.empty() && !mounted.imu_frame.empty();
    if (knows_frames) mounted.T_imu_lidar = tree.Find(mounted.imu_frame, mounted.lidar_frame);
  }
  return mounted;
}

}  // namespace lio
