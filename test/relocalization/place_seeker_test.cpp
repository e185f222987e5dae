// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The stages and their bounds; test/pipeline/initial_map_entry_test.cpp seeks in a street.
#include "lio/relocalization/place_seeker.hpp"

#include <gtest/gtest.h>

#include <random>

#include "lio/relocalization/parameters.hpp"
#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::Points;

// Returns posts at random places around the origin, and the ground.
Points WoodAroundTheOrigin(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> coordinate(-35.f, 35.f);
  Points points;
  for (int i = 0; i < 60; ++i) {
    const float x = coordinate(random);
    test::AddColumn({x, coordinate(random)}, points);
  }
  test::AddRings(points);
  return points;
}

MatchResult Located(const Pose& T_map_imu = Pose::Identity()) {
  MatchResult match;
  match.status = MatchStatus::kConverged;
  match.T_map_imu = T_map_imu;
  match.num_matched = 1000;
  match.num_in_map = 1000;
  match.observability.noise = Matrix6::Identity();
  match.observability.counted = 20.0 * Matrix6::Identity();
  return match;
}

// All guesses near the origin come there.
MatchResult MatchNearOrigin(const Pose& guess) {
  MatchResult result = Located(guess);
  const bool is_near = guess.translation.norm() < 3.0;
  if (is_near) result.T_map_imu = Pose::Identity();
  result.num_matched = is_near ? 980 : 300;
  return result;
}

struct Counts {
  int num_matches = 0;
  int num_coarse = 0;
};

PlaceMatching Matching(Counts& counts) {
  return {[&](std::span<const Eigen::Vector3f>, const Pose& guess, const Matrix6&) {
            ++counts.num_matches;
            return MatchNearOrigin(guess);
          },
          [&](std::span<const Eigen::Vector3f>, const Pose& guess, const Matrix6&) {
            ++counts.num_coarse;
            return MatchNearOrigin(guess);
          },
          2};
}

TEST(PlaceSeeker, FindsThePlaceWithABoundForEachScan) {
  const Points wood = WoodAroundTheOrigin(1);
  const PlaceIndex index(wood);
  PlaceSeeker seeker(index, {});
  std::optional<FoundPlace> found;
  int num_scans = 0;
  const MatchResult match = Located();
  for (; !found && num_scans < 50; ++num_scans) {
    Counts counts;
    found = seeker.Add({wood, match}, wood, Matching(counts));
    EXPECT_LE(counts.num_matches, 2);
    EXPECT_LE(counts.num_coarse, kRelocalization.contest.max_coarse_per_scan);
  }
  ASSERT_TRUE(found);
  EXPECT_LT(found->T_initial_map.translation.norm(), 1e-6);
  EXPECT_GE(num_scans, kRelocalization.seeker.min_scans + kRelocalization.contest.num_checks);
}

TEST(PlaceSeeker, SeeksAgainInTheNextNewMap) {
  const Points wood = WoodAroundTheOrigin(1);
  const PlaceIndex index(wood);
  PlaceSeeker seeker(index, {});
  const MatchResult match = Located();
  for (int k = 0; k < 2; ++k) {
    std::optional<FoundPlace> found;
    for (int i = 0; !found && i < 50; ++i) {
      Counts counts;
      found = seeker.Add({wood, match}, wood, Matching(counts));
    }
    EXPECT_TRUE(found);
    seeker.Clear();
  }
}

TEST(PlaceSeeker, FindsNothingOutsideTheMap) {
  const PlaceIndex index(WoodAroundTheOrigin(1));
  const Points elsewhere = WoodAroundTheOrigin(2);
  PlaceSeeker seeker(index, {});
  for (int i = 0; i < 60; ++i) {
    const Pose T_map_imu{Quaternion::Identity(), Vector3(0.2 * i, 0, 0)};
    const MatchResult match = Located(T_map_imu);
    const PlaceMatching matching{
        [](std::span<const Eigen::Vector3f>, const Pose& guess, const Matrix6&) {
          MatchResult result = Located(guess);
          result.num_matched = 500;
          return result;
        },
        [](std::span<const Eigen::Vector3f>, const Pose& guess, const Matrix6&) {
          return Located(guess);
        },
        2};
    EXPECT_FALSE(seeker.Add({elsewhere, match}, elsewhere, matching));
  }
}

}  // namespace
}  // namespace lio
