// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/lidar_only.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/gravity_check.hpp"
#include "pipeline/mode_bench.hpp"
#include "pipeline/outage.hpp"

namespace lio {
namespace {

using test::kSpeed_mps;
using test::kSweepSpan_s;
using test::ModeBench;
using test::Motion;
using test::SecondsOf;
using test::StampAt;
using test::Straight;
using test::WithoutImu;

using Origin = Handover::Origin;

// A motion that was known before: straight ahead, without turning.
MotionSeed Ahead(double speed_mps) {
  NavState motion;
  motion.v_world_imu = Vector3(speed_mps, 0, 0);
  return {std::nullopt, motion};
}

// Runs the mode along a straight road, from second 0.
struct LidarOnlyBench {
  explicit LidarOnlyBench(double speed_mps = kSpeed_mps, Handover handover = {},
                          std::optional<StartState> inertial = std::nullopt)
      : motion(Straight(speed_mps)),
        bench(inertial ? Options{} : WithoutImu()),
        mode(bench.context(), std::move(handover), Ahead(speed_mps), std::move(inertial)) {}

  MatchJob NextJob() {
    const SweepPtr sweep = bench.AddSweep(sweep_start_s);
    sweep_start_s += kSweepSpan_s;
    return mode.MakeJob(sweep);
  }
  std::optional<Transition> Finish(const MatchOutcome& outcome) {
    insert = {};
    return mode.FinishJob(outcome, insert);
  }
  std::optional<Transition> Match() { return Finish(bench.Matched(NextJob(), motion)); }
  std::optional<Transition> Miss() { return Finish(bench.Unmatched(NextJob())); }
  // These run so many scans, or end with the first transition.
  std::optional<Transition> Match(int num_scans) {
    for (int i = 0; i < num_scans; ++i) {
      if (auto transition = Match()) return transition;
    }
    return std::nullopt;
  }
  std::optional<Transition> Miss(int num_scans) {
    for (int i = 0; i < num_scans; ++i) {
      if (auto transition = Miss()) return transition;
    }
    return std::nullopt;
  }

  Motion motion;
  ModeBench bench;
  LidarOnly mode;
  InsertTask insert;
  double sweep_start_s = 0.0;
};

// The way was lost a second before second 0, ten metres ahead and in a slow turn to the left.
Handover LostASecondAgo() {
  Handover handover;
  handover.origin = Origin::kLostLidar;
  handover.last_fix.stamp = StampAt(-1.0);
  handover.last_fix.T_world_imu.translation = Vector3(10, 0, 0);
  handover.last_fix.v_world_imu = Vector3(kSpeed_mps, 0, 0);
  handover.w_imu_radps = Vector3(0, 0, 0.2);
  handover.pose_cov = 0.04 * Matrix6::Identity();
  return handover;
}

TEST(LidarOnly, MapIsClearedThenWarmedUpForTenScans) {
  LidarOnlyBench b;
  std::vector<MapAction> actions;
  for (int i = 0; i < 12; ++i) {
    const MatchJob job = b.NextJob();
    actions.push_back(job.map_action);
    ASSERT_FALSE(b.Finish(b.bench.Matched(job, b.motion)));
  }
  std::vector<MapAction> expected(12, MapAction::kWarmUp);
  expected[0] = MapAction::kClear;
  expected[10] = expected[11] = MapAction::kKeep;
  EXPECT_EQ(actions, expected);
}

TEST(LidarOnly, FirstSweepIsPredictedByTheMotionItBeginsWith) {
  LidarOnlyBench b;
  const MatchJob job = b.NextJob();
  EXPECT_NEAR(job.prior.T_map_imu.translation.x(), 0.05 * kSpeed_mps, 1e-6);
  EXPECT_TRUE(job.refines_deskew);
}

TEST(LidarOnly, SearchesAnywhereOnceAScanIsLocated) {
  LidarOnlyBench b;
  const MatchJob first = b.NextJob();
  EXPECT_TRUE(std::holds_alternative<Track>(first.task));
  ASSERT_FALSE(b.Finish(b.bench.Matched(first, b.motion)));
  const MatchJob second = b.NextJob();
  const auto* task = std::get_if<Relocalize>(&second.task);
  ASSERT_NE(task, nullptr);
  EXPECT_EQ(task->search.region, SearchRegion::kAnywhere);
  EXPECT_FALSE(task->search.T_map_imu_alternative);
  EXPECT_TRUE(task->track.holds_degenerate);
}

TEST(LidarOnly, FollowsTheMatchedPosesAndPublishesEachScan) {
  LidarOnlyBench b;
  ASSERT_FALSE(b.Match(20));
  const std::vector<ScanOutput> scans = b.bench.Take<ScanOutput>();
  ASSERT_EQ(scans.size(), 20U);
  const FilterReport& last = *scans.back().filter;
  EXPECT_EQ(last.nav.stamp, StampAt(2.0));
  EXPECT_EQ(last.nav.status, TrackingStatus::kOk);
  EXPECT_EQ(last.nav.scan_seq, 19);
  EXPECT_NEAR(last.nav.T_world_imu.translation.x(), 2.0 * kSpeed_mps, 0.05);
  EXPECT_NEAR(last.nav.v_world_imu_mps.x(), kSpeed_mps, 0.1);
  EXPECT_TRUE(scans.back().scan.fused);
  EXPECT_TRUE(b.bench.sweeps.empty());
}

// A match that sees nothing along the road ends wherever its guess was.
TEST(LidarOnly, PriorDoesNotDependOnWhereABlindMatchEnded) {
  const auto prior_after_match_at = [](double ahead_m) {
    LidarOnlyBench b;
    EXPECT_FALSE(b.Match(10));
    const MatchJob job = b.NextJob();
    MatchOutcome outcome = b.bench.Matched(job, b.motion);
    outcome.match.T_map_imu = job.prior.T_map_imu * ExpSe3(ahead_m * Vector6::Unit(0));
    outcome.match.cov(0, 0) = 1e4;
    outcome.match.status = MatchStatus::kDegenerate;
    outcome.match.degenerate_mask = 1u;
    EXPECT_FALSE(b.Finish(outcome));
    EXPECT_TRUE(b.bench.Take<ScanOutput>().back().scan.fused);
    return b.NextJob().prior.T_map_imu.translation.x();
  };
  EXPECT_NEAR(prior_after_match_at(0.5), prior_after_match_at(0.0), 1e-3);
}

TEST(LidarOnly, MapThatBeginsBeforeTheTrackIsCountedAsLate) {
  LidarOnlyBench b;
  ASSERT_FALSE(b.Match());
  auto early = std::make_shared<Sweep>();
  early->start = StampAt(-0.29);  // with its middle before the track's start
  early->end = StampAt(0.2);
  b.bench.sweeps.push_back(early);
  MatchOutcome begins = b.bench.Unmatched(b.mode.MakeJob(early));
  begins.match.status = MatchStatus::kEmptyMap;
  EXPECT_EQ(b.bench.counters.num_scans_late, 0);
  ASSERT_FALSE(b.Finish(begins));
  EXPECT_EQ(b.bench.counters.num_scans_late, 1);
  EXPECT_TRUE(b.insert.T_map_imu);
}

TEST(LidarOnly, FiveUnmatchedScansInARowEndTheMode) {
  LidarOnlyBench b;
  ASSERT_FALSE(b.Match(10));
  ASSERT_FALSE(b.Miss(4));
  EXPECT_EQ(b.mode.status(), TrackingStatus::kCoasting);
  const auto transition = b.Miss();
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kLost);
  const Handover& handover = transition->handover;
  EXPECT_EQ(handover.origin, Origin::kLostLidar);
  EXPECT_EQ(handover.last_fix.stamp, StampAt(0.95));  // the middle of the last matched sweep
  EXPECT_NEAR(handover.last_fix.T_world_imu.translation.x(), 0.95 * kSpeed_mps, 0.05);
  EXPECT_NEAR(handover.last_fix.v_world_imu.x(), kSpeed_mps, 0.1);
  EXPECT_EQ(handover.last_seq, 9);
  EXPECT_GT(handover.pose_cov(0, 0), 0.01);  // unsure since
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
}

TEST(LidarOnly, MatchInBetweenBeginsTheCountOfUnmatchedScansAnew) {
  LidarOnlyBench b;
  ASSERT_FALSE(b.Match(10));
  ASSERT_FALSE(b.Miss(4));
  ASSERT_FALSE(b.Match());
  EXPECT_FALSE(b.Miss(4));
}

TEST(LidarOnly, ScanAfterUnmatchedOnesDoesNotGrowTheMapYet) {
  LidarOnlyBench b;
  ASSERT_FALSE(b.Match(10));
  ASSERT_TRUE(b.insert.T_map_imu);
  ASSERT_FALSE(b.Miss(2));
  EXPECT_FALSE(b.insert.T_map_imu);
  ASSERT_FALSE(b.Match());
  EXPECT_FALSE(b.insert.T_map_imu);
  ASSERT_FALSE(b.Match());
  EXPECT_TRUE(b.insert.T_map_imu);
}

TEST(LidarOnly, RelocalizedScanIsFusedButGrowsNoMapAndIsNoFix) {
  LidarOnlyBench b;
  ASSERT_FALSE(b.Match(10));
  MatchOutcome found = b.bench.Matched(b.NextJob(), b.motion);
  found.is_relocalized = true;
  found.match.T_map_imu.translation.y() += 20.0;
  ASSERT_FALSE(b.Finish(found));
  EXPECT_FALSE(b.insert.T_map_imu);
  EXPECT_TRUE(b.bench.Take<ScanOutput>().back().scan.fused);
  EXPECT_EQ(b.mode.TakeImu({StampAt(2.0)})->handover.last_fix.stamp, StampAt(0.95));
}

TEST(LidarOnly, BeginsAfterALossWhereTheMotionBeforeItLeads) {
  LidarOnlyBench b(kSpeed_mps, LostASecondAgo());
  const MatchJob job = b.NextJob();
  // The body goes for a second at 8 m/s, half of it before and half after half a second's turn; and
  // for half a sweep.
  const Quaternion turn = ExpSo3(Vector3(0, 0, 0.1));
  const Vector3 ahead_m(kSpeed_mps, 0, 0);
  const Vector3 expected_m = Vector3(10, 0, 0) + 0.5 * (ahead_m + turn * ahead_m);
  EXPECT_NEAR((job.T_any_imu.front().pose.translation - expected_m).norm(), 0.0, 1e-6);
  EXPECT_NEAR(LogSo3(job.prior.T_map_imu.rotation).z(), 0.1, 1e-6);
}

TEST(LidarOnly, PlaceAfterALossIsAsUnsureAsBeforeAndSomeMore) {
  LidarOnlyBench b(kSpeed_mps, LostASecondAgo());
  ASSERT_FALSE(b.Match());
  const Matrix6 cov = b.bench.Take<ScanOutput>().back().filter->nav.pose_cov;
  EXPECT_GE(cov(0, 0), 0.04 + kPlacedStd_m * kPlacedStd_m);
  EXPECT_GE(cov(5, 5), 0.04 + kPlacedStd_rad * kPlacedStd_rad);
}

// An inertial unit came for a moment, or tracking was lost as it fell silent: what was published
// goes on, as unsure as the last pose and all that may have happened since.
TEST(LidarOnly, BeginsWhereTheLastPoseLeadsWhoeverPublishedIt) {
  for (const Origin origin : {Origin::kInertial, Origin::kLidar}) {
    Handover handover = LostASecondAgo();
    handover.origin = origin;
    handover.pose_cov.setZero();
    handover.last_fix.pose_cov = 0.09 * Matrix6::Identity();
    LidarOnlyBench b(kSpeed_mps, handover);
    const MatchJob job = b.NextJob();
    EXPECT_NEAR(job.T_any_imu.front().pose.translation.x(), 10.0 + kSpeed_mps, 1e-6);
    ASSERT_FALSE(b.Finish(b.bench.Matched(job, b.motion)));
    const Matrix6 cov = b.bench.Take<ScanOutput>().back().filter->nav.pose_cov;
    const double turn_std_rad = kOutage.turn_rate_std_radps * 1.0;
    EXPECT_GE(cov(1, 1), 0.09 + std::pow(turn_std_rad * kSpeed_mps, 2));
    EXPECT_GE(cov(5, 5), 0.09 + turn_std_rad * turn_std_rad);
  }
}

// The world of an inertial filter is level, so it tells where up is in the map that goes on in it.
TEST(LidarOnly, LevelWorldTellsTheUpOfTheNewMap) {
  Handover handover = LostASecondAgo();
  handover.last_fix.T_world_imu.rotation = ExpSo3(Vector3(0.3, 0, 0));
  handover.w_imu_radps.setZero();
  LidarOnlyBench upright(kSpeed_mps, handover);  // nothing but the rig tells
  EXPECT_GT(upright.NextJob().prior.up_map.cross(Vector3::UnitZ()).norm(), 0.2);
  handover.origin = Origin::kInertial;
  LidarOnlyBench level(kSpeed_mps, handover);
  EXPECT_NEAR(level.NextJob().prior.up_map.cross(Vector3::UnitZ()).norm(), 0.0, 1e-9);
}

TEST(LidarOnly, PlaceThatWasGivenIsAsSureAsItWasGiven) {
  Handover handover = LostASecondAgo();
  handover.origin = Origin::kInertial;
  handover.is_placed = true;
  handover.last_fix.stamp = StampAt(0.0);
  handover.last_fix.pose_cov = 1e-4 * Matrix6::Identity();
  LidarOnlyBench b(kSpeed_mps, handover);
  ASSERT_FALSE(b.Match());
  EXPECT_LT(b.bench.Take<ScanOutput>().back().filter->nav.pose_cov(5, 5), 0.01);
}

TEST(LidarOnly, WithoutALossItBeginsAtTheOrigin) {
  Handover handover = LostASecondAgo();
  handover.origin = Origin::kNone;
  LidarOnlyBench b(kSpeed_mps, handover);
  EXPECT_NEAR(b.NextJob().T_any_imu.front().pose.translation.norm(), 0.0, 1e-9);
}

TEST(LidarOnly, ImuThatAppearsGetsTheWorldAndTheMap) {
  LidarOnlyBench b;
  ASSERT_FALSE(b.Match(10));
  const auto transition = b.mode.TakeImu({StampAt(1.0)});
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kImuAppeared);
  EXPECT_EQ(transition->handover.origin, Origin::kLidar);
  EXPECT_TRUE(transition->handover.is_map_by_lidar);
  EXPECT_NEAR(transition->handover.last_fix.T_map_imu.translation.x(), 0.95 * kSpeed_mps, 0.05);
}

// The state is what the inertial filter knew at second 0: the map has drifted from the world by two
// metres.
StartState Inertial() {
  StartState start;
  start.g_world = Vector3(0, 0, -9.81);
  start.estimate.stamp = StampAt(0.0);
  NavState& state = start.estimate.state;
  state.T_map_imu.translation = Vector3(0, 2, 0);
  state.v_world_imu = Vector3(kSpeed_mps, 0, 0);
  state.gyro_bias = Vector3(0.01, 0.02, 0.03);
  state.accel_bias = Vector3(0.1, 0.2, 0.3);
  start.estimate.cov.diagonal().setConstant(1e-4);
  return start;
}

TEST(LidarOnly, GoesOnInTheWorldAndTheMapOfTheInertialFilter) {
  LidarOnlyBench b(kSpeed_mps, {}, Inertial());
  const MatchJob first = b.NextJob();
  EXPECT_EQ(first.map_action, MapAction::kKeep);
  EXPECT_NEAR(first.prior.T_map_imu.translation.x(), 0.05 * kSpeed_mps, 0.01);
  EXPECT_NEAR(first.prior.T_map_imu.translation.y(), 2.0, 0.01);
  MatchOutcome found = b.bench.Matched(first, b.motion);
  found.match.T_map_imu.translation.y() = 2.0;
  ASSERT_FALSE(b.Finish(found));
  const FilterReport report = *b.bench.Take<ScanOutput>().back().filter;
  EXPECT_NEAR(report.nav.T_world_imu.translation.y(), 0.0, 0.01);
  EXPECT_NEAR(report.nav.T_map_imu.translation.y(), 2.0, 0.01);
  EXPECT_EQ(report.g_world_mps2, Inertial().g_world);
}

TEST(LidarOnly, ScanThatMatchesGoesBackToTheImuWithItsBiases) {
  LidarOnlyBench b(kSpeed_mps, {}, Inertial());
  b.motion = [](double t_s) { return Pose{Quaternion::Identity(), Vector3(8.0 * t_s, 2, 0)}; };
  ASSERT_FALSE(b.Match(5));
  ASSERT_FALSE(b.mode.TakeImu({StampAt(-0.4)}));
  ASSERT_FALSE(b.Miss());  // nor does the first one that is found again
  ASSERT_FALSE(b.Match());
  const auto transition = b.Match();
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kImuReturned);
  EXPECT_TRUE(transition->handover.keeps_map);
  ASSERT_TRUE(transition->start);
  const Estimate& start = transition->start->estimate;
  EXPECT_EQ(start.stamp, StampAt(0.75));
  EXPECT_NEAR(start.state.T_map_imu.translation.x(), 0.75 * kSpeed_mps, 0.05);
  EXPECT_EQ(start.state.gyro_bias, Inertial().estimate.state.gyro_bias);
  EXPECT_EQ(start.state.accel_bias, Inertial().estimate.state.accel_bias);
  EXPECT_GT(start.cov(kAccelBias, kAccelBias), 0.0);
}

TEST(LidarOnly, GravityIsFeltBeforeItGoesBackToTheImu) {
  LidarOnlyBench b(kSpeed_mps, {}, Inertial());
  ASSERT_FALSE(b.Match(5));
  ASSERT_FALSE(b.mode.TakeImu({StampAt(0.5)}));
  const int num_scans = static_cast<int>(std::lround(kGravityCheck.window_s / kSweepSpan_s));
  EXPECT_FALSE(b.Match(num_scans - 1));
  EXPECT_TRUE(b.Match());
}

TEST(LidarOnly, AttitudeThatGravityContradictsGivesUpAllThatWasFoundWithoutTheImu) {
  StartState tilted = Inertial();
  tilted.estimate.state.T_world_imu.rotation = ExpSo3(Vector3(0, 1.0, 0));
  LidarOnlyBench b(kSpeed_mps, {}, tilted);
  ASSERT_FALSE(b.Match(5));
  ASSERT_FALSE(b.mode.TakeImu({StampAt(0.5)}));
  b.bench.FeedImu(b.motion, 0.5, 1.6);
  const auto transition = b.Match(10);
  ASSERT_TRUE(transition);
  EXPECT_EQ(transition->trigger, Trigger::kImuReturned);
  EXPECT_TRUE(transition->needs_new_map);
  const Estimate& start = transition->start->estimate;
  EXPECT_EQ(start.stamp, StampAt(1.45));
  EXPECT_GT(std::sqrt(start.cov(kPos, kPos)), 1.4 * kSpeed_mps);
  EXPECT_EQ(transition->handover.last_fix.stamp, StampAt(0.0));
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
}

TEST(LidarOnly, ImuThatFallsSilentAgainIsNotGoneBackTo) {
  LidarOnlyBench b(kSpeed_mps, {}, Inertial());
  ASSERT_FALSE(b.Match(5));
  ASSERT_FALSE(b.mode.TakeImu({StampAt(0.4)}));
  b.mode.TakeImuAbsent();
  EXPECT_FALSE(b.Match(5));
}

}  // namespace
}  // namespace lio
