// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A log of liod's messages for the tests of exports: 5 s at 10 Hz along x of map, which is turned
// against world by a right angle.
#pragma once

#include <cmath>
#include <filesystem>

#include "lio/io/event_log.hpp"
#include "lio/io/status_report.hpp"
#include "support/temp_dir.hpp"

namespace lio::test {

inline constexpr std::int64_t kRecordingStart_us = 1'700'000'000'000'000;
inline constexpr int kNumScans = 51;

inline NavOutput NavOf(int scan) {
  NavOutput nav;
  nav.stamp = Timestamp::FromMicroseconds(kRecordingStart_us + scan * 100'000);
  nav.scan_seq = scan;
  nav.status = TrackingStatus::kOk;
  nav.T_map_imu.translation = {0.5 * scan, 0, 0};
  nav.T_world_imu.rotation = Quaternion(Eigen::AngleAxisd(M_PI / 2, Vector3::UnitZ()));
  nav.T_world_imu.translation = {0, 0.5 * scan, 0};
  nav.v_world_imu_mps = {0, 5, 0};
  nav.pose_cov.diagonal() << 0.01, 0.04, 0.09, 1e-4, 1e-4, 1e-4;
  return nav;
}

inline ScanChunk CloudOf(int scan) {
  ScanChunk chunk;
  chunk.stamp = NavOf(scan).stamp;
  chunk.scan_seq = scan;
  chunk.sensor_id = -1;
  for (int i = 0; i < 20; ++i) {
    chunk.points.push_back({.x_m = static_cast<float>(scan) + 0.5F,
                            .y_m = static_cast<float>(i) + 0.5F,
                            .z_m = 1.0F,
                            .intensity = 7,
                            .ring = 3});
  }
  chunk.points[0].x_m = std::nanf("");
  return chunk;
}

// Each message was received 5 ms after its stamp.
inline std::filesystem::path RecordedLog(const TempDir& folder) {
  const std::filesystem::path path = folder.path() / "recorded.lcm";
  EventLogWriter writer(path);
  for (int i = 0; i < kNumScans; ++i) {
    const std::int64_t utime = kRecordingStart_us + i * 100'000 + 5000;
    FilterReport filter;
    filter.nav = NavOf(i);
    filter.gyro_bias_radps = {0.001, 0.002, 0.003};
    filter.nis = 5.5;
    filter.nis_dof = 6;
    filter.cov = Eigen::MatrixXd::Identity(21, 21);
    ScanReport scan;
    scan.stamp = filter.nav.stamp;
    scan.num_used = 1000;
    scan.num_matched = 900;
    writer.Write(utime, "LIO_IMU", EncodeImu({.stamp = filter.nav.stamp}, i));
    writer.Write(utime, "LIO_ODOM", EncodeOdometry(filter.nav));
    writer.Write(utime, "LIO_STATE", EncodeFilterState(filter));
    writer.Write(utime, "LIO_REG", EncodeRegistration(scan));
    writer.Write(utime, "LIO_CLOUD", EncodeChunk(CloudOf(i)));
    if (i % 10 != 0) continue;
    StatusReport status;
    status.newest_stamp = filter.nav.stamp;
    status.state = TrackingStatus::kOk;
    status.note = i < 20 ? "started at rest" : "a gap";
    writer.Write(utime, "LIO_STATUS", EncodeStatus(status, "0.1.0"));
  }
  writer.Close();
  return path;
}

}  // namespace lio::test
