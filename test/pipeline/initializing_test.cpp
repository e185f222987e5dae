// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/initializing.hpp"

#include <gtest/gtest.h>

#include "pipeline/initializing_bench.hpp"

namespace lio {
namespace {

using test::InitializingBench;
using test::kSpeed_mps;
using test::StampAt;
using test::Straight;
using test::WithoutImu;

using Step = ImuPreprocessor::Step;
using Origin = Handover::Origin;

bool IsTrack(const MatchJob& job) {
  return std::holds_alternative<Track>(job.task);
}
bool IsVelocitySearch(const MatchJob& job) {
  return std::holds_alternative<FindVelocity>(job.task);
}

// Shift of the imu over the sweep by which a job deskews it.
double DeskewShift_m(const MatchJob& job) {
  return (job.T_any_imu.back().pose.translation - job.T_any_imu.front().pose.translation).norm();
}

// Without an IMU; the velocity has been searched for in the first sweep.
struct AfterVelocitySearch : InitializingBench {
  explicit AfterVelocitySearch(double speed_mps) : InitializingBench(WithoutImu()) {
    InsertTask insert;
    const MatchJob search = mode->MakeJob(bench.AddSweep(0.0));
    EXPECT_FALSE(mode->FinishJob(bench.Matched(search, Straight(speed_mps)), insert));
  }
};

TEST(Initializing, FirstJobIsASearchForTheVelocityInAClearedMap) {
  InitializingBench b(WithoutImu());
  const MatchJob job = b.mode->MakeJob(b.bench.AddSweep(0.0));
  EXPECT_TRUE(IsVelocitySearch(job));
  EXPECT_EQ(job.map_action, MapAction::kClear);
  EXPECT_EQ(b.mode->status(), TrackingStatus::kInit);
}

TEST(Initializing, SearchForTheVelocityGrowsNoMap) {
  InitializingBench b(WithoutImu());
  const MatchJob job = b.mode->MakeJob(b.bench.AddSweep(0.0));
  InsertTask insert;
  ASSERT_FALSE(b.mode->FinishJob(b.bench.Matched(job, Straight(kSpeed_mps)), insert));
  EXPECT_FALSE(insert.T_map_imu);
}

TEST(Initializing, SearchGoesOnWithTheNextSweepWhileNoVelocityIsClear) {
  InitializingBench b(WithoutImu());
  InsertTask insert;
  const MatchJob first = b.mode->MakeJob(b.bench.AddSweep(0.0));
  ASSERT_FALSE(b.mode->FinishJob(b.bench.Unmatched(first), insert));
  EXPECT_EQ(b.mode->next_sweep(), 1U);
  const MatchJob second = b.mode->MakeJob(b.bench.AddSweep(0.1));
  EXPECT_TRUE(IsVelocitySearch(second));
  EXPECT_EQ(second.map_action, MapAction::kKeep);
}

TEST(Initializing, SearchForTheVelocityEndsAfterEightSweeps) {
  InitializingBench b(WithoutImu());
  InsertTask insert;
  for (int i = 0; i < 8; ++i) {
    const MatchJob job = b.mode->MakeJob(b.bench.AddSweep(0.1 * i));
    ASSERT_TRUE(IsVelocitySearch(job)) << i;
    ASSERT_FALSE(b.mode->FinishJob(b.bench.Unmatched(job), insert));
  }
  ASSERT_EQ(b.mode->next_sweep(), 0U);
  const MatchJob job = b.mode->MakeJob(b.bench.sweeps.front());
  EXPECT_TRUE(IsTrack(job));
  EXPECT_LT(DeskewShift_m(job), 1e-9);  // from rest
}

TEST(Initializing, TracksFromTheFirstSweepOnOnceTheVelocityIsFound) {
  AfterVelocitySearch b(kSpeed_mps);
  ASSERT_EQ(b.mode->next_sweep(), 0U);
  const MatchJob job = b.mode->MakeJob(b.bench.sweeps.front());
  EXPECT_TRUE(IsTrack(job));
  EXPECT_EQ(job.map_action, MapAction::kClear);
  EXPECT_TRUE(job.refines_deskew);
  // The seed's velocity holds from the sweep's middle on, where the track begins.
  EXPECT_NEAR(DeskewShift_m(job), 0.05 * kSpeed_mps, 1e-6);
}

TEST(Initializing, ClearsTheMapForTheFirstScanOfATrackOnly) {
  AfterVelocitySearch b(0.0);
  InsertTask insert;
  const MatchJob first = b.mode->MakeJob(b.bench.sweeps.front());
  ASSERT_FALSE(b.mode->FinishJob(b.bench.Matched(first, Straight(0.0)), insert));
  EXPECT_TRUE(insert.T_map_imu);
  const MatchJob second = b.mode->MakeJob(b.bench.AddSweep(0.1));
  EXPECT_EQ(second.map_action, MapAction::kKeep);
  EXPECT_TRUE(std::get<Track>(second.task).holds_degenerate);
}

TEST(Initializing, ScanOfAnUnsurePlaceDoesNotGrowTheMap) {
  AfterVelocitySearch b(0.0);
  InsertTask first, second;
  const MatchJob job = b.mode->MakeJob(b.bench.sweeps.front());
  ASSERT_FALSE(b.mode->FinishJob(b.bench.Matched(job, Straight(0.0)), first));
  // Half a second later the velocity, unsure by 1.5 m/s, leaves 0.75 m.
  const MatchJob later = b.mode->MakeJob(b.bench.AddSweep(0.5));
  ASSERT_FALSE(b.mode->FinishJob(b.bench.Unmatched(later), second));
  EXPECT_TRUE(first.T_map_imu);
  EXPECT_FALSE(second.T_map_imu);
}

TEST(Initializing, MatchesAnewWithTheMotionOnceItIsKnown) {
  InitializingBench b;
  ASSERT_FALSE(b.Drive(Straight(kSpeed_mps), 0.0, 0.3));
  EXPECT_EQ(b.mode->next_sweep(), 3U);
  b.bench.FeedImu(Straight(kSpeed_mps), 0.3, 0.4);
  const MatchJob fourth = b.mode->MakeJob(b.bench.AddSweep(0.3));
  InsertTask insert;
  ASSERT_FALSE(b.mode->FinishJob(b.bench.Matched(fourth, Straight(kSpeed_mps)), insert));
  ASSERT_EQ(b.mode->next_sweep(), 0U);
  const MatchJob anew = b.mode->MakeJob(b.bench.sweeps.front());
  EXPECT_TRUE(IsTrack(anew));
  EXPECT_EQ(anew.map_action, MapAction::kClear);
  // Now the track begins with the sweep, and its whole span is deskewed.
  EXPECT_NEAR(DeskewShift_m(anew), 0.1 * kSpeed_mps, 0.02);
}

TEST(Initializing, WithoutAnImuTheMotionStartsLidarOnly) {
  InitializingBench b(WithoutImu());
  const auto transition = b.Drive(Straight(kSpeed_mps), 0.0, 2.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kNoImu);
  EXPECT_EQ(b.bench.sweeps.size(), 4U);  // no more were needed
  ASSERT_TRUE(transition->seed.motion);
  const Vector3& v_mps = transition->seed.motion->v_world_imu;
  EXPECT_NEAR((v_mps - Vector3(kSpeed_mps, 0, 0)).norm(), 0.0, 0.1);
}

TEST(Initializing, WithoutAnImuNothingStartsThatBuildingsContradict) {
  InitializingBench b(WithoutImu());
  b.speed_by_buildings = {2.0 * kSpeed_mps, 3.0 * kSpeed_mps};
  const auto transition = b.Drive(Straight(kSpeed_mps), 0.0, 2.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kRetry);
  EXPECT_TRUE(transition->handover.in_traffic);
}

TEST(Initializing, WithoutAnImuAtRestLidarOnlyBeginsAfterEightScans) {
  InitializingBench b(WithoutImu());
  const auto transition = b.Drive(Straight(0.0), 0.0, 2.0);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kNoImu);
  EXPECT_FALSE(transition->seed.motion);
  EXPECT_EQ(b.bench.sweeps.size(), 8U);
}

TEST(Initializing, EndOfTheStreamStartsLidarOnlyWithWhatIsKnown) {
  InitializingBench b(WithoutImu());
  ASSERT_FALSE(b.Drive(Straight(0.0), 0.0, 0.3));
  EXPECT_FALSE(b.mode->EndStream());  // more may come
  b.bench.stream().Flush();
  const auto transition = b.mode->EndStream();
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kNoImu);
}

TEST(Initializing, EndOfTheStreamStartsNothingWhereThereIsAnImu) {
  InitializingBench b;
  ASSERT_FALSE(b.Drive(Straight(0.0), 0.0, 0.3));
  b.bench.stream().Flush();
  EXPECT_FALSE(b.mode->EndStream());
}

TEST(Initializing, NewSegmentBeginsAgainWithoutTheSweepsBeforeIt) {
  InitializingBench b;
  ASSERT_FALSE(b.Drive(Straight(0.0), 0.0, 0.5));
  ImuSample first;
  first.stamp = StampAt(5.0);
  const Transition transition = b.mode->StartSegment({first, Step::kGap, StampAt(0.5)});
  EXPECT_EQ(transition.trigger, Trigger::kSegmentStarts);
  EXPECT_FALSE(transition.initializing_since);
  EXPECT_TRUE(b.bench.sweeps.empty());
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
}

// The last fix was a second before the end of the samples.
Timestamp LastFixAfterASegment(Step step) {
  Handover handover;
  handover.last_fix.stamp = StampAt(9.0);
  InitializingBench b({}, handover);
  ImuSample first;
  first.stamp = StampAt(4.0);
  return b.mode->StartSegment({first, step, StampAt(10.0)}).handover.last_fix.stamp;
}

TEST(Initializing, ClockSetBackMovesTheLastFixWithIt) {
  EXPECT_EQ(LastFixAfterASegment(Step::kSetBack), StampAt(3.0));
}

TEST(Initializing, GapLeavesTheLastFixWhereItWas) {
  EXPECT_EQ(LastFixAfterASegment(Step::kGap), StampAt(9.0));
}

TEST(Initializing, ImuThatAppearsBeginsAgainInTheWorldThatIsKnown) {
  Handover handover;
  handover.origin = Origin::kLostLidar;
  handover.last_fix.T_world_imu.translation = Vector3(1, 2, 3);
  InitializingBench b(WithoutImu(), handover);
  const Transition transition = b.mode->TakeImu({StampAt(1.0)});
  EXPECT_EQ(transition.trigger, Trigger::kImuAppeared);
  EXPECT_EQ(transition.handover.origin, Origin::kLidar);
  EXPECT_TRUE(transition.handover.is_map_by_lidar);
  EXPECT_EQ(transition.handover.last_fix.T_world_imu.translation, Vector3(1, 2, 3));
}

TEST(Initializing, ImuThatAppearsBeforeAnythingWasPublishedHasNoWorldToGoOnIn) {
  InitializingBench b(WithoutImu());
  const Transition transition = b.mode->TakeImu({StampAt(1.0)});
  EXPECT_EQ(transition.handover.origin, Origin::kNone);
  EXPECT_FALSE(transition.handover.is_map_by_lidar);
}

TEST(Initializing, ClockStepInDoubtIsHandedOver) {
  InitializingBench b;
  b.mode->TakeClockStep({{StampAt(0.5), StampAt(0.9)}});
  ImuSample first;
  first.stamp = StampAt(5.0);
  const Transition transition = b.mode->StartSegment({first, Step::kGap, StampAt(0.9)});
  const std::optional<ClockStep> step = transition.handover.clock_step.stamps();
  ASSERT_TRUE(step);
  EXPECT_EQ(step->after, StampAt(0.9));
}

}  // namespace
}  // namespace lio
