// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests gaps of the inertial stream and steps of its clock, while tracking.
#include <gtest/gtest.h>

#include "pipeline/tracking.hpp"
#include "pipeline/tracking_bench.hpp"

namespace lio {
namespace {

using test::kImuStep_s;
using test::kSpeed_mps;
using test::Motion;
using test::StampAt;
using test::StdOf;
using test::Straight;
using test::XOf;

using Step = ImuPreprocessor::Step;

// Drives straight ahead; one second of it is tracked, then a clock steps.
struct StepAfterOneSecond : test::AfterOneSecond {
  // The clock now says so at the end of that second.
  void SetClock(double now_s, Step step) {
    motion = [before = motion, by_s = now_s - 1.0](double t_s) { return before(t_s - by_s); };
    StartSegment(now_s, step);
  }
  // Stamps went forth by 0.4 s.
  void StepForthInDoubt() {
    mode.TakeClockStep({{StampAt(1.0), StampAt(1.4)}});
    GoOnAt(1.4);
  }
};

// Is the scan sought anywhere but at its prior?
bool IsSought(const MatchJob& job) {
  const auto* task = std::get_if<Relocalize>(&job.task);
  return task != nullptr && task->search.region != SearchRegion::kTracked;
}

TEST(TrackingSegment, StateGoesOnAlongItsVelocityOverAGap) {
  StepAfterOneSecond b;
  b.StartSegment(3.0, Step::kGap);
  EXPECT_EQ(b.mode.begin(), StampAt(3.0));
  EXPECT_NEAR(XOf(b.NextJob()), 3.05 * kSpeed_mps, 0.2);
}

TEST(TrackingSegment, PositionAfterAGapIsUnsureByMetres) {
  StepAfterOneSecond b;
  const double before_m = StdOf(b.NextJob());
  b.StartSegment(3.0, Step::kGap);
  const double after_m = StdOf(b.NextJob());
  EXPECT_LT(before_m, 0.1);
  EXPECT_GT(after_m, 2.0);
}

TEST(TrackingSegment, StateStaysWhereItWasWhenTheClockWasSetBack) {
  StepAfterOneSecond b;
  b.SetClock(-1.5, Step::kSetBack);
  EXPECT_EQ(b.mode.begin(), StampAt(-1.5));
  const MatchJob job = b.NextJob();
  EXPECT_NEAR(XOf(job), 1.05 * kSpeed_mps, 0.05);
  EXPECT_GT(StdOf(job), 0.02);  // a tenth of a second may be missing
  EXPECT_LT(StdOf(job), 1.0);
}

TEST(TrackingSegment, TimesThatAreRememberedMoveWithTheClock) {
  StepAfterOneSecond b;
  b.SetClock(7.0, Step::kSetRight);
  const MatchJob job = b.NextJob();
  // From the middle of the last sweep, with a tenth of a second that may be missing.
  EXPECT_NEAR(job.prior.since_last_fix_s, 0.2, 1e-6);
  ASSERT_FALSE(b.Finish(b.bench.Unmatched(job)));
  EXPECT_EQ(b.mode.status(), TrackingStatus::kCoasting);  // not lost for six seconds
}

TEST(TrackingSegment, SweepsBeforeItAreDroppedWithANotice) {
  StepAfterOneSecond b;
  b.FeedSweep();
  b.StartSegment(3.0, Step::kGap);
  EXPECT_TRUE(b.bench.sweeps.empty());
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
}

TEST(TrackingSegment, StatesArePublishedByAClockThatWasSetBack) {
  StepAfterOneSecond b;
  b.SetClock(-1.5, Step::kSetBack);
  (void)b.bench.Take<NavOutput>();
  b.imu_from_s += kImuStep_s;
  b.FeedSweep();
  const std::vector<NavOutput> states = b.bench.Take<NavOutput>();
  ASSERT_EQ(states.size(), 10U);
  EXPECT_EQ(states.front().stamp, StampAt(-1.49));
}

TEST(TrackingSegment, MapIsKeptOverAGap) {
  StepAfterOneSecond b;
  b.StartSegment(3.0, Step::kGap);
  EXPECT_EQ(b.NextJob().map_action, MapAction::kKeep);
}

TEST(TrackingSegment, AfterAGapTheScanIsSoughtWhereItWasBeforeAsWell) {
  StepAfterOneSecond b;
  b.StartSegment(3.0, Step::kGap);
  const MatchJob job = b.NextJob();
  const auto* task = std::get_if<Relocalize>(&job.task);
  ASSERT_NE(task, nullptr);
  EXPECT_EQ(task->search.region, SearchRegion::kObservable);
  ASSERT_TRUE(task->search.T_map_imu_alternative);
  EXPECT_NEAR(task->search.T_map_imu_alternative->translation.x(), 1.05 * kSpeed_mps, 0.1);
}

TEST(TrackingSegment, ClockThatWasSetBackLeavesNoDoubt) {
  StepAfterOneSecond b;
  b.SetClock(-1.5, Step::kSetBack);
  EXPECT_FALSE(IsSought(b.NextJob()));
}

TEST(TrackingSegment, AmbiguousClockStepGivesTheNextJobTheAlternative) {
  StepAfterOneSecond b;
  b.StepForthInDoubt();
  const MatchJob job = b.NextJob();
  const auto* task = std::get_if<Relocalize>(&job.task);
  ASSERT_NE(task, nullptr);
  EXPECT_NEAR(XOf(job), 1.45 * kSpeed_mps, 0.1);  // if time has passed
  ASSERT_TRUE(task->search.T_map_imu_alternative);
  EXPECT_NEAR(task->search.T_map_imu_alternative->translation.x(), 1.05 * kSpeed_mps, 0.1);
}

TEST(TrackingSegment, SweepBeforeAnAmbiguousClockStepIsTracked) {
  StepAfterOneSecond b;
  b.mode.TakeClockStep({{StampAt(1.2), StampAt(1.6)}});
  EXPECT_FALSE(IsSought(b.NextJob()));
}

TEST(TrackingSegment, ScanAtTheAlternativeSettlesThatTheClockWasSet) {
  StepAfterOneSecond b;
  b.StepForthInDoubt();
  b.motion = [](double t_s) { return Straight(kSpeed_mps)(t_s - 0.4); };
  MatchOutcome outcome = b.bench.Matched(b.NextJob(), b.motion);
  outcome.is_relocalized = true;
  outcome.is_clock_set = true;
  ASSERT_FALSE(b.Finish(outcome));
  EXPECT_EQ(b.bench.counters.num_clock_jumps, 1);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
  const MatchJob next = b.NextJob();
  EXPECT_FALSE(IsSought(next));
  EXPECT_NEAR(XOf(next), 1.15 * kSpeed_mps, 0.1);
}

TEST(TrackingSegment, ScanAtThePredictionSettlesThatTimeHasPassed) {
  StepAfterOneSecond b;
  b.StepForthInDoubt();
  ASSERT_FALSE(b.Match());
  EXPECT_EQ(b.bench.counters.num_clock_jumps, 0);
  EXPECT_FALSE(IsSought(b.NextJob()));
}

TEST(TrackingSegment, UnmatchedScanSettlesNothing) {
  StepAfterOneSecond b;
  b.StepForthInDoubt();
  ASSERT_FALSE(b.Miss());
  const MatchJob job = b.NextJob();
  const auto* task = std::get_if<Relocalize>(&job.task);
  ASSERT_NE(task, nullptr);
  EXPECT_TRUE(task->search.T_map_imu_alternative);
}

TEST(TrackingSegment, UnseenForTwoSecondsItIsLostUntilAScanMatches) {
  StepAfterOneSecond b;
  b.StartSegment(2.5, Step::kGap);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kCoasting);
  b.StartSegment(5.0, Step::kGap);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
  ASSERT_FALSE(b.Match());
  EXPECT_EQ(b.mode.status(), TrackingStatus::kOk);
}

}  // namespace
}  // namespace lio
