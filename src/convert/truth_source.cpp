// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/truth_source.hpp"

#include "lio/convert/ros_messages.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/trajectory_file.hpp"

namespace lio {
namespace {

constexpr std::string_view kOdometry = "nav_msgs/Odometry";
constexpr std::string_view kPoseStamped = "geometry_msgs/PoseStamped";

bool IsInspvax(std::string_view type) {
  return type.ends_with("/INSPVAX");
}

}  // namespace

bool IsTruthType(const std::string& type) {
  return type == kOdometry || type == kPoseStamped || IsInspvax(type);
}

TruthSource::TruthSource(const BagTopic& topic, const std::filesystem::path& tum_file)
    : topic_(topic), path_(tum_file), file_(tum_file) {
  if (!file_) throw OutputError(tum_file.string() + ": cannot be written");
  if (!IsInspvax(topic.type)) return;
  const char* known = KnownInspvaxDefinition(topic.type);
  const std::string definition =
      !topic.definition.empty() ? topic.definition : std::string(known ? known : "");
  schema_ = RosSchema::Parse(definition, topic.type);
  if (!schema_) {
    throw InputError(topic.name + ": the bag holds no usable definition of " + topic.type);
  }
}

TruthSource::Decoded TruthSource::Decode(const BagMessage& message) {
  if (topic_.type == kOdometry || topic_.type == kPoseStamped) {
    const auto pose = topic_.type == kOdometry
                          ? DecodeRosOdometry(message.data, topic_.encoding)
                          : DecodeRosPoseStamped(message.data, topic_.encoding);
    return {pose.has_value(), pose};
  }
  const auto numbers = schema_->Read(message.data, topic_.encoding);
  const auto row = numbers ? ToInspvaxRow(*numbers, message.received) : std::nullopt;
  if (!row) return {};
  if (row->ins_status != kInsSolutionGood) return {true, {}};
  StampedPose pose;
  pose.stamp = row->stamp;
  pose.pose.translation =
      local_frame_.ToLocal(row->latitude_rad, row->longitude_rad, row->ellipsoid_height_m);
  pose.pose.rotation = InspvaxAttitude(row->roll_rad, row->pitch_rad, row->azimuth_rad);
  return {true, pose};
}

void TruthSource::Add(const BagMessage& message) {
  const Decoded decoded = Decode(message);
  if (!decoded.is_sound) {
    ++counts_.num_damaged;
  } else if (!decoded.pose) {
    ++counts_.num_not_good;
  } else if (counts_.last && decoded.pose->stamp <= *counts_.last) {
    ++counts_.num_not_later;
  } else {
    file_ << TumRow(*decoded.pose) << '\n';
    ++counts_.num_rows;
    if (!counts_.first) counts_.first = decoded.pose->stamp;
    counts_.last = decoded.pose->stamp;
    counts_.delay_sum_s += SecondsBetween(decoded.pose->stamp, message.received);
  }
}

void TruthSource::Close() {
  file_.close();
  if (!file_) throw WriteError("cannot write " + path_.string() + " in full: is the disk full?");
}

std::string TruthSource::description() const {
  if (IsInspvax(topic_.type)) {
    return "pose of the INS body (x right, y forward, z up) in east-north-up at the first good "
           "fix, UTC from GPS time; no lever arm applied";
  }
  return "poses as in the topic";
}

}  // namespace lio
