// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/place_verification.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

MatchResult Matched(int num_matched, int num_in_map, unsigned degenerate_mask = 0) {
  MatchResult match;
  match.status = degenerate_mask == 0 ? MatchStatus::kConverged : MatchStatus::kDegenerate;
  match.num_matched = num_matched;
  match.num_in_map = num_in_map;
  match.degenerate_mask = degenerate_mask;
  return match;
}

TEST(PlaceVerification, TheShareOfPointsOnSurfacesDecides) {
  const MatchResult last = Matched(980, 1000);
  EXPECT_TRUE(IsVerified(Matched(900, 1000), last)) << "92 % of the last scan's share";
  EXPECT_FALSE(IsVerified(Matched(780, 1000), last)) << "80 % of it";
  EXPECT_TRUE(IsVerified(Matched(250, 255), last));
  EXPECT_FALSE(IsVerified(Matched(150, 150), last)) << "too few to tell";
}

// A bay of a car park like the right one: floor and ceiling are where they should be.
TEST(PlaceVerification, WhatStandsMustBeThereAsWell) {
  MatchResult last = Matched(980, 1000);
  last.upright.all = {300, 290};
  MatchResult match = Matched(920, 1000);
  match.upright.all = {300, 270};
  EXPECT_TRUE(IsVerified(match, last));
  match.upright.all = {300, 220};
  EXPECT_FALSE(IsVerified(match, last)) << "a fourth of it contradicts";
  match.upright.all = {40, 40};
  EXPECT_FALSE(IsVerified(match, last)) << "little of it is there";
  last.upright.all = {45, 45};
  EXPECT_TRUE(IsVerified(match, last)) << "little stood before";
}

// Trunks and posts held the last scan, in part. The shift since then is known to centimetres, so
// that this scan is matched without them.
TEST(PlaceVerification, VerticalStructuresCountWhereBothMatchesHaveSome) {
  MatchResult last = Matched(390, 400);
  last.upright.all = {300, 295};
  last.upright.structures = {230, 225};
  MatchResult match = Matched(160, 165);
  match.upright.all = {68, 66};
  EXPECT_TRUE(IsAsTheLast(match, last)) << "165 points of last lie on planes";
  EXPECT_FALSE(IsClearlyBetter(last, match));
  match.upright.structures = {10, 10};
  EXPECT_FALSE(HasPlenty(match, last)) << "now it was matched with them";
  EXPECT_TRUE(IsClearlyBetter(last, match));
}

TEST(PlaceVerification, AFailedMatchIsNoPlaceUnlessItsStepsGoToAndFro) {
  const MatchResult last = Matched(980, 1000);
  MatchResult match = Matched(950, 1000);
  match.status = MatchStatus::kMaxIterations;
  EXPECT_TRUE(IsVerified(match, last));
  match.status = MatchStatus::kDiverged;
  EXPECT_FALSE(IsVerified(match, last));
}

TEST(PlaceVerification, AnyMatchIsVerifiedAgainstTheScanThatBeganTheMap) {
  EXPECT_TRUE(IsVerified(Matched(10, 1000), MatchResult{}));
}

TEST(PlaceVerification, ElsewhereNothingMayBeDegenerateThatWasNot) {
  const MatchResult last = Matched(980, 1000);
  const MatchResult degenerate = Matched(950, 1000, 1u);
  EXPECT_TRUE(IsVerified(degenerate, last));
  EXPECT_FALSE(IsVerifiedElsewhere(degenerate, last));
  EXPECT_TRUE(IsVerifiedElsewhere(degenerate, Matched(980, 1000, 2u)));
}

TEST(PlaceVerification, ManyMatchesEndTheSearch) {
  const MatchResult last = Matched(1000, 1000);
  EXPECT_TRUE(IsVerifiedBeyondDoubt(Matched(600, 600), last));
  EXPECT_FALSE(IsVerifiedBeyondDoubt(Matched(590, 590), last));
}

TEST(PlaceVerification, ABentScanIsLikelyWithMostOfItsPointsOnSurfaces) {
  const MatchResult last = Matched(1000, 1000);
  EXPECT_TRUE(IsLikely(Matched(810, 1000), last));
  EXPECT_FALSE(IsLikely(Matched(790, 1000), last)) << "too many lie on nothing";
  EXPECT_FALSE(IsLikely(Matched(590, 600), last)) << "too few are left";
}

TEST(PlaceVerification, AMatchIsNearTheAlternativeWhenItIsMuchNearer) {
  const Pose prior;
  const Pose alternative{Quaternion::Identity(), Vector3(10, 0, 0)};
  MatchResult match = Matched(950, 1000);
  match.T_map_imu.translation = Vector3(8, 0, 0);
  EXPECT_TRUE(IsNearAlternative(match, prior, alternative));
  match.T_map_imu.translation = Vector3(6, 0, 0);
  EXPECT_FALSE(IsNearAlternative(match, prior, alternative));
  match.T_map_imu.translation = Vector3(0.4, 0, 0);
  EXPECT_FALSE(IsNearAlternative(match, prior, Pose{Quaternion::Identity(), Vector3(0.4, 0, 0)}))
      << "the two are not apart";
}

TEST(PlaceVerification, ClearlyWorseIsHalfAsManyContradictionsMore) {
  EXPECT_TRUE(IsClearlyWorse(Matched(850, 1000), Matched(900, 1000)));
  EXPECT_FALSE(IsClearlyWorse(Matched(860, 1000), Matched(900, 1000)));
  EXPECT_FALSE(IsClearlyWorse(Matched(975, 1000), Matched(1000, 1000))) << "things move";
  EXPECT_TRUE(IsClearlyWorse(Matched(965, 1000), Matched(1000, 1000)));
}

TEST(PlaceVerification, ClearlyBetterIsAFifthMore) {
  EXPECT_TRUE(IsClearlyBetter(Matched(121, 200), Matched(100, 200)));
  EXPECT_FALSE(IsClearlyBetter(Matched(119, 200), Matched(100, 200)));
}

}  // namespace
}  // namespace lio
