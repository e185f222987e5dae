// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "pipeline/tracking_bench.hpp"

namespace lio {
namespace {

using test::ExactSample;
using test::kSpeed_mps;
using test::MapOfNextStep;
using test::Motion;
using test::SecondsOf;
using test::StampAt;
using test::StateOf;
using test::Straight;
using test::TrackingBench;
using test::TrueStart;
using test::XOf;

// The body goes eight metres a second on a winding road.
Motion Winding() {
  return [road = test::WindingDrive(0.0)](double t_s) { return road(t_s + 6.0); };
}

ScanOutput LastScan(TrackingBench& b) {
  return b.bench.Take<ScanOutput>().back();
}

TEST(Tracking, BeginsAtTheStartItIsGiven) {
  TrackingBench b(Straight(kSpeed_mps));
  EXPECT_EQ(b.mode.begin(), StampAt(0.0));
  EXPECT_EQ(b.mode.next_sweep(), 0U);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kOk);
}

TEST(Tracking, JobIsPredictedByTheSamples) {
  TrackingBench b(Winding());
  const MatchJob job = b.NextJob();
  const Pose truth = b.motion(SecondsOf(job.sweep->middle()));
  EXPECT_TRUE(std::holds_alternative<Track>(job.task));
  EXPECT_NEAR(LogSe3(truth.Inverse() * job.prior.T_map_imu).norm(), 0.0, 1e-3);
  EXPECT_EQ(job.T_any_imu.front().stamp, job.sweep->start);
  EXPECT_EQ(job.T_any_imu.back().stamp, job.sweep->end);
}

TEST(Tracking, OnlyTheFirstJobClearsTheMap) {
  TrackingBench b(Straight(kSpeed_mps));
  const MatchJob first = b.NextJob();
  EXPECT_EQ(first.map_action, MapAction::kClear);
  ASSERT_FALSE(b.Finish(b.bench.Matched(first, b.motion)));
  EXPECT_TRUE(b.insert.T_map_imu);
  EXPECT_EQ(b.NextJob().map_action, MapAction::kKeep);
}

// As after a restart: the drive before was in another map.
TEST(Tracking, TheFirstScanBeginsAMapOfTheRecordOfTheMotion) {
  TrackingBench b(Straight(kSpeed_mps));
  MotionRecord& record = b.bench.examiner.record();
  const int before = MapOfNextStep(record);
  ASSERT_FALSE(b.Match());
  const int first = MapOfNextStep(record);
  EXPECT_NE(first, before);
  ASSERT_FALSE(b.Match(2));
  EXPECT_EQ(MapOfNextStep(record), first);
}

TEST(Tracking, ScanThatIsMatchedLeavesTheQueue) {
  TrackingBench b(Straight(kSpeed_mps));
  const MatchJob job = b.NextJob();
  const SweepPtr next = b.bench.AddSweep(0.1);
  ASSERT_FALSE(b.Finish(b.bench.Matched(job, b.motion)));
  ASSERT_EQ(b.bench.sweeps.size(), 1U);
  EXPECT_EQ(b.bench.sweeps.front(), next);
}

TEST(Tracking, NothingIsPublishedAtTheRateOfTheImuBeforeTheFirstScan) {
  TrackingBench b(Straight(kSpeed_mps));
  b.FeedSweep();
  EXPECT_TRUE(b.bench.Take<NavOutput>().empty());
}

TEST(Tracking, PublishesOneStateASampleAfterTheFirstScan) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match());
  (void)b.bench.Take<NavOutput>();
  b.FeedSweep();
  const std::vector<NavOutput> states = b.bench.Take<NavOutput>();
  ASSERT_EQ(states.size(), 10U);  // samples at 100 Hz
  EXPECT_EQ(states.front().stamp, StampAt(0.11));
  EXPECT_EQ(states.back().stamp, StampAt(0.2));
  EXPECT_EQ(states.back().source, OdometrySource::kImuPropagated);
  EXPECT_EQ(states.back().scan_seq, 0);
  EXPECT_NEAR(states.back().T_world_imu.translation.x(), 0.2 * kSpeed_mps, 0.01);
}

TEST(Tracking, LateSampleIsNotPublished) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match(2));
  (void)b.bench.Take<NavOutput>();
  b.mode.AddImu({ExactSample(b.motion, 0.155)});
  EXPECT_TRUE(b.bench.Take<NavOutput>().empty());
}

TEST(Tracking, StatesOfAnEarlierModeAreNotPublishedAgain) {
  Handover handover;
  handover.last_published = StampAt(0.155);
  TrackingBench b(Straight(kSpeed_mps), Options{}, handover);
  ASSERT_FALSE(b.Match());
  b.FeedSweep();
  const std::vector<NavOutput> states = b.bench.Take<NavOutput>();
  ASSERT_EQ(states.size(), 5U);
  EXPECT_EQ(states.front().stamp, StampAt(0.16));
}

TEST(Tracking, MadeUpSamplesAreNotPublished) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match());
  (void)b.bench.Take<NavOutput>();
  b.mode.AddImu({.sample = ExactSample(b.motion, 0.15), .is_made_up = true});
  EXPECT_TRUE(b.bench.Take<NavOutput>().empty());
}

TEST(Tracking, ScansCorrectAWrongVelocity) {
  const Motion drive = Winding();
  StartState start = TrueStart(drive, 0.0);
  start.estimate.state.v_world_imu += Vector3(0.5, -0.3, 0.0);
  start.estimate.cov.diagonal().segment<3>(kVel).setConstant(0.25);
  TrackingBench b(drive, start);
  ASSERT_FALSE(b.Match(15));
  const ScanOutput scan = LastScan(b);
  const Vector3 truth_mps = StateOf(drive, SecondsOf(scan.scan.stamp)).v_world_imu;
  EXPECT_TRUE(scan.scan.fused);
  EXPECT_NEAR((scan.filter->nav.v_world_imu_mps - truth_mps).norm(), 0.0, 0.05);
  EXPECT_EQ(scan.filter->nav.scan_seq, 14);
}

// Three scans matched so far aside of the winding road, by matches that see these directions: which
// of them are fused?
std::vector<bool> FusedAside(double aside_m, unsigned degenerate_mask) {
  TrackingBench b(Winding());
  EXPECT_FALSE(b.Match(25));  // the IMU convention is beyond doubt by then
  std::vector<bool> fused;
  for (int i = 0; i < 3; ++i) {
    MatchOutcome aside = b.bench.Matched(b.NextJob(), b.motion);
    aside.match.T_map_imu.translation.y() += aside_m;
    aside.match.degenerate_mask = degenerate_mask;
    EXPECT_FALSE(b.Finish(aside));
    fused.push_back(LastScan(b).scan.fused);
  }
  EXPECT_EQ(b.bench.counters.num_gated, std::ranges::count(fused, false));
  return fused;
}

TEST(Tracking, ScanAsideOfThePredictionIsRefusedTwiceThenFused) {
  EXPECT_EQ(FusedAside(5.0, 0), std::vector<bool>({false, false, true}));
  EXPECT_EQ(FusedAside(0.14, 4), std::vector<bool>({false, false, true}));
}

TEST(Tracking, ScanFarAsideThatDoesNotSeeAllDirectionsIsRefused) {
  EXPECT_EQ(FusedAside(5.0, 4), std::vector<bool>({false, false, false}));
}

TEST(Tracking, RelocalizedScanIsFusedHoweverFarItIs) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match(10));
  MatchOutcome aside = b.bench.Matched(b.NextJob(), b.motion);
  aside.match.T_map_imu.translation.y() += 5.0;
  aside.is_relocalized = true;
  ASSERT_FALSE(b.Finish(aside));
  EXPECT_TRUE(LastScan(b).scan.fused);
}

TEST(Tracking, MovedScansGrowTheMapAndRestingOnesSoonDoNot) {
  TrackingBench moving(Straight(kSpeed_mps));
  ASSERT_FALSE(moving.Match(10));
  EXPECT_TRUE(moving.insert.T_map_imu);
  TrackingBench resting(Straight(0.0));
  ASSERT_FALSE(resting.Match(10));
  EXPECT_FALSE(resting.insert.T_map_imu);
}

// The filter cannot set its map pose to certain at a time that it does not hold.
TEST(Tracking, MapThatBeginsBeforeTheFilterIsCountedAsLate) {
  TrackingBench b(Straight(0.0));
  b.sweep_start_s = -0.1;
  ASSERT_FALSE(b.Match());
  EXPECT_EQ(b.bench.counters.num_scans_late, 1);
  EXPECT_TRUE(b.insert.T_map_imu);
  ASSERT_FALSE(b.Match(5));
  EXPECT_EQ(b.bench.counters.num_scans_late, 1);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kOk);
}

TEST(Tracking, MapGoesOnFromThePredictionAfterTenUnmatchedScans) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match(5));
  ASSERT_FALSE(b.Miss(10));
  EXPECT_FALSE(b.insert.T_map_imu);
  ASSERT_FALSE(b.Miss());
  ASSERT_TRUE(b.insert.T_map_imu);
  EXPECT_NEAR(b.insert.T_map_imu->translation.x(), 1.55 * kSpeed_mps, 0.1);
}

TEST(Tracking, CoastsAndIsLostAfterTwoSecondsWithoutAMatch) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match(5));
  ASSERT_FALSE(b.Miss(19));
  EXPECT_EQ(b.mode.status(), TrackingStatus::kCoasting);
  EXPECT_FALSE(b.bench.HasNotified(Notice::Severity::kWarning));
  ASSERT_FALSE(b.Miss(2));
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
}

TEST(Tracking, TwentyFiveUnmatchedScansInARowEndTheMode) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match(5));
  ASSERT_FALSE(b.Miss(24));
  const auto transition = b.Miss();
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kLost);
  const Handover& handover = transition->handover;
  EXPECT_EQ(handover.origin, Handover::Origin::kInertial);
  EXPECT_EQ(handover.last_fix.stamp, StampAt(0.45));  // the middle of the last matched sweep
  EXPECT_NEAR(handover.last_fix.T_world_imu.translation.x(), 0.45 * kSpeed_mps, 0.05);
  EXPECT_EQ(handover.last_seq, 4);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
}

// The IMU went on, but not so well that matching finds the map from what it says.
TEST(Tracking, AfterHalfAMinuteWithoutScansThePlaceIsSoughtAndThenANewMapBegins) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match(5));
  b.FeedImu(30.0);
  b.sweep_start_s = 30.0;
  ASSERT_FALSE(b.Miss());
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
  for (int i = 0; i < kOutage.max_scans_sought; ++i) {
    const MatchJob job = b.NextJob();
    ASSERT_TRUE(std::holds_alternative<Relocalize>(job.task)) << i;
    EXPECT_EQ(std::get<Relocalize>(job.task).search.region, SearchRegion::kObservable);
    EXPECT_NEAR(XOf(job), (b.sweep_start_s - 0.05) * kSpeed_mps, 20.0);
    ASSERT_FALSE(b.Finish(b.bench.Unmatched(job)));
  }
  const MatchJob job = b.NextJob();
  EXPECT_TRUE(std::holds_alternative<FindVelocity>(job.task));
  EXPECT_EQ(job.map_action, MapAction::kClear);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
}

TEST(Tracking, MatchInBetweenBeginsTheCountOfUnmatchedScansAnew) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match(5));
  ASSERT_FALSE(b.Miss(9));
  ASSERT_FALSE(b.Match());
  EXPECT_FALSE(b.Miss(24));
}

TEST(Tracking, ScansOfFewPointsDoNotEndTheMode) {
  TrackingBench b(Straight(kSpeed_mps));
  ASSERT_FALSE(b.Match(5));
  for (int i = 0; i < 30; ++i) {
    MatchOutcome outcome = b.bench.Unmatched(b.NextJob());
    outcome.num_used = kHealth.min_points - 1;
    ASSERT_FALSE(b.Finish(outcome)) << i;
  }
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
}

TEST(Tracking, StandstillIsFusedAsZeroVelocity) {
  TrackingBench b(Straight(0.0), Options{}, Handover{}, true);
  ASSERT_FALSE(b.Match(20));
  EXPECT_GT(b.bench.counters.num_standstills, 0);
}

TEST(Tracking, StandstillIsNotFusedWhereThatIsSwitchedOff) {
  Options options;
  options.filter.use_zero_velocity = false;
  TrackingBench b(Straight(0.0), options, Handover{}, true);
  ASSERT_FALSE(b.Match(20));
  EXPECT_EQ(b.bench.counters.num_standstills, 0);
}

TEST(Tracking, RatesOfAnotherUnitThanBelievedEndTheMode) {
  TrackingBench b(Winding());
  b.bench.rate_scale = 180.0 / std::numbers::pi;
  const auto transition = b.Match(25);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kConventionDoubted);
  EXPECT_EQ(transition->handover.origin, Handover::Origin::kInertial);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
}

TEST(Tracking, RightSamplesAreNotDoubted) {
  TrackingBench b(Winding());
  EXPECT_FALSE(b.Match(25));
}

TEST(Tracking, ASampleFromBeforeItsHistoryIsCountedAsLate) {
  Options options;
  options.filter.history_s = 0.5;
  TrackingBench track(Winding(), options);
  ASSERT_FALSE(track.Match(12));
  track.mode.AddImu({test::ExactSample(Winding(), 0.205)});
  EXPECT_EQ(track.bench.counters.num_imu_late, 1);
}

TEST(Tracking, WithoutTheImuItHandsOverWhatTheFilterKnew) {
  TrackingBench b(Winding());
  ASSERT_FALSE(b.Match(15));
  ImuAbsent absent{StampAt(1.5), "no samples", StampAt(1.4)};
  absent.w_imu_radps = Vector3(0, 0, 0.3);
  const Transition transition = b.mode.TakeImuAbsent(absent);
  EXPECT_EQ(transition.trigger, Trigger::kImuAbsent);
  EXPECT_TRUE(transition.handover.keeps_map);
  ASSERT_TRUE(transition.start);
  EXPECT_EQ(transition.start->estimate.stamp, StampAt(1.4));
  EXPECT_LT(transition.start->g_world.z(), -9.0);
  const Pose truth = b.motion(1.4);
  EXPECT_NEAR(LogSe3(truth.Inverse() * transition.start->estimate.state.T_world_imu).norm(), 0.0,
              0.05);
  ASSERT_TRUE(transition.seed.motion);
  EXPECT_NEAR(transition.seed.motion->gyro_bias.z(), -0.3, 0.01);  // the turn rate, negative
}

TEST(Tracking, WithoutAMapThereIsNothingToGoOnIn) {
  TrackingBench b(Straight(kSpeed_mps));
  const Transition transition = b.mode.TakeImuAbsent({StampAt(0.2), "no samples", StampAt(0.1)});
  EXPECT_FALSE(transition.handover.keeps_map);
  EXPECT_FALSE(transition.start);
}

TEST(Tracking, MapThatIsKeptIsNotCleared) {
  Handover handover;
  handover.keeps_map = true;
  TrackingBench b(Straight(kSpeed_mps), Options{}, handover);
  EXPECT_EQ(b.NextJob().map_action, MapAction::kKeep);
}

}  // namespace
}  // namespace lio
