// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/lcm_codec.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "lcm_wire.hpp"
#include "lio/filter_state_t.hpp"
#include "lio/imu_t.hpp"
#include "lio/odometry_t.hpp"
#include "lio/registration_t.hpp"
#include "lio/scan_t.hpp"

namespace lio {
namespace {

static_assert(std::endian::native == std::endian::little,
              "points are little-endian on the wire and copied as they are");

// These are sizes of the encoded messages, including the eight bytes of the fingerprint.
constexpr std::size_t kImuBytes = 8 + 8 + 8 + 4 + 4 + 7 * 8;
constexpr std::size_t kScanFixedBytes = 8 + 8 + 8 + 4 + 2 + 2 + 1 + 1 + 2 + 4 + 4;

bool ReadStamp(FieldReader& reader, Timestamp& stamp) {
  const auto utime = reader.Read<std::int64_t>();
  if (utime < 0 || utime > kMaxUtime) return false;
  stamp = Timestamp::FromMicroseconds(utime);
  return true;
}

void Copy(const Vector3& from, double (&to)[3]) {
  std::copy_n(from.data(), 3, to);
}

void Copy(const Quaternion& from, double (&to)[4]) {
  to[0] = from.w();
  to[1] = from.x();
  to[2] = from.y();
  to[3] = from.z();
}

template <int n>
void Copy(const Eigen::Matrix<double, n, n>& from, double (&to)[n][n]) {
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) to[row][column] = from(row, column);
  }
}

// Writes the fields that every scan_t has; `num_points` points follow.
scan_t ScanMessage(Timestamp stamp, std::size_t num_points) {
  if (num_points > kMaxMessageBytes / sizeof(LidarPoint)) {
    throw std::invalid_argument("a scan message of " + std::to_string(num_points) +
                                " points is above the size limit");
  }
  scan_t message{};
  message.utime = stamp.Microseconds();
  message.chunk_count = 1;
  message.point_format = scan_t::FORMAT_XYZ_F32_T_U32_I_U16_R_U16;
  message.point_step = sizeof(LidarPoint);
  message.n_points = static_cast<std::int32_t>(num_points);
  message.n_bytes = static_cast<std::int32_t>(num_points * sizeof(LidarPoint));
  message.points.resize(num_points * sizeof(LidarPoint));
  return message;
}

void StorePoint(const LidarPoint& point, std::size_t index, scan_t& message) {
  std::memcpy(message.points.data() + index * sizeof(LidarPoint), &point, sizeof(LidarPoint));
}

// Fills the fields that do not depend on the frame.
odometry_t OdometryMessage(const NavOutput& nav) {
  odometry_t message{};
  message.utime = nav.stamp.Microseconds();
  message.scan_seq = nav.scan_seq;
  message.status = static_cast<std::int8_t>(nav.status);
  message.source = static_cast<std::int8_t>(nav.source);
  return message;
}

float Microseconds(const StageTimes& stage_ns, Stage stage) {
  return static_cast<float>(stage_ns[static_cast<std::size_t>(stage)]) / 1000.0F;
}

}  // namespace

std::string_view Name(DecodeStatus status) {
  switch (status) {
    case DecodeStatus::kOk:
      return "ok";
    case DecodeStatus::kTruncated:
      return "truncated";
    case DecodeStatus::kWrongType:
      return "wrong_type";
    case DecodeStatus::kSizeMismatch:
      return "size_mismatch";
    case DecodeStatus::kBadFormat:
      return "bad_format";
    case DecodeStatus::kTooLarge:
      return "too_large";
  }
  return "unknown";
}

DecodeStatus DecodeImu(ByteView bytes, ImuSample& sample, std::int32_t& seq) {
  const DecodeStatus head = CheckHead(bytes, kImuFingerprint, kImuBytes);
  if (head != DecodeStatus::kOk) return head;
  if (bytes.size() != kImuBytes) return DecodeStatus::kSizeMismatch;
  FieldReader reader(bytes.data() + sizeof(kImuFingerprint));
  if (!ReadStamp(reader, sample.stamp)) return DecodeStatus::kBadFormat;
  reader.Read<std::int64_t>();  // device_ns
  seq = reader.Read<std::int32_t>();
  reader.Read<std::int32_t>();  // flags
  sample.w_imu_radps = reader.ReadVector();
  sample.f_imu_mps2 = reader.ReadVector();
  return DecodeStatus::kOk;
}

DecodeStatus DecodeChunk(ByteView bytes, ScanChunk& chunk) {
  const DecodeStatus head = CheckHead(bytes, kScanFingerprint, kScanFixedBytes);
  if (head != DecodeStatus::kOk) return head;
  FieldReader reader(bytes.data() + sizeof(kScanFingerprint));
  const bool has_sane_stamp = ReadStamp(reader, chunk.stamp);
  reader.Read<std::int64_t>();  // device_ns
  chunk.scan_seq = reader.Read<std::int32_t>();
  chunk.chunk_index = reader.Read<std::int16_t>();
  chunk.chunk_count = reader.Read<std::int16_t>();
  chunk.sensor_id = reader.Read<std::int8_t>();
  const auto format = reader.Read<std::int8_t>();
  const auto step = reader.Read<std::int16_t>();
  const std::int64_t num_points = reader.Read<std::int32_t>();
  const std::int64_t num_bytes = reader.Read<std::int32_t>();
  if (!has_sane_stamp || format != scan_t::FORMAT_XYZ_F32_T_U32_I_U16_R_U16 ||
      step != static_cast<std::int16_t>(sizeof(LidarPoint))) {
    return DecodeStatus::kBadFormat;
  }
  const auto body_bytes = static_cast<std::int64_t>(bytes.size() - kScanFixedBytes);
  if (num_points < 0 || num_bytes != num_points * step || num_bytes != body_bytes) {
    return DecodeStatus::kSizeMismatch;
  }
  chunk.points.resize(static_cast<std::size_t>(num_points));
  if (num_points > 0) {
    std::memcpy(chunk.points.data(), bytes.data() + kScanFixedBytes,
                bytes.size() - kScanFixedBytes);
  }
  return DecodeStatus::kOk;
}

Bytes EncodeImu(const ImuSample& sample, std::int32_t seq) {
  imu_t message{};
  message.utime = sample.stamp.Microseconds();
  message.seq = seq;
  Copy(sample.w_imu_radps, message.gyro);
  Copy(sample.f_imu_mps2, message.accel);
  message.temperature_c = std::numeric_limits<double>::quiet_NaN();
  return EncodeMessage(message);
}

Bytes EncodeChunk(const ScanChunk& chunk) {
  scan_t message = ScanMessage(chunk.stamp, chunk.points.size());
  message.scan_seq = chunk.scan_seq;
  message.chunk_index = chunk.chunk_index;
  message.chunk_count = chunk.chunk_count;
  message.sensor_id = chunk.sensor_id;
  const auto shift_ns =
      static_cast<std::uint64_t>(chunk.stamp.ns - Timestamp::FromMicroseconds(message.utime).ns);
  for (std::size_t i = 0; i < chunk.points.size(); ++i) {
    LidarPoint point = chunk.points[i];
    point.t_offset_ns = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        point.t_offset_ns + shift_ns, std::numeric_limits<std::uint32_t>::max()));
    StorePoint(point, i, message);
  }
  return EncodeMessage(message);
}

Bytes EncodeCloud(const RegisteredCloud& cloud) {
  scan_t message = ScanMessage(cloud.stamp, cloud.points_map.size());
  message.scan_seq = static_cast<std::int32_t>(cloud.scan_seq);
  message.sensor_id = scan_t::SENSOR_REGISTERED;
  for (std::size_t i = 0; i < cloud.points_map.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points_map[i];
    StorePoint({.x_m = p.x(), .y_m = p.y(), .z_m = p.z()}, i, message);
  }
  return EncodeMessage(message);
}

Bytes EncodeOdometry(const NavOutput& nav) {
  odometry_t message = OdometryMessage(nav);
  Copy(nav.T_world_imu.translation, message.pos);
  Copy(nav.T_world_imu.rotation, message.quat);
  Copy(nav.v_world_imu_mps, message.vel);
  Copy(nav.w_imu_radps, message.rotation_rate);
  Copy(nav.pose_cov, message.pose_cov);
  Copy(nav.velocity_cov, message.vel_cov);
  Copy(nav.T_map_imu.translation, message.map_pos);
  Copy(nav.T_map_imu.rotation, message.map_quat);
  Copy(nav.map_pose_cov, message.map_pose_cov);
  return EncodeMessage(message);
}

// Converts the covariances of the pose in map to the convention of those in world.
Bytes EncodeLocalOdometry(const FilterReport& report) {
  NavOutput local = report.nav;
  Matrix6 to_map = Matrix6::Identity();
  to_map.topLeftCorner<3, 3>() = local.T_map_imu.rotation.toRotationMatrix();
  local.T_world_imu = local.T_map_imu;
  local.pose_cov = to_map * local.map_pose_cov * to_map.transpose();
  local.v_world_imu_mps = report.v_map_imu_mps;
  local.velocity_cov = report.map_velocity_cov;
  return EncodeOdometry(local);
}

Bytes EncodeBaseOdometry(const NavOutput& nav) {
  const BaseMotion& base = nav.base.value();
  odometry_t message = OdometryMessage(nav);
  Copy(base.T_world_base.translation, message.pos);
  Copy(base.T_world_base.rotation, message.quat);
  Copy(base.v_world_base_mps, message.vel);
  Copy(base.w_base_radps, message.rotation_rate);
  Copy(base.pose_cov, message.pose_cov);
  Copy(base.velocity_cov, message.vel_cov);
  Copy(base.T_map_base.translation, message.map_pos);
  Copy(base.T_map_base.rotation, message.map_quat);
  Copy(base.map_pose_cov, message.map_pose_cov);
  return EncodeMessage(message);
}

Bytes EncodeFilterState(const FilterReport& report) {
  filter_state_t message{};
  message.utime = report.nav.stamp.Microseconds();
  message.scan_seq = report.nav.scan_seq;
  Copy(report.nav.T_world_imu.translation, message.pos);
  Copy(report.nav.v_world_imu_mps, message.vel);
  Copy(report.nav.T_world_imu.rotation, message.quat);
  Copy(report.gyro_bias_radps, message.gyro_bias);
  Copy(report.accel_bias_mps2, message.accel_bias);
  Copy(report.g_world_mps2, message.gravity);
  message.clock_offset_s = report.clock_offset_s;
  message.clock_offset_std_s = report.clock_offset_std_s;
  message.nis = report.nis;
  message.nis_dof = report.nis_dof;
  message.dim = static_cast<std::int32_t>(report.cov.rows());
  message.n_cov = static_cast<std::int32_t>(report.cov.size());
  for (Eigen::Index row = 0; row < report.cov.rows(); ++row) {
    for (Eigen::Index column = 0; column < report.cov.cols(); ++column) {
      message.cov.push_back(report.cov(row, column));
    }
  }
  return EncodeMessage(message);
}

Bytes EncodeRegistration(const ScanReport& report) {
  registration_t message{};
  message.utime = report.stamp.Microseconds();
  message.scan_seq = static_cast<std::int32_t>(report.scan_seq);
  message.n_raw = report.num_raw;
  message.n_used = report.num_used;
  message.n_matched = report.num_matched;
  message.iterations = report.iterations;
  message.status = static_cast<std::int8_t>(report.status);
  message.fused = report.fused ? 1 : 0;
  message.rmse_m = report.residual_rms_m;
  std::copy_n(report.information_eigenvalues.data(), 6, message.eigenvalues);
  message.degenerate_mask = static_cast<std::int32_t>(report.degenerate_mask);
  message.nis = report.nis;
  message.decode_us = Microseconds(report.stage_ns, Stage::kDecode);
  message.reduce_us = Microseconds(report.stage_ns, Stage::kReduce);
  message.deskew_us = Microseconds(report.stage_ns, Stage::kDeskew);
  message.match_us = Microseconds(report.stage_ns, Stage::kMatch);
  message.insert_us = Microseconds(report.stage_ns, Stage::kInsert);
  message.filter_us = Microseconds(report.stage_ns, Stage::kFilter);
  message.total_us = Microseconds(report.stage_ns, Stage::kTotal);
  return EncodeMessage(message);
}

}  // namespace lio
