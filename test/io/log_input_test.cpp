// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/log_input.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

// Writes ten seconds of samples at 10 Hz with a chunk after each, a foreign channel and a bad
// message.
class LogInputTest : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    EventLogWriter writer(path_);
    for (int i = 0; i < 100; ++i) {
      const std::int64_t utime = 1'000'000'000 + 100'000 * i;
      const Timestamp stamp = Timestamp::FromMicroseconds(utime);
      writer.Write(utime, "LIO_IMU", EncodeImu({.stamp = stamp}, i));
      writer.Write(utime + 1, "OTHER", Bytes(10));
      writer.Write(utime + 2, "LIO_SCAN",
                   EncodeChunk({.stamp = stamp, .scan_seq = i, .points = {}}));
    }
    writer.Write(1'010'000'000, "LIO_SCAN", Bytes(5));
  }

  LogInputOptions Options() const {
    LogInputOptions options;
    options.reads_ahead = GetParam();
    return options;
  }

  test::TempDir folder_;
  std::filesystem::path path_ = folder_.path() / "log.lcm";
};

TEST_P(LogInputTest, SamplesAndChunksComeInTheLogsOrder) {
  LogInput input(path_, Options());
  for (int i = 0; i < 100; ++i) {
    const auto imu = input.Next();
    ASSERT_TRUE(imu);
    EXPECT_EQ(std::get<ImuSample>(imu->data).stamp.Microseconds(), 1'000'000'000 + 100'000 * i);
    const auto scan = input.Next();
    ASSERT_TRUE(scan);
    EXPECT_EQ(std::get<ScanChunk>(scan->data).scan_seq, i);
    EXPECT_EQ(scan->utime, 1'000'000'002 + 100'000 * i);
  }
  EXPECT_FALSE(input.Next());
  EXPECT_FALSE(input.Next());
  EXPECT_EQ(input.counters().TotalRefused(), 1);
  EXPECT_EQ(input.num_skipped_bytes(), 0);
  EXPECT_NEAR(input.duration_s(), 9.900002, 1e-9);
}

TEST_P(LogInputTest, StartAndDurationCutByReceiveTime) {
  LogInputOptions options = Options();
  options.start_s = 2.0;
  options.duration_s = 1.0;
  LogInput input(path_, options);
  int num_items = 0;
  while (const auto item = input.Next()) {
    EXPECT_GE(item->utime, 1'002'000'000);
    EXPECT_LT(item->utime, 1'003'000'000);
    ++num_items;
  }
  EXPECT_EQ(num_items, 20);
}

TEST_P(LogInputTest, ChannelsFollowThePrefix) {
  LogInputOptions options = Options();
  options.channels = Channels("OTHER_");
  LogInput input(path_, options);
  EXPECT_FALSE(input.Next());
  EXPECT_EQ(input.duration_s(), 0.0);
}

TEST_P(LogInputTest, MayBeLeftBeforeItsEnd) {
  LogInput input(path_, Options());
  EXPECT_TRUE(input.Next());
}

[[noreturn]] std::int64_t FailingClock() {
  throw std::runtime_error("no clock");
}

TEST_P(LogInputTest, WhatReadingThrowsReachesTheCaller) {
  LogInputOptions options = Options();
  options.clock = FailingClock;
  LogInput input(path_, options);
  EXPECT_THROW((void)input.Next(), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Threads, LogInputTest, ::testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Ahead" : "InTurn"; });

}  // namespace
}  // namespace lio
