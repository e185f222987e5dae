// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/candidate.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

MatchResult MatchOf(MatchStatus status, int num_in_map, int num_matched) {
  MatchResult match;
  match.status = status;
  match.num_in_map = num_in_map;
  match.num_matched = num_matched;
  return match;
}

TEST(Candidate, MorePointsOnSurfacesSpeakForAMatchAndPointsBesideThemAgainstIt) {
  const double support = SupportOf(MatchOf(MatchStatus::kConverged, 1000, 900));
  EXPECT_DOUBLE_EQ(support, 810.0);
  EXPECT_LT(SupportOf(MatchOf(MatchStatus::kConverged, 1000, 800)), support);
  EXPECT_LT(SupportOf(MatchOf(MatchStatus::kConverged, 1200, 900)), support);
}

TEST(Candidate, WithoutACountOfPointsBesideSurfacesTheNumberCounts) {
  EXPECT_DOUBLE_EQ(SupportOf(MatchOf(MatchStatus::kConverged, 0, 900)), 900.0);
}

// Steps that go to and fro end near the place.
TEST(Candidate, AMatchWithoutResultHasNone) {
  EXPECT_GT(SupportOf(MatchOf(MatchStatus::kMaxIterations, 1000, 900)), 0.0);
  EXPECT_EQ(SupportOf(MatchOf(MatchStatus::kTooFewPoints, 1000, 900)), 0.0);
  EXPECT_EQ(SupportOf(MatchOf(MatchStatus::kEmptyMap, 1000, 900)), 0.0);
}

}  // namespace
}  // namespace lio
