// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/health.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/stamp_from_zero.hpp"

namespace lio {
namespace {

using test::StampFromZero;

constexpr int kManyPoints = 5000;
constexpr int kFewPoints = 199;  // one less than says anything about the map
constexpr Duration kScan{100'000'000};

MatchResult Match(MatchStatus status, unsigned degenerate_mask = 0) {
  MatchResult match;
  match.status = status;
  match.degenerate_mask = degenerate_mask;
  return match;
}

const MatchResult kGood = Match(MatchStatus::kConverged);
const MatchResult kBad = Match(MatchStatus::kDiverged);

// A vehicle that was located at 10 s, with ten scans a second from then on.
class HealthTest : public testing::Test {
 protected:
  Health With(bool has_imu) {
    return {has_imu, TrackingStatus::kOk, StampFromZero(10.0), counters_};
  }

  Health::Verdict AddUnmatched(Health& health, int num, int num_points = kManyPoints) {
    Health::Verdict verdict;
    for (int i = 0; i < num; ++i) {
      now_ = now_ + kScan;
      verdict = health.AddScan(now_, kBad, num_points, false);
    }
    return verdict;
  }

  Counters counters_;
  Timestamp now_ = StampFromZero(10.0);
};

TEST_F(HealthTest, AFusedScanIsOk) {
  Health health(true, TrackingStatus::kLost, StampFromZero(1.0), counters_);
  const Health::Verdict verdict = health.AddScan(StampFromZero(10.0), kGood, kManyPoints, true);
  EXPECT_EQ(health.status(), TrackingStatus::kOk);
  EXPECT_EQ(health.last_fused(), StampFromZero(10.0));
  EXPECT_FALSE(verdict.rebases_map || verdict.restarts || verdict.is_newly_lost);
  EXPECT_EQ(counters_.num_matches_rejected, 0);
}

TEST_F(HealthTest, AFusedScanWithADirectionThatIsNotObservableIsDegenerate) {
  Health health = With(true);
  (void)health.AddScan(StampFromZero(10.1), Match(MatchStatus::kDegenerate, 0b1), kManyPoints,
                       true);
  EXPECT_EQ(health.status(), TrackingStatus::kDegenerate);
  EXPECT_EQ(health.last_fused(), StampFromZero(10.1));
}

TEST_F(HealthTest, AScanThatBeginsTheMapCountsAsFused) {
  Health health(true, TrackingStatus::kInit, std::nullopt, counters_);
  (void)health.AddScan(StampFromZero(10.0), Match(MatchStatus::kEmptyMap), kManyPoints, false);
  EXPECT_EQ(health.status(), TrackingStatus::kOk);
  EXPECT_EQ(health.last_fused(), StampFromZero(10.0));
  EXPECT_EQ(counters_.num_matches_rejected, 0);
}

// A bus alongside hides half of the map: that is no end of it.
TEST_F(HealthTest, AMatchThatWasRefusedDoesNotEndTheMapAtOnce) {
  Health health = With(true);
  MatchResult refused = Match(MatchStatus::kTooFewPoints);
  refused.num_matched = 800;
  EXPECT_FALSE(health.AddScan(StampFromZero(10.1), refused, kManyPoints, false).rebases_map);
  refused.num_matched = 49;
  EXPECT_TRUE(health.AddScan(StampFromZero(10.2), refused, kManyPoints, false).rebases_map);
}

TEST_F(HealthTest, AMatchThatWasNotFusedIsNoMatch) {
  Health health = With(true);
  (void)health.AddScan(StampFromZero(10.1), kGood, kManyPoints, false);
  EXPECT_EQ(health.status(), TrackingStatus::kCoasting);
  EXPECT_EQ(health.last_fused(), StampFromZero(10.0));
  EXPECT_EQ(health.num_unmatched_in_a_row(), 1);
  EXPECT_EQ(counters_.num_matches_rejected, 1);
}

TEST_F(HealthTest, ItCoastsForTwoSecondsWithoutAMatchAndIsLostThen) {
  Health health = With(true);
  (void)health.AddScan(StampFromZero(11.9), kBad, kManyPoints, false);
  EXPECT_EQ(health.status(), TrackingStatus::kCoasting);
  (void)health.AddScan(StampFromZero(12.0), kBad, kManyPoints, false);
  EXPECT_EQ(health.status(), TrackingStatus::kLost);
}

TEST_F(HealthTest, ADegenerateScanThatWasNotFusedCoasts) {
  Health health = With(true);
  (void)health.AddScan(StampFromZero(10.1), Match(MatchStatus::kDegenerate, 0b1), kManyPoints,
                       false);
  EXPECT_EQ(health.status(), TrackingStatus::kCoasting);
}

TEST_F(HealthTest, WithoutAnyFusedScanItIsLostAtOnce) {
  Health health(true, TrackingStatus::kInit, std::nullopt, counters_);
  EXPECT_TRUE(health.AddScan(StampFromZero(10.0), kBad, kManyPoints, false).is_newly_lost);
  EXPECT_EQ(health.status(), TrackingStatus::kLost);
}

TEST_F(HealthTest, ItIsNewlyLostOnceForEachTime) {
  Health health = With(true);
  EXPECT_FALSE(health.AddScan(StampFromZero(11.0), kBad, kManyPoints, false).is_newly_lost);
  EXPECT_TRUE(health.AddScan(StampFromZero(12.5), kBad, kManyPoints, false).is_newly_lost);
  EXPECT_FALSE(health.AddScan(StampFromZero(12.6), kBad, kManyPoints, false).is_newly_lost);
  EXPECT_FALSE(health.AddScan(StampFromZero(12.7), kGood, kManyPoints, true).is_newly_lost);
  EXPECT_TRUE(health.AddScan(StampFromZero(15.0), kBad, kManyPoints, false).is_newly_lost);
}

TEST_F(HealthTest, AModeThatBeginsLostIsNotNewlyLost) {
  Health health(true, TrackingStatus::kLost, StampFromZero(1.0), counters_);
  EXPECT_FALSE(health.AddScan(StampFromZero(10.0), kBad, kManyPoints, false).is_newly_lost);
}

TEST_F(HealthTest, WithAnImuTheMapIsRebasedAfterMoreThanTenUnmatchedScans) {
  Health health = With(true);
  EXPECT_FALSE(AddUnmatched(health, 10).rebases_map);
  EXPECT_TRUE(AddUnmatched(health, 1).rebases_map);
}

TEST_F(HealthTest, WithAnImuAMapThatTheScanDoesNotMeetIsRebasedAtOnce) {
  Health health = With(true);
  const MatchResult beside_map = Match(MatchStatus::kTooFewPoints);
  EXPECT_TRUE(health.AddScan(StampFromZero(10.1), beside_map, kManyPoints, false).rebases_map);
  EXPECT_FALSE(health.AddScan(StampFromZero(10.2), beside_map, kFewPoints, false).rebases_map);
}

TEST_F(HealthTest, WithoutAnImuTheMapIsNeverRebased) {
  Health health = With(false);
  const MatchResult beside_map = Match(MatchStatus::kTooFewPoints);
  for (int i = 1; i <= 40; ++i) {
    EXPECT_FALSE(health.AddScan(now_ + kScan, beside_map, kManyPoints, false).rebases_map) << i;
    EXPECT_FALSE(AddUnmatched(health, 1).rebases_map) << i;
  }
}

TEST_F(HealthTest, WithAnImuTheStartBeginsAnewAfter25UnmatchedScans) {
  Health health = With(true);
  EXPECT_FALSE(AddUnmatched(health, 24).restarts);
  EXPECT_TRUE(AddUnmatched(health, 1).restarts);
}

TEST_F(HealthTest, WithoutAnImuTheStartBeginsAnewAfterFiveUnmatchedScans) {
  Health health = With(false);
  EXPECT_FALSE(AddUnmatched(health, 4).restarts);
  EXPECT_TRUE(AddUnmatched(health, 1).restarts);
}

TEST_F(HealthTest, AMatchEndsTheRowOfUnmatchedScans) {
  Health health = With(true);
  AddUnmatched(health, 24);
  (void)health.AddScan(now_ + kScan, kGood, kManyPoints, true);
  EXPECT_EQ(health.num_unmatched_in_a_row(), 0);
  const Health::Verdict verdict = AddUnmatched(health, 10);
  EXPECT_FALSE(verdict.restarts);
  EXPECT_FALSE(verdict.rebases_map);
}

TEST_F(HealthTest, ScansOfFewPointsNeitherAddToTheRowNorEndIt) {
  Health health = With(true);
  AddUnmatched(health, 10);
  EXPECT_FALSE(AddUnmatched(health, 30, kFewPoints).restarts);
  EXPECT_EQ(health.num_unmatched_in_a_row(), 10);
  EXPECT_TRUE(AddUnmatched(health, 1, kFewPoints + 1).rebases_map) << "the eleventh of 200 points";
}

TEST_F(HealthTest, AScanOfFewPointsDoesNotRebaseAMapThatManyDidNotMeet) {
  Health health = With(true);
  AddUnmatched(health, 12);
  EXPECT_FALSE(AddUnmatched(health, 1, kFewPoints).rebases_map);
}

TEST_F(HealthTest, ScansOfFewPointsAreRejectedAndLoseTheWayAllTheSame) {
  Health health = With(true);
  AddUnmatched(health, 20, kFewPoints);
  EXPECT_EQ(health.status(), TrackingStatus::kLost);
  EXPECT_EQ(counters_.num_matches_rejected, 20);
}

TEST_F(HealthTest, AfterSoManyGatedPosesTheNextOneIsForced) {
  Health health = With(true);
  EXPECT_FALSE(health.MustForce(2));
  health.AddFusion(EventOutcome::kGated);
  EXPECT_FALSE(health.MustForce(2));
  health.AddFusion(EventOutcome::kGated);
  EXPECT_TRUE(health.MustForce(2));
}

TEST_F(HealthTest, AnAppliedPoseEndsTheRowOfGatedOnes) {
  Health health = With(true);
  health.AddFusion(EventOutcome::kGated);
  health.AddFusion(EventOutcome::kApplied);
  health.AddFusion(EventOutcome::kGated);
  EXPECT_FALSE(health.MustForce(2));
}

TEST_F(HealthTest, APoseThatCameTooLateLeavesTheRowOfGatedOnes) {
  Health health = With(true);
  health.AddFusion(EventOutcome::kGated);
  health.AddFusion(EventOutcome::kTooOld);
  health.AddFusion(EventOutcome::kGated);
  EXPECT_TRUE(health.MustForce(2));
}

TEST_F(HealthTest, GatedPosesOfTheLastFiveScansAreCounted) {
  Health health = With(true);
  EXPECT_EQ(health.NumGatedLately(), 0);
  for (int i = 1; i <= 7; ++i) {
    health.AddFusion(EventOutcome::kGated);
    EXPECT_EQ(health.NumGatedLately(), std::min(i, 5));
  }
  for (const int num_left : {4, 3, 2, 1, 0}) {
    health.AddFusion(EventOutcome::kApplied);
    EXPECT_EQ(health.NumGatedLately(), num_left);
  }
}

TEST_F(HealthTest, GatedAndLatePosesAreCountedEachOnItsOwn) {
  Health health = With(true);
  health.AddFusion(EventOutcome::kApplied);
  for (int i = 0; i < 2; ++i) health.AddFusion(EventOutcome::kGated);
  for (const EventOutcome late :
       {EventOutcome::kTooOld, EventOutcome::kBeforeStart, EventOutcome::kDuplicate}) {
    health.AddFusion(late);
  }
  EXPECT_EQ(counters_.num_gated, 2);
  EXPECT_EQ(counters_.num_scans_late, 3);
}

TEST_F(HealthTest, AClockThatWasSetDoesNotLoseTheWay) {
  Health health = With(true);
  health.ShiftTimesBy(Duration::FromSeconds(100.0));
  EXPECT_EQ(health.last_fused(), StampFromZero(110.0));
  (void)health.AddScan(StampFromZero(111.0), kBad, kManyPoints, false);
  EXPECT_EQ(health.status(), TrackingStatus::kCoasting);
}

TEST_F(HealthTest, GapOfTwoSecondsLosesTheWayOnce) {
  Health health = With(true);
  EXPECT_FALSE(health.AddGap(StampFromZero(11.5)));
  EXPECT_EQ(health.status(), TrackingStatus::kCoasting);
  EXPECT_TRUE(health.AddGap(StampFromZero(12.0)));
  EXPECT_EQ(health.status(), TrackingStatus::kLost);
  EXPECT_FALSE(health.AddGap(StampFromZero(13.0)));
}

TEST_F(HealthTest, StatusIsLostUntilAnOutageIsOver) {
  Health health = With(true);
  (void)health.AddScan(StampFromZero(10.1), kGood, kManyPoints, true);
  EXPECT_EQ(health.status(true), TrackingStatus::kLost);
  EXPECT_EQ(health.status(false), TrackingStatus::kOk);
  EXPECT_EQ(Health::StatusWhileSeeking(true), TrackingStatus::kLost);
  EXPECT_EQ(Health::StatusWhileSeeking(false), TrackingStatus::kInit);
}

}  // namespace
}  // namespace lio
