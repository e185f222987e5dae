// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/place_contest.hpp"

#include <gtest/gtest.h>

#include "lio/relocalization/candidate.hpp"
#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr PlaceContestParameters kContest = kRelocalization.contest;

Pose At(double x) {
  return {Quaternion::Identity(), Vector3(x, 0, 0)};
}

// Matches see something at two places, and nothing elsewhere.
struct Scenery {
  Pose here = At(30.0);
  Pose there = At(-40.0);
  int num_matched_here = 950;
  int num_matched_there = 600;
  double information_ratio = 20.0;  // along the direction shown least
  int num_calls = 0;

  MatchInInitial Matcher() {
    return [this](std::span<const Eigen::Vector3f>, const Pose& guess, const Matrix6&) {
      ++num_calls;
      MatchResult result;
      result.T_map_imu = guess;
      result.status = MatchStatus::kTooFewPoints;
      for (const auto& [place, num] :
           {std::pair(here, num_matched_here), std::pair(there, num_matched_there)}) {
        if ((guess.translation - place.translation).norm() > 3.0) continue;
        result.status = MatchStatus::kConverged;
        result.T_map_imu = place;
        result.num_matched = num;
        result.num_in_map = 1000;
        result.observability.noise = Matrix6::Identity();
        result.observability.counted = 20.0 * Matrix6::Identity();
        result.observability.counted(0, 0) = information_ratio;
      }
      return result;
    };
  }
};

MatchResult InNewMap() {
  MatchResult match;
  match.status = MatchStatus::kConverged;
  match.num_matched = 1000;
  match.num_in_map = 1010;
  return match;
}

// Ranks all, then checks scans until a place is found or nobody can win.
std::optional<FoundPlace> Decide(PlaceContest& contest, Scenery& scenery,
                                 int* num_scans = nullptr) {
  const MatchInInitial match = scenery.Matcher();
  while (!contest.Rank(match)) {
  }
  const MatchResult in_new_map = InNewMap();
  for (int i = 1; !contest.is_over(); ++i) {
    if (num_scans != nullptr) *num_scans = i;
    if (const auto found = contest.Check({{}, in_new_map}, match, 2)) return found;
  }
  return std::nullopt;
}

const std::vector<Pose> kThree{At(-39.0), At(31.0), At(90.0)};

TEST(PlaceContest, ThePlaceThatScansFitWins) {
  Scenery scenery;
  PlaceContest contest(CloudSample{}, kThree, CandidateCov());
  int num_scans = 0;
  const auto found = Decide(contest, scenery, &num_scans);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->T_initial_map.translation.x(), 30.0, 1e-9);
  EXPECT_GE(num_scans, kContest.num_checks);
}

TEST(PlaceContest, NoneOfTwoPlacesThatLookAlikeWins) {
  Scenery scenery;
  scenery.num_matched_there = 940;
  PlaceContest contest(CloudSample{}, kThree, CandidateCov());
  EXPECT_FALSE(Decide(contest, scenery));
}

TEST(PlaceContest, OnlyPlaceThatFitsBadlyDoesNotWin) {
  Scenery scenery;
  scenery.num_matched_here = 800;  // 1000 come to a surface
  PlaceContest contest(CloudSample{}, {At(31.0)}, CandidateCov());
  EXPECT_FALSE(Decide(contest, scenery));
}

TEST(PlaceContest, DegenerateMatchesDoNotTellThePlace) {
  Scenery scenery;
  scenery.information_ratio = 0.5 * kContest.min_information_ratio;
  PlaceContest contest(CloudSample{}, {At(31.0)}, CandidateCov());
  EXPECT_FALSE(Decide(contest, scenery));
}

TEST(PlaceContest, ScansOfWhichEachShowsOtherDirectionsTellThePlaceTogether) {
  Scenery scenery;
  scenery.information_ratio = 0.0;
  PlaceContest contest(CloudSample{}, {At(31.0)}, CandidateCov());
  const MatchInInitial match = scenery.Matcher();
  ASSERT_TRUE(contest.Rank(match));
  std::optional<FoundPlace> found;
  MatchResult in_new_map = InNewMap();
  for (int i = 0; !contest.is_over() && !found; ++i) {
    const bool is_turned = i % 2 == 1;  // the blind direction of the body is another one of the map
    in_new_map.T_map_imu.rotation = ExpSo3(Vector3(0, 0, is_turned ? std::acos(-1.0) / 2 : 0.0));
    scenery.here = Pose{in_new_map.T_map_imu.rotation, scenery.here.translation};
    found = contest.Check({{}, in_new_map}, match, 2);
  }
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->T_initial_map.translation.x(), 30.0, 1e-9);
}

// Has two places that look alike: no more contradicts the wrong one than a thing that was moved,
// and fewer lie on its surfaces.
std::optional<FoundPlace> DecideBetweenStoreys(double step_m) {
  Scenery scenery;
  scenery.num_matched_here = 999;
  scenery.num_matched_there = 975;
  PlaceContest contest(CloudSample{}, kThree, CandidateCov());
  const MatchInInitial match = scenery.Matcher();
  while (!contest.Rank(match)) {
  }
  MatchResult in_new_map = InNewMap();
  while (!contest.is_over()) {
    if (const auto found = contest.Check({{}, in_new_map}, match, 2)) return found;
    in_new_map.T_map_imu.translation.x() += step_m;
    scenery.here.translation.x() += step_m;
    scenery.there.translation.x() += step_m;
  }
  return {};
}

TEST(PlaceContest, PlacesThatLookNearlyAlikeAreToldOnTheWay) {
  EXPECT_FALSE(DecideBetweenStoreys(0.0));
  const auto found = DecideBetweenStoreys(0.1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->T_initial_map.translation.x(), 30.0, 1e-9);
}

TEST(PlaceContest, PlaceThatWandersDoesNotWin) {
  Scenery scenery;
  PlaceContest contest(CloudSample{}, {At(31.0)}, CandidateCov());
  const MatchInInitial match = scenery.Matcher();
  ASSERT_TRUE(contest.Rank(match));
  const MatchResult in_new_map = InNewMap();
  while (!contest.is_over()) {
    EXPECT_FALSE(contest.Check({{}, in_new_map}, match, 2));
    scenery.here.translation.x() += 0.5;
  }
}

TEST(PlaceContest, MatchesOfAScanAreBounded) {
  Scenery scenery;
  scenery.num_matched_there = 850;
  std::vector<Pose> many;
  for (int i = 0; i < 50; ++i) many.push_back(At(29.0 + 0.05 * i));
  many.push_back(At(-40.0));
  PlaceContest contest(CloudSample{}, many, CandidateCov());
  const MatchInInitial match = scenery.Matcher();
  EXPECT_FALSE(contest.Rank(match));
  EXPECT_EQ(scenery.num_calls, kContest.max_coarse_per_scan);
  while (!contest.Rank(match)) {
  }
  const MatchResult in_new_map = InNewMap();
  for (const int max_matches : {0, 1, 2}) {
    scenery.num_calls = 0;
    EXPECT_FALSE(contest.Check({{}, in_new_map}, match, max_matches));
    EXPECT_EQ(scenery.num_calls, max_matches);
  }
}

TEST(PlaceContest, WithoutPlacesItIsOverAtOnce) {
  Scenery scenery;
  PlaceContest contest(CloudSample{}, {}, CandidateCov());
  EXPECT_TRUE(contest.Rank(scenery.Matcher()));
  EXPECT_TRUE(contest.is_over());
}

}  // namespace
}  // namespace lio
