// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/outage.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/motion.hpp"

namespace lio {
namespace {

using test::StampAt;
using Event = OutageRecovery::Event;

// The body goes ten metres a second along y, heading there, and is sure of all of it.
Estimate HeadingAlongY() {
  Estimate estimate;
  estimate.stamp = StampAt(20.0);
  estimate.state.T_world_imu = {ExpSo3(Vector3(0, 0, std::numbers::pi / 2)), Vector3(3, 4, 5)};
  estimate.state.T_map_imu = {Quaternion::Identity(), Vector3(1, 0, 0)};
  estimate.state.v_world_imu = Vector3(0, 10, 0);
  estimate.cov.diagonal().setConstant(1e-4);
  return estimate;
}

double Nees(const Estimate& estimate, const Vector3& truth_world) {
  const Vector3 error = truth_world - estimate.state.T_world_imu.translation;
  return error.dot(estimate.cov.block<3, 3>(kPos, kPos).ldlt().solve(error)) / 3.0;
}

MatchOutcome Scan(int num_matched, int num_in_finest_cells) {
  MatchOutcome outcome;
  outcome.match.status = MatchStatus::kConverged;
  outcome.match.num_matched = num_matched;
  outcome.match.by_level.num_in_finest = num_in_finest_cells;
  return outcome;
}

OutageRecovery Begun(unsigned degenerate_mask = 0) {
  OutageRecovery recovery;
  MatchResult before = Scan(1000, 500).match;
  before.degenerate_mask = degenerate_mask;
  recovery.NoteMatch(before);
  recovery.Begin(HeadingAlongY(), HeadingAlongY().state.T_map_imu);
  return recovery;
}

TEST(AcrossOutage, DrivesOnInWorldAndInMapAlike) {
  const Estimate after = AcrossOutage(HeadingAlongY(), StampAt(25.0));
  EXPECT_EQ(after.stamp, StampAt(25.0));
  EXPECT_NEAR((after.state.T_world_imu.translation - Vector3(3, 54, 5)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((after.state.T_map_imu.translation - Vector3(51, 0, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((after.state.v_world_imu - Vector3(0, 10, 0)).norm(), 0.0, 1e-9);
}

TEST(MoveUnsureYaw, TakesOutWhatIsUnsureAndLeavesWhatIsKnown) {
  for (const double std_rad : {0.5 * kOutage.known_yaw_std_rad, 2.0 * kOutage.known_yaw_std_rad}) {
    Estimate estimate = HeadingAlongY();
    estimate.cov(kRot + 2, kRot + 2) = std_rad * std_rad;
    const Estimate before = estimate;
    YawDoubt doubt;
    const bool is_moved = MoveUnsureYaw(estimate, doubt);
    EXPECT_EQ(is_moved, std_rad > kOutage.known_yaw_std_rad);
    WorldEstimate published;
    doubt.AddTo(published);
    EXPECT_NEAR(published.cov(kRot + 2, kRot + 2), is_moved ? std_rad * std_rad : 0.0, 1e-9);
    EXPECT_NEAR(estimate.cov(kRot + 2, kRot + 2), is_moved ? 0.0 : std_rad * std_rad, 1e-9);
    EXPECT_EQ(estimate.state.T_world_imu.translation, before.state.T_world_imu.translation);
  }
}

TEST(AcrossOutage, CovarianceHoldsWhoeverStoppedDroveOnFasterOrTurned) {
  const Estimate after = AcrossOutage(HeadingAlongY(), StampAt(25.0));
  for (const Vector3& truth : {Vector3(3, 4, 5), Vector3(3, 54, 5), Vector3(3, 90, 9),
                               Vector3(53, 4, 5), Vector3(-40, 30, 0)}) {
    EXPECT_LT(Nees(after, truth), 1.5) << truth.transpose();
  }
}

TEST(AcrossOutage, WhoStoodMayHaveDrivenOff) {
  Estimate standing = HeadingAlongY();
  standing.state.v_world_imu.setZero();
  const Estimate after = AcrossOutage(standing, StampAt(30.0));
  EXPECT_LT(Nees(after, Vector3(3, 54, 5)), 1.5);
  EXPECT_GT(after.cov(kVel, kVel), 100.0);
}

TEST(AcrossOutage, YawMayBeAnyAndTiltIsThatOfRoads) {
  const Estimate after = AcrossOutage(HeadingAlongY(), StampAt(60.0));
  EXPECT_NEAR(std::sqrt(after.cov(kRot + 2, kRot + 2)), std::numbers::pi / std::sqrt(3.0), 0.01);
  EXPECT_NEAR(std::sqrt(after.cov(kRot, kRot)), 0.1, 0.01);
}

TEST(OutageRecovery, AClockThatWasSetLeavesTheEstimateBeforeAsLongAgo) {
  OutageRecovery recovery = Begun();
  recovery.ShiftTimesBy(Duration::FromSeconds(-2.5));
  EXPECT_EQ(recovery.before().stamp, HeadingAlongY().stamp - Duration::FromSeconds(2.5));
}

TEST(AcrossOutage, AClockThatWasSetBackTellsAsLittleAsOneThatWasSetForward) {
  const Estimate before = HeadingAlongY();
  const Duration five_s = Duration::FromSeconds(5.0);
  const Estimate forward = AcrossOutage(before, before.stamp + five_s);
  const Estimate back = AcrossOutage(before, before.stamp - five_s);
  EXPECT_EQ(back.stamp, before.stamp - five_s);
  EXPECT_EQ(back.cov, forward.cov);
  EXPECT_EQ(back.state.T_world_imu.translation, forward.state.T_world_imu.translation);
}

TEST(AcrossOutage, YearsLeaveACovarianceThatCanBeFused) {
  const Estimate after = AcrossOutage(HeadingAlongY(), StampAt(1e9));
  EXPECT_LT(after.state.T_world_imu.translation.norm(), 400.0);  // no longer than 30 s on
  EXPECT_LT(after.cov.diagonal().maxCoeff(), 2e8);
}

TEST(OutageRecovery, NothingIsLostBeforeAnOutage) {
  EXPECT_FALSE(OutageRecovery().is_running());
}

TEST(OutageRecovery, PlaceThatIsFoundIsCheckedByTheScansAfterIt) {
  OutageRecovery recovery = Begun();
  EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kSeek);
  EXPECT_EQ(recovery.AddScan(Scan(1000, 0), true, true), Event::kNone);
  EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kCheck);
  EXPECT_EQ(recovery.AddScan(Scan(700, 400), true, true), Event::kNone);
  EXPECT_TRUE(recovery.is_running());
  EXPECT_EQ(recovery.AddScan(Scan(700, 400), true, true), Event::kConfirmed);
  EXPECT_FALSE(recovery.is_running());
}

TEST(OutageRecovery, PlaceThatFitsLargeCellsAloneIsGivenUp) {
  OutageRecovery recovery = Begun();
  (void)recovery.AddScan(Scan(1000, 0), true, true);
  Event event = Event::kNone;
  for (int i = 0; i < kOutage.max_scans_checked; ++i) {
    EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kCheck);
    EXPECT_EQ(event, Event::kNone);
    event = recovery.AddScan(Scan(900, 20), true, true);
  }
  EXPECT_EQ(event, Event::kContradicted);
  EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kFindVelocity);
}

TEST(OutageRecovery, FoundNowhereItBeginsANewMapOnceTheVelocityIsKnown) {
  OutageRecovery recovery = Begun();
  for (int i = 0; i + 1 < kOutage.max_scans_sought; ++i) {
    EXPECT_EQ(recovery.AddScan(Scan(0, 0), false, true), Event::kNone);
  }
  EXPECT_EQ(recovery.AddScan(Scan(0, 0), false, true), Event::kFoundNowhere);
  EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kFindVelocity);
  (void)recovery.AddScan({}, false, true);
  MatchOutcome with_velocity;
  with_velocity.v_map_imu_mps = Vector3(10, 0, 0);
  (void)recovery.AddScan(with_velocity, false, true);
  EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kBeginMap);
  MatchOutcome first_of_map;
  first_of_map.match.status = MatchStatus::kEmptyMap;
  (void)recovery.AddScan(first_of_map, false, true);
  EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kConfirm);
  (void)recovery.AddScan(Scan(300, 100), true, true);
  EXPECT_FALSE(recovery.is_running());
}

MatchJob JobOf(const OutageRecovery& recovery) {
  MatchJob job;
  recovery.SetTask(Pose{Quaternion::Identity(), Vector3(7, 0, 0)}, job);
  return job;
}

TEST(OutageRecovery, SeeksWithThePoseIfTheClocksWereSet) {
  const MatchJob job = JobOf(Begun());
  const auto& search = std::get<Relocalize>(job.task).search;
  EXPECT_EQ(search.region, SearchRegion::kObservable);
  EXPECT_EQ(search.T_map_imu_alternative->translation.x(), 7.0);
  EXPECT_EQ(job.map_action, MapAction::kKeep);
}

TEST(OutageRecovery, ClearsTheMapForTheFirstViewAndOnceMoreForTheNewMap) {
  OutageRecovery recovery = Begun(1U);
  EXPECT_TRUE(std::holds_alternative<FindVelocity>(JobOf(recovery).task));
  EXPECT_EQ(JobOf(recovery).map_action, MapAction::kClear);
  (void)recovery.AddScan({}, false, true);
  EXPECT_TRUE(std::holds_alternative<FindVelocity>(JobOf(recovery).task));
  EXPECT_EQ(JobOf(recovery).map_action, MapAction::kKeep);
  MatchOutcome with_velocity;
  with_velocity.v_map_imu_mps = Vector3(10, 0, 0);
  (void)recovery.AddScan(with_velocity, false, true);
  EXPECT_TRUE(std::holds_alternative<Track>(JobOf(recovery).task));
  EXPECT_EQ(JobOf(recovery).map_action, MapAction::kClear);
}

TEST(OutageRecovery, MapBeginsWithoutAVelocityWhereNoneIsClear) {
  OutageRecovery recovery = Begun();
  for (int i = 0; i < kOutage.max_scans_sought + kOutage.max_scans_for_velocity; ++i) {
    (void)recovery.AddScan({}, false, true);
  }
  EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kBeginMap);
}

TEST(OutageRecovery, ScansThatSeeNothingEndNoSearch) {
  OutageRecovery recovery = Begun();
  for (int i = 0; i < 100; ++i) (void)recovery.AddScan(Scan(0, 0), false, false);
  EXPECT_EQ(recovery.stage(), OutageRecovery::Stage::kSeek);
}

TEST(OutageRecovery, NoSearchIsBelievedWhereTheSceneHeldOneDirectionLess) {
  EXPECT_EQ(Begun(1U).stage(), OutageRecovery::Stage::kFindVelocity);
}

}  // namespace
}  // namespace lio
