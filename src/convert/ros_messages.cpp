// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/ros_messages.hpp"

#include <cmath>

namespace lio {
namespace {

constexpr std::size_t kMinFieldBytes = 13;  // name length, offset, datatype, count

Vector3 ReadVector(RosCursor& cursor) {
  const auto x = cursor.Read<double>();
  const auto y = cursor.Read<double>();
  const auto z = cursor.Read<double>();
  return {x, y, z};
}

// Reads a geometry_msgs/Pose; returns nothing when it is not finite or its quaternion is not a
// rotation.
std::optional<Pose> ReadPose(RosCursor& cursor) {
  Pose pose;
  pose.translation = ReadVector(cursor);
  const Vector3 xyz = ReadVector(cursor);
  const auto w = cursor.Read<double>();
  const Quaternion q(w, xyz.x(), xyz.y(), xyz.z());
  constexpr double kMaxNormError = 0.01;
  if (!pose.translation.allFinite() || !(std::abs(q.norm() - 1.0) < kMaxNormError)) return {};
  pose.rotation = q.normalized();
  return pose;
}

bool ReadFields(RosCursor& cursor, std::vector<CloudField>& fields) {
  fields.resize(cursor.ReadCount(kMinFieldBytes));
  for (CloudField& field : fields) {
    field.name = cursor.ReadString();
    field.offset = cursor.Read<std::uint32_t>();
    const auto type = cursor.Read<std::uint8_t>();
    cursor.Read<std::uint32_t>();  // count; further elements are not needed
    if (!cursor.ok() || type < 1 || type > 8) return false;
    field.type = static_cast<FieldType>(type);
  }
  return cursor.ok();
}

// Checks that lengths agree. Some drivers leave row_step 0: then rows are packed.
bool IsConsistent(RosCloud& cloud) {
  const std::uint64_t packed_row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.row_step == 0 && packed_row <= UINT32_MAX) {
    cloud.row_step = static_cast<std::uint32_t>(packed_row);
  }
  if (cloud.num_points() == 0) {
    cloud.width = cloud.height = 0;  // nobody need walk through four billion empty rows
    return true;
  }
  if (cloud.point_step == 0 || cloud.row_step < packed_row) return false;
  const std::uint64_t needed = std::uint64_t{cloud.row_step} * (cloud.height - 1) + packed_row;
  const std::uint64_t whole = std::uint64_t{cloud.row_step} * cloud.height;
  if (cloud.data.size() != needed && cloud.data.size() != whole) return false;
  for (const CloudField& field : cloud.fields) {
    const auto end = std::uint64_t{field.offset} + static_cast<unsigned>(NumBytes(field.type));
    if (end > cloud.point_step) return false;
  }
  return true;
}

}  // namespace

std::string Ros1TypeName(std::string_view type) {
  const std::size_t middle = type.find("/msg/");
  if (middle == std::string_view::npos) return std::string(type);
  return std::string(type.substr(0, middle)) + std::string(type.substr(middle + 4));
}

RosHeader ReadHeader(RosCursor& cursor) {
  if (cursor.encoding() == RosEncoding::kRos1) cursor.Read<std::uint32_t>();  // seq
  RosHeader header;
  header.stamp = cursor.ReadTime();
  header.frame_id = cursor.ReadString();
  return header;
}

int NumBytes(FieldType type) {
  switch (type) {
    case FieldType::kInt8:
    case FieldType::kUint8:
      return 1;
    case FieldType::kInt16:
    case FieldType::kUint16:
      return 2;
    case FieldType::kInt32:
    case FieldType::kUint32:
    case FieldType::kFloat32:
      return 4;
    case FieldType::kFloat64:
      return 8;
  }
  return 8;
}

std::optional<ImuSample> DecodeRosImu(ByteView bytes, RosEncoding encoding) {
  RosCursor cursor(bytes, encoding);
  ImuSample sample;
  sample.stamp = ReadHeader(cursor).stamp;
  constexpr std::size_t kOrientation = 4 + 9;  // quaternion and its covariance
  cursor.SkipValues(kOrientation, sizeof(double));
  sample.w_imu_radps = ReadVector(cursor);
  cursor.SkipValues(9, sizeof(double));
  sample.f_imu_mps2 = ReadVector(cursor);
  cursor.SkipValues(9, sizeof(double));
  if (!cursor.AtEnd()) return {};
  return sample;
}

std::optional<RosCloud> DecodeRosCloud(ByteView bytes, RosEncoding encoding) {
  RosCursor cursor(bytes, encoding);
  RosCloud cloud;
  cloud.stamp = ReadHeader(cursor).stamp;
  cloud.height = cursor.Read<std::uint32_t>();
  cloud.width = cursor.Read<std::uint32_t>();
  if (!ReadFields(cursor, cloud.fields)) return {};
  cloud.big_endian = cursor.Read<bool>();
  cloud.point_step = cursor.Read<std::uint32_t>();
  cloud.row_step = cursor.Read<std::uint32_t>();
  cloud.data = cursor.ReadBytes(cursor.ReadCount(1));
  cursor.Read<std::uint8_t>();  // is_dense; not used because drivers set it wrongly
  if (!cursor.AtEnd() || !IsConsistent(cloud)) return {};
  return cloud;
}

std::optional<StampedPose> DecodeRosOdometry(ByteView bytes, RosEncoding encoding) {
  RosCursor cursor(bytes, encoding);
  const Timestamp stamp = ReadHeader(cursor).stamp;
  cursor.ReadString();  // child_frame_id
  const auto pose = ReadPose(cursor);
  constexpr std::size_t kRest = 36 + 6 + 36;  // pose covariance, twist and its covariance
  cursor.SkipValues(kRest, sizeof(double));
  if (!cursor.AtEnd() || !pose) return {};
  return StampedPose{stamp, *pose};
}

std::optional<StampedPose> DecodeRosPoseStamped(ByteView bytes, RosEncoding encoding) {
  RosCursor cursor(bytes, encoding);
  const Timestamp stamp = ReadHeader(cursor).stamp;
  const auto pose = ReadPose(cursor);
  if (!cursor.AtEnd() || !pose) return {};
  return StampedPose{stamp, *pose};
}

}  // namespace lio
