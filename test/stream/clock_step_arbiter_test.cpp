// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/stream/clock_step_arbiter.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;

ClockStep StepBy(double step_s) {
  return {StampAt(9.995), StampAt(10.005 + step_s)};
}

// Returns sweeps of 0.1 s until a step at 10 s, which arrive when they are complete and `late_s`
// more have passed.
ClockStepArbiter SweepsBefore(double late_s, double until_s = 10.0) {
  ClockStepArbiter watch;
  for (double start_s = 8.85; start_s + 0.1 + late_s < until_s; start_s += 0.1) {
    watch.Note(StampAt(start_s), StampAt(std::min(start_s + 0.1 + late_s, 9.995)));
  }
  return watch;
}

// Returns the first sweep after a step of the IMU's clock, which began at `start_s` by the old
// time.
LidarClock Judge(const ClockStepArbiter& watch, double step_s, double start_s, bool has_stepped,
                 double late_s) {
  return watch
      .Judge(StepBy(step_s), StampAt(has_stepped ? start_s + step_s : start_s),
             StampAt(start_s + 0.1 + late_s + step_s))
      .lidar;
}

TEST(ClockStepArbiter, SweepsThatGoOnTellThatTheLidarDidNotStep) {
  for (const double step_s : {-3.0, -0.5, -0.15, 0.25, 1.5}) {
    for (const double late_s : {0.0, 0.3}) {
      EXPECT_EQ(Judge(SweepsBefore(late_s), step_s, 10.05, false, late_s), LidarClock::kSteady)
          << step_s;
    }
  }
}

TEST(ClockStepArbiter, SweepsThatStepAlongAreSeen) {
  for (const double step_s : {-3.0, -0.5, -0.15, 0.25, 1.5, 20.0}) {
    for (const double late_s : {0.0, 0.3}) {
      EXPECT_EQ(Judge(SweepsBefore(late_s), step_s, 10.05, true, late_s), LidarClock::kStepped)
          << step_s;
    }
  }
}

TEST(ClockStepArbiter, LidarMayStepAMessageEarlier) {
  for (const double step_s : {-3.0, -0.5, 0.4, 1.5}) {
    ClockStepArbiter watch = SweepsBefore(0.0);
    watch.Note(StampAt(9.95 + step_s), StampAt(9.995));
    EXPECT_EQ(Judge(watch, step_s, 10.05, true, 0.0), LidarClock::kStepped) << step_s;
    EXPECT_FALSE(watch.HasTimePassed(StepBy(step_s))) << step_s;
  }
}

TEST(ClockStepArbiter, SweepThatBeganBeforeTheStepTellsNothing) {
  for (const double step_s : {-3.0, -0.5, 1.5}) {
    for (const double start_s : {9.98, 10.0}) {
      EXPECT_EQ(Judge(SweepsBefore(0.0), step_s, start_s, false, 0.0), LidarClock::kUnclear)
          << step_s;
    }
  }
}

TEST(ClockStepArbiter, SweepsThatCameMeanwhileTellOfAGap) {
  EXPECT_TRUE(SweepsBefore(0.0, 10.4).HasTimePassed(StepBy(0.4)));
  EXPECT_FALSE(SweepsBefore(0.0).HasTimePassed(StepBy(0.4)));
  EXPECT_FALSE(ClockStepArbiter().HasTimePassed(StepBy(0.4)));
}

}  // namespace
}  // namespace lio
