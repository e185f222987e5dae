// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/synchronous_odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Bytes;
using test::Message;
using test::Messages;
using test::RunOdometry;
using test::StaticStartDrive;

constexpr Duration kEarly{2'000'000};  // the stamp may be before the first point

struct Taken {
  std::vector<ScanOutput> scans;
  std::size_t num_navs = 0;
};

void Take(SynchronousOdometry& odometry, Taken& taken) {
  for (const Output& output : odometry.TakeOutputs()) {
    if (const auto* scan = std::get_if<ScanOutput>(&output)) taken.scans.push_back(*scan);
    if (std::holds_alternative<NavOutput>(output)) ++taken.num_navs;
  }
}

// Makes one sweep of all its chunks, with a stamp before its first point and its points out of
// order.
LidarSweep WholeSweep(const std::vector<ScanChunk>& chunks) {
  LidarSweep sweep;
  sweep.stamp = chunks.front().stamp - kEarly;
  for (const ScanChunk& chunk : chunks) {
    for (LidarPoint point : chunk.points) {
      point.t_offset_ns += static_cast<std::uint32_t>((chunk.stamp - sweep.stamp).ns);
      sweep.points.push_back(point);
    }
  }
  auto middle = sweep.points.begin() + static_cast<std::ptrdiff_t>(sweep.points.size() / 2);
  while (middle != sweep.points.end() && std::prev(middle)->t_offset_ns == middle->t_offset_ns) {
    ++middle;
  }
  std::rotate(sweep.points.begin(), middle, sweep.points.end());
  return sweep;
}

Taken FeedSweeps(SynchronousOdometry& odometry, const Messages& messages) {
  Taken taken;
  std::vector<ScanChunk> chunks;
  for (const Message& message : messages) {
    if (message.is_imu) {
      odometry.AddImu(message.sample);
    } else {
      chunks.push_back(message.chunk);
      if (static_cast<int>(chunks.size()) < message.chunk.chunk_count) continue;
      odometry.AddSweep(WholeSweep(std::exchange(chunks, {})));
    }
    Take(odometry, taken);
  }
  odometry.Flush();
  Take(odometry, taken);
  return taken;
}

TEST(SynchronousOdometry, ChunksGiveWhatTheJobsRunByHandGive) {
  const Messages messages = StaticStartDrive();
  const auto by_hand = RunOdometry(messages, test::DriveRig());
  SynchronousOdometry odometry(test::DriveRig());
  Taken taken;
  for (const Message& message : messages) {
    if (message.is_imu) odometry.AddImu(message.sample);
    if (!message.is_imu) odometry.AddChunk(message.chunk);
    Take(odometry, taken);
  }
  odometry.Flush();
  Take(odometry, taken);
  ASSERT_GT(taken.scans.size(), 20u);
  EXPECT_EQ(Bytes(taken.scans), Bytes(by_hand.scans));
  EXPECT_EQ(taken.num_navs, by_hand.navs.size());
  EXPECT_EQ(odometry.status(), by_hand.status);
  EXPECT_EQ(odometry.counters().num_chunks, by_hand.counters.num_chunks);
}

TEST(SynchronousOdometry, WholeSweepsInAnyOrderOfPointsGiveTheSameAsTheirChunks) {
  const Messages messages = StaticStartDrive();
  SynchronousOdometry odometry(test::DriveRig());
  const Taken taken = FeedSweeps(odometry, messages);
  EXPECT_EQ(Bytes(taken.scans), Bytes(RunOdometry(messages, test::DriveRig()).scans));
  EXPECT_EQ(odometry.counters().num_chunks_bad, 0);
}

TEST(SynchronousOdometry, GivesPosesWithoutAnImuToo) {
  SynchronousOdometry odometry(test::LidarOnly());
  const Taken taken = FeedSweeps(odometry, test::WithoutImu(StaticStartDrive(), -1.0, 100.0));
  ASSERT_GT(taken.scans.size(), 20u);
  EXPECT_TRUE(taken.scans.back().filter.has_value());
}

TEST(SynchronousOdometry, MapCloudsAreKeptWhenAskedFor) {
  SynchronousOdometry silent(test::DriveRig());
  FeedSweeps(silent, StaticStartDrive());
  EXPECT_TRUE(silent.TakeMapClouds().empty());

  SynchronousOdometry odometry(test::DriveRig());
  odometry.KeepMapClouds(true);
  FeedSweeps(odometry, StaticStartDrive());
  const auto clouds = odometry.TakeMapClouds();
  ASSERT_FALSE(clouds.empty());
  for (const auto& cloud : clouds) {
    ASSERT_FALSE(cloud.empty());
    const bool is_finite =
        std::all_of(cloud.begin(), cloud.end(), [](const auto& p) { return p.allFinite(); });
    EXPECT_TRUE(is_finite);
  }
  EXPECT_TRUE(odometry.TakeMapClouds().empty());
}

TEST(SynchronousOdometry, AnEmptySweepIsCountedAndHarmless) {
  SynchronousOdometry odometry(test::DriveRig());
  odometry.AddSweep({Timestamp{1'000'000'000}, {}});
  odometry.Flush();
  EXPECT_EQ(odometry.counters().num_scans, 1);
}

TEST(SynchronousOdometry, WrongOptionsAreRefused) {
  Options options = test::DriveRig();
  options.rig.T_imu_lidar.reset();
  EXPECT_THROW(SynchronousOdometry{options}, std::invalid_argument);
}

TEST(SynchronousOdometry, CanBeMoved) {
  SynchronousOdometry first(test::DriveRig());
  SynchronousOdometry second(std::move(first));
  second.AddImu({Timestamp{1'000'000'000}, Vector3::Zero(), {0, 0, 9.81}});
  EXPECT_EQ(second.counters().num_imu, 1);
}

}  // namespace
}  // namespace lio
