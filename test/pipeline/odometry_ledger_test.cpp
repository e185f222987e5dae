// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Every sample, chunk and scan has one fate: on clean, damaged and hostile drives.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "lio/pipeline/odometry.hpp"
#include "support/faulty_drives.hpp"

namespace lio {
namespace {

using test::Message;
using test::Messages;
using test::RunOdometry;
using test::RunResult;
using test::StaticStartDrive;

// After the end of a log nothing may wait, so the ledgers without what waits must close.
Ledgers ExpectClosed(const RunResult& run, const Messages& messages) {
  Ledgers ledgers = run.counters.ledgers;
  EXPECT_EQ(ledgers.samples.num_received + ledgers.chunks.num_received, std::ssize(messages));
  EXPECT_EQ(ledgers.samples.Unaccounted(), 0);
  EXPECT_EQ(ledgers.chunks.Unaccounted(), 0);
  EXPECT_EQ(ledgers.scans.Unaccounted(), 0);
  EXPECT_EQ(ledgers.scans.Of(ScanFate::kUsed) + ledgers.scans.Of(ScanFate::kRejected),
            std::ssize(run.scans));
  return ledgers;
}

TEST(OdometryLedger, ClosesOnACleanDrive) {
  const RunResult run = RunOdometry(StaticStartDrive(), test::DriveRig());
  const Ledgers ledgers = ExpectClosed(run, StaticStartDrive());
  EXPECT_EQ(ledgers.samples.Of(SampleFate::kUsed), ledgers.samples.num_received);
  EXPECT_EQ(ledgers.chunks.Of(ChunkFate::kUsed), ledgers.chunks.num_received);
  EXPECT_EQ(ledgers.scans.Of(ScanFate::kUsed) + ledgers.scans.Of(ScanFate::kBeforeStart),
            ledgers.scans.num_received);
}

TEST(OdometryLedger, ClosesWithSlowMatches) {
  ExpectClosed(RunOdometry(StaticStartDrive(), test::DriveRig(), 40), StaticStartDrive());
}

TEST(OdometryLedger, ClosesInLidarOnlyOdometry) {
  const RunResult run = RunOdometry(StaticStartDrive(), test::LidarOnly());
  const Ledgers ledgers = ExpectClosed(run, StaticStartDrive());
  EXPECT_EQ(ledgers.samples.Of(SampleFate::kUnwanted), ledgers.samples.num_received);
}

TEST(OdometryLedger, ClosesOverOutagesAndClockSteps) {
  const Messages& drive = StaticStartDrive();
  for (const Messages& messages :
       {test::WithoutImu(drive, 3.0, 3.3), test::WithoutImu(drive, 2.5, 5.0),
        test::WithoutImu(drive, 3.0, 9.0), test::WithoutImu(drive, 0.0, 3.0),
        test::WithoutLidar(drive, 3.0, 5.0), test::WithClockStep(drive, 4.0, 1.5),
        test::WithClockStep(drive, 4.0, 5.0), test::WithClockStep(drive, 4.0, -5.0),
        test::WithClockStep(drive, 4.0, 0.5, true, false),
        test::WithClockStep(drive, 4.0, 0.5, false, true),
        test::WithClockStep(drive, 4.0, -0.2, false, true)}) {
    SCOPED_TRACE(::testing::Message() << "case of " << messages.size() << " messages, the last at "
                                      << test::SecondsOf(messages.back().sample.stamp));
    ExpectClosed(RunOdometry(messages, test::DriveRig()), messages);
  }
}

// Damage as a bad link or driver makes it: losses, copies, swaps, values that are no numbers.
TEST(OdometryLedger, ClosesOnDamagedMessages) {
  std::mt19937 random(7);
  Messages messages;
  for (const Message& message : StaticStartDrive()) {
    const auto dice = random() % 20;
    if (dice == 0) continue;
    messages.push_back(message);
    if (dice == 1) messages.push_back(message);
    if (dice == 2 && messages.size() > 5) std::swap(messages.back(), messages[messages.size() - 5]);
    if (dice == 3)
      messages.back().sample.w_imu_radps.x() = std::numeric_limits<double>::quiet_NaN();
    if (dice == 4) messages.back().sample.f_imu_mps2.setConstant(1e9);
    if (dice == 5) test::MakeBlind(messages.back());
  }
  const Ledgers ledgers = ExpectClosed(RunOdometry(messages, test::DriveRig()), messages);
  EXPECT_GT(ledgers.samples.Of(SampleFate::kNonfinite), 0);
  EXPECT_GT(ledgers.samples.Of(SampleFate::kOutOfRange), 0);
  EXPECT_GT(ledgers.chunks.Of(ChunkFate::kLate) + ledgers.chunks.Of(ChunkFate::kDuplicate), 0);
}

// Somebody on the bus means ill: indexes, counts, stamps, senders and numbers that make no sense.
TEST(OdometryLedger, ClosesOnHostileMessages) {
  std::mt19937 random(11);
  const auto any_stamp = [&] {
    const std::int64_t stamps[] = {0, std::int64_t{1} << 62, -(std::int64_t{1} << 62),
                                   static_cast<std::int64_t>(random()) * 1'000'000'000};
    return Timestamp{stamps[random() % 4]};
  };
  Messages messages;
  for (const Message& message : StaticStartDrive()) {
    messages.push_back(message);
    if (random() % 5 != 0) continue;
    Message forged = message;
    ScanChunk& chunk = forged.chunk;
    switch (random() % 6) {
      case 0:
        forged.sample.stamp = chunk.stamp = any_stamp();
        break;
      case 1:
        chunk.chunk_index = static_cast<std::int16_t>(random());
        break;
      case 2:
        chunk.chunk_count = static_cast<std::int16_t>(random());
        break;
      case 3:
        chunk.sensor_id = static_cast<std::int8_t>(random());
        break;
      case 4:
        chunk.scan_seq = static_cast<std::int32_t>(random());
        break;
      default:
        forged.sample.seq = static_cast<std::int32_t>(random());
        break;
    }
    messages.push_back(forged);
  }
  const Ledgers ledgers = ExpectClosed(RunOdometry(messages, test::DriveRig()), messages);
  EXPECT_GT(ledgers.chunks.Of(ChunkFate::kBad), 0);
  EXPECT_GT(ledgers.chunks.Of(ChunkFate::kForeign), 0);
}

TEST(OdometryLedger, WhatWaitsIsPartOfItAndIsForgottenByAReset) {
  Odometry odometry(test::DriveRig());
  const auto expect_closed = [&] {
    const Ledgers ledgers = odometry.ledgers();
    EXPECT_EQ(ledgers.samples.Unaccounted(), 0);
    EXPECT_EQ(ledgers.chunks.Unaccounted(), 0);
    EXPECT_EQ(ledgers.scans.Unaccounted(), 0);
    return ledgers;
  };
  for (const Message& message : StaticStartDrive()) {
    if (message.is_imu) {
      odometry.AddImu(message.sample);
    } else {
      odometry.AddChunk(message.chunk, 0);
    }
    expect_closed();
  }
  const std::int64_t num_waiting = expect_closed().scans.num_waiting;
  EXPECT_GT(num_waiting, 5) << "no match was begun";
  odometry.Reset(std::nullopt, StaticStartDrive().back().arrival);
  EXPECT_EQ(expect_closed().scans.num_waiting, 0);
  EXPECT_EQ(odometry.ledgers().scans.Of(ScanFate::kForgotten), num_waiting);
}

}  // namespace
}  // namespace lio
