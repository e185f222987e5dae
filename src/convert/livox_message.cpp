// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "livox_message.hpp"

namespace lio {
namespace {

constexpr std::uint32_t kPointBytes = 19;
constexpr std::uint32_t kCdrPointBytes = 20;  // the next point is aligned to 4; the last is not

// In tags of the first driver's lidars, this value of a pair of bits marks noise.
constexpr std::uint8_t kSurelyNoise = 1;

const std::vector<CloudField>& PointFields() {
  static const std::vector<CloudField> fields = {
      {"offset_time", 0, FieldType::kUint32},  {"x", 4, FieldType::kFloat32},
      {"y", 8, FieldType::kFloat32},           {"z", 12, FieldType::kFloat32},
      {"reflectivity", 16, FieldType::kUint8}, {"tag", 17, FieldType::kUint8},
      {"line", 18, FieldType::kUint8}};
  return fields;
}

}  // namespace

bool IsLivoxType(std::string_view type) {
  return type == "livox_ros_driver/CustomMsg" || type == "livox_ros_driver2/CustomMsg";
}

bool IsScanType(std::string_view type) {
  return type == "sensor_msgs/PointCloud2" || IsLivoxType(type);
}

std::optional<RosCloud> DecodeLivox(ByteView bytes, RosEncoding encoding) {
  RosCursor cursor(bytes, encoding);
  RosCloud cloud;
  cloud.stamp = ReadHeader(cursor).stamp;
  cursor.Read<std::uint64_t>();  // timebase: the stamp, on the lidar's own clock
  cursor.Read<std::uint32_t>();  // point_num, which the length of the list tells, too
  cursor.SkipValues(4, 1);       // lidar_id and three reserved bytes
  cloud.height = 1;
  cloud.width = cursor.ReadCount(kPointBytes);
  cloud.point_step = encoding == RosEncoding::kCdr ? kCdrPointBytes : kPointBytes;
  cloud.row_step = cloud.width * cloud.point_step;
  const std::size_t padding = cloud.point_step - kPointBytes;
  const std::size_t size = std::size_t{cloud.width} * cloud.point_step;
  cloud.data = cursor.ReadBytes(size > 0 ? size - padding : 0);
  cloud.big_endian = cursor.big_endian();
  cloud.fields = PointFields();
  if (!cursor.AtEnd()) return {};
  return cloud;
}

std::optional<RosCloud> DecodeScan(const BagTopic& topic, ByteView bytes) {
  if (!IsLivoxType(topic.type)) return DecodeRosCloud(bytes, topic.encoding);
  std::optional<RosCloud> cloud = DecodeLivox(bytes, topic.encoding);
  if (cloud && topic.type == "livox_ros_driver/CustomMsg") cloud->noise_tag = kSurelyNoise;
  return cloud;
}

}  // namespace lio
