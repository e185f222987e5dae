// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/input_error.hpp"
#include "livox_message.hpp"

namespace lio {
namespace {

constexpr const char* kScanTypes = "sensor_msgs/PointCloud2 or Livox CustomMsg";

using TypeTest = bool (*)(const std::string&);

bool IsCloud(const std::string& type) {
  return IsScanType(type);
}
bool IsImu(const std::string& type) {
  return type == "sensor_msgs/Imu";
}

std::string List(const std::vector<const BagTopic*>& topics) {
  std::string text;
  for (const BagTopic* topic : topics) {
    text += (text.empty() ? "" : ", ") + topic->name + " (" + topic->type + ")";
  }
  return text.empty() ? "none" : text;
}

std::string ListAll(const std::vector<BagTopic>& topics) {
  std::vector<const BagTopic*> all;
  all.reserve(topics.size());
  for (const BagTopic& topic : topics) all.push_back(&topic);
  return List(all);
}

const BagTopic& Named(const std::vector<BagTopic>& topics, const std::string& name,
                      const std::string& option, TypeTest is_type, const std::string& need) {
  std::vector<const BagTopic*> same;
  for (const BagTopic& topic : topics) {
    if (topic.name == name) same.push_back(&topic);
  }
  if (same.empty()) {
    throw UsageError(option + " " + name + ": no such topic; the bag has " + ListAll(topics));
  }
  for (const BagTopic* topic : same) {
    if (is_type(topic->type)) return *topic;
  }
  throw UsageError(option + " " + name + " has type " + same.front()->type + ", needed is " + need);
}

// Returns the one topic of the type, or null for none.
const BagTopic* ByType(const std::vector<BagTopic>& topics, const std::string& option,
                       TypeTest is_type, const std::string& what) {
  std::vector<const BagTopic*> found;
  for (const BagTopic& topic : topics) {
    if (is_type(topic.type)) found.push_back(&topic);
  }
  if (found.size() > 1) {
    throw UsageError("several " + what + " topics: choose one with " + option + ": " + List(found));
  }
  return found.empty() ? nullptr : found.front();
}

}  // namespace

TopicChoice ChooseTopics(const std::vector<BagTopic>& topics, const RosbagOptions& options) {
  TopicChoice choice;
  if (options.lidar_topic) {
    choice.lidar = Named(topics, *options.lidar_topic, "--lidar-topic", IsCloud, kScanTypes).name;
  } else if (const BagTopic* cloud =
                 ByType(topics, "--lidar-topic", IsCloud, "PointCloud2 or CustomMsg")) {
    choice.lidar = cloud->name;
  } else {
    throw InputError("no " + std::string(kScanTypes) + " in the bag: it has " + ListAll(topics));
  }
  if (options.imu_topic) {
    choice.imu = Named(topics, *options.imu_topic, "--imu-topic", IsImu, "sensor_msgs/Imu").name;
  } else if (const BagTopic* imu = ByType(topics, "--imu-topic", IsImu, "Imu")) {
    choice.imu = imu->name;
  }
  if (options.truth_topic) {
    choice.truth = Named(topics, *options.truth_topic, "--truth-topic", IsTruthType,
                         "nav_msgs/Odometry, geometry_msgs/PoseStamped or INSPVAX")
                       .name;
  } else if (options.truth_file) {
    const BagTopic* truth = ByType(topics, "--truth-topic", IsTruthType, "truth");
    if (truth == nullptr) {
      throw InputError("no Odometry, PoseStamped or INSPVAX in the bag for --truth: it has " +
                       ListAll(topics));
    }
    choice.truth = truth->name;
  }
  return choice;
}

}  // namespace lio
