// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the log that a converter wrote back into sweeps and samples, and checks what must hold of
// any log.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "lio/io/event_log.hpp"
#include "lio/io/lcm_codec.hpp"

namespace lio::test {

struct LoggedPoint {
  std::int64_t instant_ns = 0;
  LidarPoint point;
};

struct LoggedSweep {
  std::int32_t scan_seq = 0;
  int num_chunks = 0;
  std::int64_t last_event_utime = 0;  // event of its last chunk
  std::vector<LoggedPoint> points;
};

struct LoggedImu {
  std::int64_t event_utime = 0;
  ImuSample sample;
};

struct LioLog {
  std::vector<LoggedSweep> sweeps;
  std::vector<LoggedImu> imu;
};

// Checks that events are in the order of their times, that every message decodes, that chunks are
// complete and in sequence, that times in a sweep never decrease, that the IMU is numbered without
// holes, and that chunks are sent at the intervals at which their last points were measured.
inline LioLog ReadLioLog(const std::filesystem::path& path) {
  EventLogReader reader(path);
  LioLog log;
  LogEvent event;
  std::int64_t last_utime = INT64_MIN;
  while (reader.Next(event)) {
    EXPECT_GE(event.utime, last_utime);
    last_utime = event.utime;
    if (event.channel == "LIO_IMU") {
      LoggedImu imu{event.utime, {}};
      std::int32_t seq = -1;
      EXPECT_EQ(DecodeImu(event.data, imu.sample, seq), DecodeStatus::kOk);
      EXPECT_EQ(seq, static_cast<std::int32_t>(log.imu.size()));
      log.imu.push_back(imu);
      continue;
    }
    EXPECT_EQ(event.channel, "LIO_SCAN");
    ScanChunk chunk;
    EXPECT_EQ(DecodeChunk(event.data, chunk), DecodeStatus::kOk);
    if (chunk.chunk_index == 0) log.sweeps.push_back({chunk.scan_seq, chunk.chunk_count, 0, {}});
    LoggedSweep& sweep = log.sweeps.back();
    EXPECT_EQ(sweep.scan_seq, chunk.scan_seq);
    EXPECT_EQ(chunk.scan_seq, static_cast<std::int32_t>(log.sweeps.size()) - 1);
    EXPECT_EQ(chunk.chunk_count, sweep.num_chunks);
    EXPECT_FALSE(chunk.points.empty());
    // The stamp is that of the chunk's first point, cut to microseconds.
    if (chunk.points.empty()) continue;
    EXPECT_LT(chunk.points.front().t_offset_ns, 1000u);
    const std::int64_t before_ns =
        sweep.points.empty() ? INT64_MIN : sweep.points.back().instant_ns;
    for (const LidarPoint& point : chunk.points) {
      sweep.points.push_back({chunk.stamp.ns + point.t_offset_ns, point});
    }
    EXPECT_GE(sweep.points[sweep.points.size() - chunk.points.size()].instant_ns, before_ns);
    if (before_ns != INT64_MIN) {
      const std::int64_t sent_later_us = event.utime - sweep.last_event_utime;
      const std::int64_t measured_later_us = (sweep.points.back().instant_ns - before_ns) / 1000;
      EXPECT_NEAR(static_cast<double>(sent_later_us), static_cast<double>(measured_later_us), 2.0);
    }
    sweep.last_event_utime = event.utime;
  }
  EXPECT_EQ(reader.skipped_bytes(), 0);
  for (const LoggedSweep& sweep : log.sweeps) {
    for (std::size_t i = 1; i < sweep.points.size(); ++i) {
      EXPECT_GE(sweep.points[i].instant_ns, sweep.points[i - 1].instant_ns);
    }
  }
  return log;
}

}  // namespace lio::test
