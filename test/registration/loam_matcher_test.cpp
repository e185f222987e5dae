// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the promises of LOAM's matching against maps alone; test/contract/matcher_contract_test.cpp
// has those of every matcher.
#include "lio/registration/loam_matcher.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "support/method_bench.hpp"

namespace lio {
namespace {

// Returns a room of three walls and four posts; the walls' points are tagged as surfaces, the
// posts' as edges.
struct Room {
  explicit Room(unsigned seed, bool has_walls = true) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-4.f, 4.f);
    for (int i = 0; i < 1500 && has_walls; ++i) {
      Eigen::Vector3f point = {place(random), place(random), place(random)};
      point[i % 3] = 5.f;
      points.push_back(point);
      tags.push_back({FeatureKind::kFlat, 0});
    }
    for (int i = 0; i < 400; ++i) {
      const float x = i % 2 == 0 ? 3.f : -3.f, y = i % 4 < 2 ? 2.f : -2.f;
      points.emplace_back(x, y, place(random));
      tags.push_back({FeatureKind::kSharp, 0});
    }
  }
  ScanView View() const { return {points, tags}; }
  MatchInput From(const Pose& guess) const {
    MatchInput input;
    input.points_imu = points;
    input.tags = tags;
    input.T_map_imu_guess = guess;
    input.guess_cov = test::GuessCov(0.1, 0.01);
    return input;
  }
  std::vector<Eigen::Vector3f> points;
  std::vector<FeatureTag> tags;
};

const Pose kOff{ExpSo3(Vector3(0.01, -0.008, 0.012)), Vector3(0.08, -0.06, 0.05)};

TEST(LoamMatcher, FindsItsWayBackInARoom) {
  LoamMatcher matcher{LoamOptions{}};
  for (unsigned seed = 1; seed <= 5; ++seed) matcher.Insert(Room(seed).View(), Pose::Identity());
  const Room scan(9);
  const MatchResult result = matcher.Match(scan.From(kOff));
  ASSERT_EQ(result.status, MatchStatus::kConverged);
  EXPECT_LT(LogSe3(result.T_map_imu).head<3>().norm(), 0.01);
  EXPECT_LT(LogSe3(result.T_map_imu).tail<3>().norm(), 0.002);
}

// Posts alone do not hold the height.
TEST(LoamMatcher, VerticalEdgesAloneConstrainAllButTheHeight) {
  LoamMatcher matcher{LoamOptions{}};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    matcher.Insert(Room(seed, false).View(), Pose::Identity());
  }
  const Room scan(9, false);
  const MatchResult result =
      matcher.Match(scan.From(Pose{Quaternion::Identity(), {0.05, 0.05, 0.3}}));
  ASSERT_EQ(result.status, MatchStatus::kDegenerate);
  EXPECT_LT(result.T_map_imu.translation.head<2>().norm(), 0.02);
  EXPECT_NEAR(result.T_map_imu.translation.z(), 0.3, 0.05) << "it stays where it was guessed";
  EXPECT_GT(result.cov(2, 2), 100.0);
  EXPECT_LT(result.observable_cov(0, 0), 0.01);
}

// The tag decides against which map a point is matched.
TEST(LoamMatcher, SurfacesAreNotMatchedWithEdges) {
  LoamMatcher matcher{LoamOptions{}};
  matcher.Insert(Room(1, false).View(), Pose::Identity());
  Room scan(2, false);
  for (FeatureTag& tag : scan.tags) tag.kind = FeatureKind::kLessFlat;
  const MatchResult result = matcher.Match(scan.From(Pose::Identity()));
  EXPECT_EQ(result.status, MatchStatus::kTooFewPoints);
  EXPECT_EQ(result.num_matched, 0);
}

TEST(LoamMatcher, PointsWithoutTagsAreACallersMistake) {
  LoamMatcher matcher{LoamOptions{}};
  const Room room(1);
  EXPECT_THROW(matcher.Insert({room.points, {}}, Pose::Identity()), std::invalid_argument);
  matcher.Insert(room.View(), Pose::Identity());
  MatchInput input = room.From(Pose::Identity());
  input.tags = input.tags.subspan(1);
  EXPECT_THROW((void)matcher.Match(input), std::invalid_argument);
}

TEST(LoamMatcher, BothMapsCountInItsSizeAndAreCleared) {
  LoamMatcher matcher{LoamOptions{}};
  matcher.Insert(Room(1, false).View(), Pose::Identity());
  const std::size_t num_edges = matcher.map_size().num_cells;
  EXPECT_GT(num_edges, 40u);
  matcher.Insert(Room(1).View(), Pose::Identity());
  EXPECT_GT(matcher.map_size().num_cells, num_edges + 500);
  matcher.Clear();
  EXPECT_EQ(matcher.map_size().num_cells, 0u);
  EXPECT_EQ(matcher.Match(Room(2).From(kOff)).status, MatchStatus::kEmptyMap);
}

}  // namespace
}  // namespace lio
