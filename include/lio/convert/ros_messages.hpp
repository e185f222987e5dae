// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Decodes the ROS messages of a recorded drive: sensor_msgs/Imu, sensor_msgs/PointCloud2,
// nav_msgs/Odometry and geometry_msgs/PoseStamped. Every length is checked; a message that is too
// short, too long or inconsistent gives nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/convert/ros_cursor.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

// Converts "sensor_msgs/msg/Imu" (ROS 2) to "sensor_msgs/Imu" (ROS 1): they are the same type.
[[nodiscard]] std::string Ros1TypeName(std::string_view type);

struct RosHeader {
  Timestamp stamp;
  std::string_view frame_id;
};
RosHeader ReadHeader(RosCursor& cursor);

// The values are the datatype numbers of sensor_msgs/PointField.
enum class FieldType : std::uint8_t {
  kInt8 = 1,
  kUint8 = 2,
  kInt16 = 3,
  kUint16 = 4,
  kInt32 = 5,
  kUint32 = 6,
  kFloat32 = 7,
  kFloat64 = 8,
};
[[nodiscard]] int NumBytes(FieldType type);

struct CloudField {
  std::string name;
  std::uint32_t offset = 0;
  FieldType type = FieldType::kFloat32;

  friend bool operator==(const CloudField&, const CloudField&) = default;
};

// A RosCloud is a view of a sensor_msgs/PointCloud2: `data` lives as long as the message's bytes.
struct RosCloud {
  Timestamp stamp;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::vector<CloudField> fields;
  bool big_endian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;  // at least width * point_step after decoding
  ByteView data;
  // A point is noise when the bits 0 and 1, or 2 and 3, of its field "tag" have this value; 0: none
  // is.
  std::uint8_t noise_tag = 0;

  [[nodiscard]] std::size_t num_points() const { return std::size_t{height} * width; }
};

[[nodiscard]] std::optional<ImuSample> DecodeRosImu(ByteView bytes, RosEncoding encoding);
// Returns nothing also when a field extends beyond the point, when `data` is too short for height
// and width, and when a datatype is unknown.
[[nodiscard]] std::optional<RosCloud> DecodeRosCloud(ByteView bytes, RosEncoding encoding);
[[nodiscard]] std::optional<StampedPose> DecodeRosOdometry(ByteView bytes, RosEncoding encoding);
[[nodiscard]] std::optional<StampedPose> DecodeRosPoseStamped(ByteView bytes, RosEncoding encoding);

}  // namespace lio
