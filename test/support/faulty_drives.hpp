// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the drives of the estimator's tests and their faults, and checks what must hold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "support/simulated_drive.hpp"

namespace lio::test {

inline constexpr double kRest_s = 1.5;
inline constexpr double kEnd_s = 6.5;

inline Motion RestThenDrive() {
  return WindingDrive(kRest_s);
}

inline const Messages& StaticStartDrive() {
  static const Messages kMessages = [] {
    DriveOptions options;
    options.motion = RestThenDrive();
    options.to_s = kEnd_s;
    return SimulateDrive(Street(), options);
  }();
  return kMessages;
}

inline Messages MovingStartDrive(double to_s = 5.0) {
  DriveOptions options;
  options.motion = Driving();
  options.to_s = to_s;
  return SimulateDrive(Street(), options);
}

inline Options LidarOnly() {
  Options options = DriveRig();
  options.pipeline.use_imu = false;
  return options;
}

inline Messages Where(const Messages& messages,
                      const std::function<bool(const Message&)>& is_kept) {
  Messages kept;
  std::copy_if(messages.begin(), messages.end(), std::back_inserter(kept), is_kept);
  return kept;
}

inline bool IsBetween(const Message& message, double from_s, double to_s) {
  return message.arrival >= StampAt(from_s) && message.arrival < StampAt(to_s);
}

inline Messages WithoutImu(const Messages& messages, double from_s, double to_s) {
  return Where(messages, [=](const Message& message) {
    return !(message.is_imu && IsBetween(message, from_s, to_s));
  });
}

// Sweeps show clouds of points meanwhile: nothing fits.
inline void ShowClouds(double from_s, double to_s, Messages& messages) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> place(-20.f, 20.f);
  for (Message& message : messages) {
    if (message.is_imu || !IsBetween(message, from_s, to_s)) continue;
    for (LidarPoint& point : message.chunk.points) {
      point.x_m = place(random);
      point.y_m = place(random);
      point.z_m = 4.f + place(random);
    }
  }
}

inline Messages WithoutLidar(const Messages& messages, double from_s, double to_s) {
  return Where(messages, [=](const Message& message) {
    return message.is_imu || !IsBetween(message, from_s, to_s);
  });
}

// Moves the stamps of both sensors, or of one of them by choice, by `shift_s` from `from_s` on.
inline Messages WithClockStep(Messages messages, double from_s, double shift_s, bool imu = true,
                              bool lidar = true) {
  for (Message& message : messages) {
    if (message.arrival < StampAt(from_s)) continue;
    const Duration shift = Duration::FromSeconds(shift_s);
    if (message.is_imu && imu) message.sample.stamp = message.sample.stamp + shift;
    if (!message.is_imu && lidar) message.chunk.stamp = message.chunk.stamp + shift;
  }
  return messages;
}

inline Messages SortedByArrival(Messages messages) {
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Message& a, const Message& b) { return a.arrival < b.arrival; });
  return messages;
}

// Removes every finite point.
inline void MakeBlind(Message& message) {
  for (LidarPoint& point : message.chunk.points) {
    point.x_m = point.y_m = point.z_m = std::numeric_limits<float>::quiet_NaN();
  }
}

inline void ExpectStampsIncrease(const RunResult& run) {
  for (std::size_t i = 1; i < run.scans.size(); ++i) {
    ASSERT_GT(run.scans[i].scan.stamp, run.scans[i - 1].scan.stamp) << "scan " << i;
  }
  for (std::size_t i = 1; i < run.navs.size(); ++i) {
    ASSERT_GT(run.navs[i].stamp, run.navs[i - 1].stamp) << "sample " << i;
  }
}

inline int NumFused(const RunResult& run) {
  return static_cast<int>(std::count_if(run.scans.begin(), run.scans.end(),
                                        [](const ScanOutput& s) { return s.scan.fused; }));
}

// Expects all counters of faults to be zero.
inline void ExpectClean(const Counters& c) {
  for (const std::int64_t count :
       {c.num_imu_nonfinite,    c.num_imu_duplicate,    c.num_imu_late,
        c.num_imu_out_of_range, c.num_imu_clipped,      c.num_imu_gaps,
        c.num_chunks_duplicate, c.num_chunks_late,      c.num_chunks_missing,
        c.num_chunks_bad,       c.num_points_nonfinite, c.num_scans_empty,
        c.num_scans_dropped,    c.num_scans_late,       c.num_scans_without_imu,
        c.num_scan_gaps,        c.num_matches_rejected, c.num_gated,
        c.num_clock_jumps,      c.num_restarts}) {
    EXPECT_EQ(count, 0);
  }
}

}  // namespace lio::test
