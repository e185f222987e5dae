// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/scan_gate.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

Sweep SweepEnding(double end_s, std::size_t num_points = 10) {
  Sweep sweep;
  sweep.start = StampAt(end_s - 0.1);
  sweep.end = StampAt(end_s);
  sweep.points.resize(num_points);
  return sweep;
}

struct Gate {
  Counters counters;
  ScanGate gate{counters};
};

TEST(ScanGate, SweepWaitsForTheImuToPassItsEnd) {
  Gate g;
  g.gate.Add(SweepEnding(0.1));
  EXPECT_EQ(g.gate.Open(std::nullopt), nullptr);
  EXPECT_EQ(g.gate.Open(StampAt(0.099)), nullptr);
  const SweepPtr sweep = g.gate.Open(StampAt(0.1));
  ASSERT_NE(sweep, nullptr);
  EXPECT_EQ(sweep->end, StampAt(0.1));
  EXPECT_TRUE(g.gate.empty());
  EXPECT_EQ(g.counters.num_scans, 1);
}

TEST(ScanGate, SweepsLeaveOldestFirst) {
  Gate g;
  for (const double end_s : {0.1, 0.2, 0.3}) g.gate.Add(SweepEnding(end_s));
  EXPECT_NEAR(g.gate.waiting_span_s(), 0.2, 1e-12);
  EXPECT_EQ(g.gate.Open(StampAt(0.25))->end, StampAt(0.1));
  EXPECT_EQ(g.gate.Open(StampAt(0.25))->end, StampAt(0.2));
  EXPECT_EQ(g.gate.Open(StampAt(0.25)), nullptr);
}

TEST(ScanGate, SweepsThatHardlyAdvanceAreBoundedByTheirNumberAndPoints) {
  Gate many, large;
  for (int i = 0; i < 2000; ++i) many.gate.Add(SweepEnding(0.1 + 1e-6 * i, 1));
  EXPECT_EQ(many.counters.num_scans_without_imu, 2000 - 512);
  for (int i = 0; i < 20; ++i) large.gate.Add(SweepEnding(0.1 + 1e-6 * i, 1 << 20));
  EXPECT_EQ(large.counters.num_scans_without_imu, 20 - 8);
}

TEST(ScanGate, EmptySweepsAreCountedAndDropped) {
  Gate g;
  g.gate.Add(SweepEnding(0.1, 0));
  EXPECT_TRUE(g.gate.empty());
  EXPECT_EQ(g.counters.num_scans_empty, 1);
  EXPECT_EQ(g.counters.num_scans, 1);
}

TEST(ScanGate, LateSweepsAreCountedAndDropped) {
  Gate g;
  g.gate.Add(SweepEnding(0.2));
  g.gate.Add(SweepEnding(0.1));
  g.gate.Add(SweepEnding(0.2));
  EXPECT_EQ(g.counters.num_scans_late, 2);
  EXPECT_EQ(g.gate.Force()->end, StampAt(0.2));
  EXPECT_TRUE(g.gate.empty());
}

TEST(ScanGate, GapBetweenSweepsIsCounted) {
  Gate g;
  g.gate.Add(SweepEnding(0.1));
  g.gate.Add(SweepEnding(0.2));
  g.gate.Add(SweepEnding(0.8));
  EXPECT_EQ(g.counters.num_scan_gaps, 1);
}

TEST(ScanGate, ManyLateSweepsInARowAreAClockSetBack) {
  Gate g;
  g.gate.Add(SweepEnding(100.0));
  int num_sent = 0;
  while (g.counters.num_clock_jumps == 0 && num_sent < 20)
    g.gate.Add(SweepEnding(0.1 * ++num_sent));
  EXPECT_EQ(g.counters.num_clock_jumps, 1);
  EXPECT_LE(num_sent, 5);
  const SweepPtr sweep = g.gate.Open(StampAt(10.0));
  ASSERT_NE(sweep, nullptr) << "sweeps of the new time must pass";
  EXPECT_EQ(sweep->end, StampAt(0.1 * num_sent));
}

TEST(ScanGate, ImuIsSilentAfterASecondOfTheLidarWithoutASample) {
  Gate g;
  for (int i = 1; i <= 30; ++i) {
    g.gate.Add(SweepEnding(0.1 * i));
    EXPECT_EQ(g.gate.Open(StampAt(0.0)), nullptr);
    EXPECT_EQ(g.gate.IsImuSilent(), i > 11) << i;
  }
  while (g.gate.Force() != nullptr) continue;
  EXPECT_FALSE(g.gate.IsImuSilent()) << "no sweep waits for it";
}

TEST(ScanGate, SampleEndsTheSilence) {
  Gate g;
  (void)g.gate.Open(StampAt(0.0));
  for (int i = 1; i <= 20; ++i) g.gate.Add(SweepEnding(0.1 * i));
  (void)g.gate.Open(StampAt(0.0));
  EXPECT_TRUE(g.gate.IsImuSilent());
  (void)g.gate.Open(StampAt(0.01));
  EXPECT_FALSE(g.gate.IsImuSilent());
}

TEST(ScanGate, StampsThatStepAheadDoNotMakeTheImuSilent) {
  Gate g;
  g.gate.Add(SweepEnding(0.1));
  ASSERT_NE(g.gate.Open(StampAt(0.11)), nullptr);
  g.gate.Add(SweepEnding(1.7));
  EXPECT_EQ(g.gate.Open(StampAt(0.11)), nullptr);
  EXPECT_EQ(g.gate.Open(StampAt(0.12)), nullptr);
  EXPECT_FALSE(g.gate.IsImuSilent());
}

TEST(ScanGate, ImuThatLagsButComesIsWaitedFor) {
  Gate g;
  for (int i = 1; i <= 50; ++i) {  // always three seconds behind
    g.gate.Add(SweepEnding(0.1 * i));
    const SweepPtr sweep = g.gate.Open(StampAt(0.1 * i - 3.0));
    ASSERT_EQ(sweep != nullptr, i > 30) << i;
  }
  EXPECT_EQ(g.counters.num_scans_without_imu, 0);
}

TEST(ScanGate, OneSweepFarAheadIsNotBelieved) {
  Gate g;
  g.gate.Add(SweepEnding(0.1));
  g.gate.Add(SweepEnding(3600.0));
  g.gate.Add(SweepEnding(0.2));
  g.gate.Add(SweepEnding(0.3));
  int num_opened = 0;
  while (g.gate.Open(StampAt(1.0)) != nullptr) ++num_opened;
  EXPECT_EQ(num_opened, 3);
  EXPECT_EQ(g.counters.num_scans_late, 1);
  EXPECT_EQ(g.counters.num_clock_jumps, 0);
}

TEST(ScanGate, TwoSweepsFarAheadAre) {
  Gate g;
  g.gate.Add(SweepEnding(0.1));
  EXPECT_NE(g.gate.Force(), nullptr);
  g.gate.Add(SweepEnding(3600.0));
  EXPECT_EQ(g.gate.Force(), nullptr);
  g.gate.Add(SweepEnding(3600.1));
  EXPECT_EQ(g.gate.Force()->end, StampAt(3600.0));
  EXPECT_EQ(g.gate.Force()->end, StampAt(3600.1));
  EXPECT_EQ(g.counters.num_scan_gaps, 1);
  EXPECT_EQ(g.counters.num_scans_late, 0);
}

TEST(ScanGate, FlushLetsInTheSweepThatIsHeld) {
  Gate g;
  g.gate.Add(SweepEnding(0.1));
  g.gate.Add(SweepEnding(5.0));
  g.gate.Flush();
  EXPECT_EQ(g.gate.Force()->end, StampAt(0.1));
  EXPECT_EQ(g.gate.Force()->end, StampAt(5.0));
}

TEST(ScanGate, NewSegmentInThePastForgetsTheFuture) {
  Gate g;
  g.gate.Add(SweepEnding(100.0));
  g.gate.StartSegment(StampAt(0.0));
  EXPECT_EQ(g.counters.num_scans_without_imu, 1);
  g.gate.Add(SweepEnding(0.2));
  EXPECT_EQ(g.gate.Open(StampAt(0.5))->end, StampAt(0.2));
  EXPECT_EQ(g.counters.num_scans_late, 0);
}

TEST(ScanGate, NewSegmentAheadKeepsWhatWaits) {
  Gate g;
  g.gate.Add(SweepEnding(100.0));
  g.gate.StartSegment(StampAt(100.0));
  EXPECT_FALSE(g.gate.empty());
}

TEST(ScanGate, NothingIsForcedOutOfAnEmptyGate) {
  Gate g;
  EXPECT_EQ(g.gate.Force(), nullptr);
  EXPECT_EQ(g.gate.waiting_span_s(), 0.0);
}

// The lidar's clock is far ahead for as long as it sends.
TEST(ScanGate, WhatWaitsInVainIsCountedAndDropped) {
  Gate g;
  for (int k = 1; k <= 600; ++k) {
    g.gate.Add(SweepEnding(37.0 + 0.1 * k));
    EXPECT_EQ(g.gate.Open(StampAt(0.1 * k)), nullptr);
    EXPECT_LT(g.gate.waiting_span_s(), 5.1);
  }
  EXPECT_EQ(g.counters.num_scans_without_imu, 549);
}

}  // namespace
}  // namespace lio
