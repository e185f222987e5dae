// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/status_board.hpp"

#include <gtest/gtest.h>

#include "lio/io/cpu_clock.hpp"

namespace lio {
namespace {

TEST(StatusBoard, WhatWasPinnedIsReported) {
  StatusBoard board("pipeline: {}", 1 << 20);
  Counters counters;
  counters.num_gated = 3;
  board.SetEstimator(counters, TrackingStatus::kCoasting, Timestamp{9});
  InputCounters input;
  input.num_imu_missing = 4;
  board.SetInput(input);
  board.SetClockOffset({.offset_s = 0.025, .std_s = 0.0004});
  board.SetNote("waiting");
  board.CountRefusedCommand();
  const StatusReport report = board.Compose();
  EXPECT_EQ(report.config_hash, Fnv1a("pipeline: {}"));
  EXPECT_EQ(report.receive_buffer_bytes, 1 << 20);
  EXPECT_EQ(report.counters.num_gated, 3);
  EXPECT_EQ(report.state, TrackingStatus::kCoasting);
  EXPECT_EQ(report.newest_stamp, Timestamp{9});
  EXPECT_EQ(report.input.num_imu_missing, 4);
  EXPECT_EQ(report.clock_offset.offset_s, 0.025);
  EXPECT_EQ(report.clock_offset.std_s, 0.0004);
  EXPECT_EQ(report.note, "waiting");
  EXPECT_EQ(report.num_commands_refused, 1);
  EXPECT_GT(report.rss_mb, 1.0F);
  EXPECT_GE(report.utime, report.start_utime);
  EXPECT_EQ(report.seq, 0);
  EXPECT_EQ(board.Compose().seq, 1);
}

TEST(StatusBoard, TheOptionsAreInTheFirstReportAndWhenTheyAreAskedFor) {
  StatusBoard board("pipeline: {}", 0);
  EXPECT_EQ(board.Compose().options, "pipeline: {}");
  EXPECT_EQ(board.Compose().options, "");
  board.TellOptions();
  EXPECT_EQ(board.Compose().options, "pipeline: {}");
  EXPECT_EQ(board.Compose().options, "");
}

TEST(StatusBoard, TheClockOffsetIsTheConfiguredOneUnlessItIsEstimated) {
  StatusBoard board("", 0, 0.004);
  EXPECT_EQ(board.Compose().clock_offset.offset_s, 0.004);
  board.SetClockOffset({.offset_s = 0.025, .std_s = 0.0004});
  EXPECT_EQ(board.Compose().clock_offset.offset_s, 0.025);
  board.ForgetClockOffset();
  const ClockOffsetStatus forgotten = board.Compose().clock_offset;
  EXPECT_EQ(forgotten.offset_s, 0.004);
  EXPECT_EQ(forgotten.std_s, 0.0);
}

TEST(StatusBoard, LatenciesAreThoseSinceTheLastReport) {
  StatusBoard board("", 0);
  for (int i = 1; i <= 100; ++i) board.AddLatency(i, 1000.0);
  const StatusReport report = board.Compose();
  EXPECT_NEAR(report.queue.p50_ms, 50.5, 0.6);
  EXPECT_EQ(report.queue.p99_ms, 99.0F);
  EXPECT_EQ(report.queue.max_ms, 100.0F);
  EXPECT_EQ(report.compute.p50_ms, 1000.0F);
  EXPECT_EQ(report.latency.max_ms, 1100.0F);
  EXPECT_EQ(board.Compose().latency.max_ms, 0.0F);
}

TEST(StatusBoard, LoadIsCpuTimeSinceTheLastReport) {
  std::int64_t utime = 1'000'000;
  std::int64_t cpu_us = 70'000;
  StatusBoard board("", 0, 0.0, {[&] { return utime; }, [&] { return cpu_us; }});
  utime += 2'000'000;
  cpu_us += 500'000;
  EXPECT_EQ(board.Compose().cpu_load_cores, 0.25F);
  utime += 1'000'000;
  cpu_us += 1'500'000;
  EXPECT_EQ(board.Compose().cpu_load_cores, 1.5F) << "two threads";
  EXPECT_EQ(board.Compose().cpu_load_cores, 0.0F) << "no time has passed";
}

TEST(ProcessCpuMicroseconds, GrowsByWhatAThreadUses) {
  const std::int64_t before = ProcessCpuMicroseconds();
  const std::int64_t thread_before = ThreadCpuNs();
  while (ThreadCpuNs() - thread_before < 20'000'000) {
  }
  EXPECT_GE(ProcessCpuMicroseconds() - before, 10'000);  // the kernel's ticks are coarse
}

}  // namespace
}  // namespace lio
