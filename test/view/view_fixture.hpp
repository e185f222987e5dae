// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes messages of a daemon for the tests of lio-view.
#pragma once

#include <vector>

#include "lio/io/status_report.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio::test {

inline constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

// The pose `t_s` seconds after the start: at x = t_s in map.
inline NavOutput NavAt(double t_s, OdometrySource source = OdometrySource::kScanUpdate) {
  NavOutput nav;
  nav.stamp = Timestamp::FromMicroseconds(kStart_us + static_cast<std::int64_t>(t_s * 1e6));
  nav.status = TrackingStatus::kOk;
  nav.source = source;
  nav.T_map_imu.translation = {t_s, 0, 0};
  nav.T_world_imu = nav.T_map_imu;
  nav.pose_cov.diagonal() << 0.01, 0.04, 0.09, 1e-4, 1e-4, 1e-4;
  return nav;
}

inline std::int64_t UtimeAt(double t_s) {
  return kStart_us + static_cast<std::int64_t>(t_s * 1e6);
}

// Returns a registered cloud of `num` points a metre apart along x, from `first` on.
inline ScanChunk CloudOf(std::int32_t seq, int num, float first = 0.0F) {
  ScanChunk chunk;
  chunk.stamp = Timestamp::FromMicroseconds(kStart_us);
  chunk.scan_seq = seq;
  chunk.sensor_id = -1;
  for (int i = 0; i < num; ++i) {
    chunk.points.push_back({.x_m = first + static_cast<float>(i) + 0.5F, .y_m = 0.5F, .z_m = 0.5F});
  }
  return chunk;
}

inline StatusReport StatusOfRun(std::int64_t start_utime, std::int64_t num_restarts = 0) {
  StatusReport report;
  report.start_utime = start_utime;
  report.utime = start_utime + 1'000'000;
  report.counters.num_restarts = num_restarts;
  report.state = TrackingStatus::kOk;
  return report;
}

}  // namespace lio::test
