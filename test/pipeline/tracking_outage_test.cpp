// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the way back from an outage, while tracking.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/tracking.hpp"
#include "pipeline/tracking_bench.hpp"

namespace lio {
namespace {

using test::AfterOneSecond;
using test::kSpeed_mps;
using test::MapOfNextStep;
using test::StampAt;
using test::StdOf;
using test::Straight;
using test::XOf;

using Step = ImuPreprocessor::Step;

// The next scan is asked for the velocity alone, in a cleared map, and tells it.
void FindTheVelocityForANewMap(AfterOneSecond& b) {
  const MatchJob first = b.NextJob();
  EXPECT_TRUE(std::holds_alternative<FindVelocity>(first.task));
  EXPECT_EQ(first.map_action, MapAction::kClear);
  MatchOutcome seen = b.bench.Unmatched(first);
  seen.match.status = MatchStatus::kEmptyMap;
  seen.v_map_imu_mps = Vector3(kSpeed_mps, 0, 0);
  ASSERT_FALSE(b.Finish(seen));
}

TEST(TrackingOutage, LostAtOnceAfterAnOutage) {
  AfterOneSecond b;
  b.StartSegment(6.0, Step::kGap);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
  const MatchJob job = b.NextJob();
  EXPECT_NEAR(XOf(job), 6.05 * kSpeed_mps, 0.5);
  EXPECT_GT(StdOf(job), 5.0 * kSpeed_mps - 1.0);
  EXPECT_TRUE(std::get<Relocalize>(job.task).search.T_map_imu_alternative);
}

// Were the clocks set, or was a player started again? Only scans can tell.
TEST(TrackingOutage, LostAtOnceWhenTheClocksGoBackBySeconds) {
  AfterOneSecond b;
  b.StartSegment(-5.0, Step::kSetBack);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
  EXPECT_TRUE(b.bench.HasNotified(Notice::Severity::kWarning));
  const MatchJob job = b.NextJob();
  EXPECT_GT(StdOf(job), 6.0 * kSpeed_mps - 1.0) << "anywhere that six seconds lead to";
  const auto& alternative = std::get<Relocalize>(job.task).search.T_map_imu_alternative;
  ASSERT_TRUE(alternative);
  EXPECT_NEAR(alternative->translation.x(), 1.05 * kSpeed_mps, 0.1) << "or where it was";
  // It is where it was, and goes on from there.
  b.motion = [](double t_s) { return Straight(kSpeed_mps)(t_s + 6.0); };
  MatchOutcome found = b.bench.Matched(job, b.motion);
  found.is_relocalized = true;
  ASSERT_FALSE(b.Finish(found));
  ASSERT_FALSE(b.Match(2));
  EXPECT_EQ(b.mode.status(), TrackingStatus::kOk);
}

TEST(TrackingOutage, FoundAfterAnOutageItIsOkOnceTwoMoreScansMatch) {
  AfterOneSecond b;
  b.StartSegment(6.0, Step::kGap);
  b.motion = [](double t_s) { return Straight(kSpeed_mps)(t_s - 2.0); };  // it has waited
  MatchOutcome found = b.bench.Matched(b.NextJob(), b.motion);
  found.is_relocalized = true;
  ASSERT_FALSE(b.Finish(found));
  EXPECT_FALSE(b.insert.T_map_imu);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
  ASSERT_FALSE(b.Match(2));
  EXPECT_EQ(b.mode.status(), TrackingStatus::kOk);
  const MatchJob next = b.NextJob();
  EXPECT_NEAR(XOf(next), (6.35 - 2.0) * kSpeed_mps, 0.2);
  EXPECT_LT(StdOf(next), 0.5);
}

TEST(TrackingOutage, FoundNowhereAfterAnOutageANewMapGoesOnWithTheDoubt) {
  AfterOneSecond b;
  b.StartSegment(6.0, Step::kGap);
  ASSERT_FALSE(b.Miss(kOutage.max_scans_sought));
  FindTheVelocityForANewMap(b);
  EXPECT_FALSE(b.insert.T_map_imu);
  const MatchJob begin = b.NextJob();
  EXPECT_EQ(begin.map_action, MapAction::kClear);
  ASSERT_FALSE(b.Finish(b.bench.Matched(begin, b.motion)));
  EXPECT_TRUE(b.insert.T_map_imu);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
  ASSERT_FALSE(b.Match());
  EXPECT_EQ(b.mode.status(), TrackingStatus::kOk);
  const FilterReport report = *b.bench.Take<ScanOutput>().back().filter;
  EXPECT_GT(std::sqrt(report.nav.pose_cov(0, 0)), 30.0);
  EXPECT_LT(std::sqrt(report.nav.map_pose_cov(0, 0)), 1.0);
  EXPECT_NEAR(report.nav.v_world_imu_mps.x(), kSpeed_mps, 0.5);
}

TEST(TrackingOutage, ANewMapThatIsAskedForBeginsWithoutASearch) {
  AfterOneSecond b;
  b.mode.BeginNewMap();
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
  FindTheVelocityForANewMap(b);
  ASSERT_FALSE(b.Match(2));
  EXPECT_EQ(b.mode.status(), TrackingStatus::kOk);
}

// The scan is of the time before the outage, of which the filter holds nothing any more.
TEST(TrackingOutage, VelocityOfAScanBeforeTheOutageIsCountedAsLateAndNotTaken) {
  AfterOneSecond b;
  b.StartSegment(6.0, Step::kGap);
  ASSERT_FALSE(b.Miss(kOutage.max_scans_sought));
  b.sweep_start_s = 5.8;
  MatchOutcome early = b.bench.Unmatched(b.NextJob());
  early.v_map_imu_mps = Vector3(0, 3.0 * kSpeed_mps, 0);
  ASSERT_FALSE(b.Finish(early));
  EXPECT_EQ(b.bench.counters.num_scans_late, 1);
  b.sweep_start_s = b.imu_from_s = 7.0;
  ASSERT_FALSE(b.Match(2));  // for the map, and for its confirmation
  EXPECT_EQ(b.bench.counters.num_scans_late, 1);
  const FilterReport report = *b.bench.Take<ScanOutput>().back().filter;
  EXPECT_NEAR(report.nav.v_world_imu_mps.y(), 0.0, 0.5);
}

// Gravity is fitted for each map, so the record must know that there are two.
TEST(TrackingOutage, FoundNowhereAfterAnOutageTheRecordOfTheMotionBeginsAMap) {
  AfterOneSecond b;
  MotionRecord& record = b.bench.examiner.record();
  const int before = MapOfNextStep(record);
  b.StartSegment(6.0, Step::kGap);
  ASSERT_FALSE(b.Miss(kOutage.max_scans_sought));
  ASSERT_FALSE(b.Match(3));  // for the velocity, for the map, and for its confirmation
  ASSERT_EQ(b.mode.status(), TrackingStatus::kOk);
  EXPECT_NE(MapOfNextStep(record), before);
}

TEST(TrackingOutage, FoundAfterAnOutageTheRecordOfTheMotionKeepsItsMap) {
  AfterOneSecond b;
  MotionRecord& record = b.bench.examiner.record();
  const int before = MapOfNextStep(record);
  b.StartSegment(6.0, Step::kGap);
  MatchOutcome found = b.bench.Matched(b.NextJob(), b.motion);
  found.is_relocalized = true;
  ASSERT_FALSE(b.Finish(found));
  ASSERT_FALSE(b.Match(2));
  ASSERT_EQ(b.mode.status(), TrackingStatus::kOk);
  EXPECT_EQ(MapOfNextStep(record), before);
}

TEST(TrackingOutage, PlaceThatLaterScansContradictIsGivenUpWithItsCertainty) {
  AfterOneSecond b;
  b.StartSegment(6.0, Step::kGap);
  MatchOutcome found = b.bench.Matched(b.NextJob(), b.motion);
  found.is_relocalized = true;
  ASSERT_FALSE(b.Finish(found));
  ASSERT_FALSE(b.Miss(kOutage.max_scans_checked));
  const MatchJob next = b.NextJob();
  EXPECT_TRUE(std::holds_alternative<FindVelocity>(next.task));
  EXPECT_GT(StdOf(next), 30.0);
  EXPECT_EQ(b.mode.status(), TrackingStatus::kLost);
}

}  // namespace
}  // namespace lio
