// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/handover.hpp"

#include <gtest/gtest.h>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

TEST(Handover, AClockThatWasSetMovesWhenTheVehicleWasLocated) {
  for (const double by_s : {100.0, -100.0}) {
    Handover handover;
    handover.last_fused = StampAt(1.0);
    handover.last_located = StampAt(2.0);
    handover.last_fix.stamp = StampAt(3.0);
    handover.imu_doubt.emplace().last = StampAt(4.0);
    handover.ShiftTimesBy(Duration::FromSeconds(by_s));
    EXPECT_EQ(handover.last_fused, StampAt(1.0 + by_s));
    EXPECT_EQ(handover.last_located, StampAt(2.0 + by_s));
    EXPECT_EQ(handover.last_fix.stamp, StampAt(3.0 + by_s));
    EXPECT_EQ(handover.imu_doubt->last, StampAt(4.0 + by_s));
  }
}

TEST(Handover, AClockThatWasSetMakesUpNoTimes) {
  Handover handover;
  handover.ShiftTimesBy(Duration::FromSeconds(5.0));
  EXPECT_FALSE(handover.last_fused);
  EXPECT_FALSE(handover.last_located);
}

TEST(Handover, WhatWasPublishedKeepsItsStamp) {
  Handover handover;
  handover.last_published = StampAt(1.0);
  handover.last_fix.T_world_imu.translation = Vector3(1, 2, 3);
  handover.ShiftTimesBy(Duration::FromSeconds(5.0));
  EXPECT_EQ(handover.last_published, StampAt(1.0));
  EXPECT_EQ(handover.last_fix.T_world_imu.translation, Vector3(1, 2, 3));
}

}  // namespace
}  // namespace lio
