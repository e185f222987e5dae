// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/map_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace lio {
namespace {

using Points2 = std::vector<Eigen::Vector2f>;
using Points3 = std::vector<Eigen::Vector3f>;

constexpr std::int64_t kUnlimited = 1'000'000'000;

// Returns things at random places of a square of 300 m.
Points2 ThingsOfAWood() {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> coordinate(-150.f, 150.f);
  Points2 things;
  for (int i = 0; i < 900; ++i) {
    const float x = coordinate(random);
    things.emplace_back(x, coordinate(random));
  }
  return things;
}

// Returns the things within 30 m of `pose`, in its axes.
Points3 SeenFrom(const PlanarPose& pose, const Points2& things) {
  Points3 seen;
  for (const Eigen::Vector2f& thing : things) {
    const Eigen::Vector2f at = Eigen::Rotation2Df(-pose.turn_rad) * (thing - pose.shift_m);
    if (at.norm() < 30.f) seen.emplace_back(at.x(), at.y(), 0.f);
  }
  return seen;
}

double OffRad(const PlanarPose& a, const PlanarPose& b) {
  return std::abs(std::remainder(a.turn_rad - b.turn_rad, 2.0 * M_PI));
}

TEST(MapSearch, FindsThePlaceAnywhereAtAnyTurn) {
  const Points2 wood = ThingsOfAWood();
  const StructurePyramid pyramid = StructurePyramid::FromAbove(wood);
  for (const PlanarPose& truth : {PlanarPose{{80.f, -41.f}, 0.6f}, PlanarPose{{0.f, 0.f}, 0.f},
                                  PlanarPose{{-92.f, 106.f}, -2.9f}}) {
    MapSearch search(pyramid, SeenFrom(truth, wood), {0.f, 0.f, 0.f}, {});
    ASSERT_TRUE(search.GoOn(kUnlimited));
    ASSERT_FALSE(search.places().empty());
    const PlanarPose& best = search.places().front().pose;
    EXPECT_LT((best.shift_m - truth.shift_m).norm(), 0.8f) << truth.shift_m.transpose();
    EXPECT_LT(OffRad(best, truth), 0.03);
  }
}

TEST(MapSearch, TheTurnMayBeAboutAnyCentre) {
  const Points2 wood = ThingsOfAWood();
  const StructurePyramid pyramid = StructurePyramid::FromAbove(wood);
  const PlanarPose truth{{40.f, 25.f}, 1.1f};
  MapSearch search(pyramid, SeenFrom(truth, wood), {6.f, -4.f, 0.f}, {});
  ASSERT_TRUE(search.GoOn(kUnlimited));
  ASSERT_FALSE(search.places().empty());
  EXPECT_LT((search.places().front().pose.shift_m - truth.shift_m).norm(), 1.f);
}

TEST(MapSearch, SmallStepsGiveTheSamePlaces) {
  const Points2 wood = ThingsOfAWood();
  const StructurePyramid pyramid = StructurePyramid::FromAbove(wood);
  const Points3 seen = SeenFrom({{80.f, -41.f}, 0.6f}, wood);
  MapSearch at_once(pyramid, seen, {0.f, 0.f, 0.f}, {});
  MapSearch in_steps(pyramid, seen, {0.f, 0.f, 0.f}, {});
  ASSERT_TRUE(at_once.GoOn(kUnlimited));
  int num_steps = 0;
  while (!in_steps.GoOn(50'000)) ++num_steps;
  EXPECT_GT(num_steps, 2);
  ASSERT_EQ(in_steps.places().size(), at_once.places().size());
  for (std::size_t i = 0; i < at_once.places().size(); ++i) {
    EXPECT_EQ(in_steps.places()[i].pose.shift_m, at_once.places()[i].pose.shift_m);
    EXPECT_EQ(in_steps.places()[i].score, at_once.places()[i].score);
  }
}

TEST(MapSearch, SeeksOnlyAroundAGuess) {
  const Points2 wood = ThingsOfAWood();
  const StructurePyramid pyramid = StructurePyramid::FromAbove(wood);
  const PlanarPose truth{{80.f, -41.f}, 0.6f};
  const Points3 seen = SeenFrom(truth, wood);
  const PlanarRange range{{10.f, 10.f}, 0.5f};
  MapSearch near(pyramid, seen, {0.f, 0.f, 0.f}, MapSearch::Around{{{86.f, -35.f}, 0.9f}, range});
  ASSERT_TRUE(near.GoOn(kUnlimited));
  ASSERT_FALSE(near.places().empty());
  EXPECT_LT((near.places().front().pose.shift_m - truth.shift_m).norm(), 0.8f);
  MapSearch far(pyramid, seen, {0.f, 0.f, 0.f}, MapSearch::Around{{{0.f, 0.f}, 0.6f}, range});
  ASSERT_TRUE(far.GoOn(kUnlimited));
  for (const ScoredPlace& place : far.places()) {
    EXPECT_LT(place.pose.shift_m.cwiseAbs().maxCoeff(), 10.6f);
  }
}

// Two places that look alike both come out, so that somebody else decides.
TEST(MapSearch, GivesEachOfTwoPlacesThatLookAlike) {
  const Points3 seen = SeenFrom({{0.f, 0.f}, 0.f}, ThingsOfAWood());
  Points2 twice;
  for (const Eigen::Vector3f& thing : seen) {
    twice.emplace_back(thing.head<2>());
    twice.push_back(twice.back() + Eigen::Vector2f(90.f, 0.f));
  }
  const StructurePyramid pyramid = StructurePyramid::FromAbove(twice);
  MapSearch search(pyramid, seen, {0.f, 0.f, 0.f}, {});
  ASSERT_TRUE(search.GoOn(kUnlimited));
  ASSERT_GE(search.places().size(), 2u);
  const float sum_m = search.places()[0].pose.shift_m.x() + search.places()[1].pose.shift_m.x();
  EXPECT_NEAR(sum_m, 90.f, 1.5f);
}

TEST(MapSearch, FindsNothingForThingsThatAreNotInTheMap) {
  const StructurePyramid pyramid = StructurePyramid::FromAbove(Points2{{0.f, 0.f}, {50.f, 20.f}});
  MapSearch search(pyramid, SeenFrom({{0.f, 0.f}, 0.f}, ThingsOfAWood()), {0.f, 0.f, 0.f}, {});
  EXPECT_TRUE(search.GoOn(kUnlimited));
  EXPECT_TRUE(search.places().empty());
  MapSearch nothing(pyramid, Points3{}, {0.f, 0.f, 0.f}, {});
  EXPECT_TRUE(nothing.GoOn(kUnlimited));
  EXPECT_TRUE(nothing.places().empty());
}

// Returns points at random places of two storeys that differ.
Points3 TwoStoreys() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<float> share(0.f, 1.f);
  Points3 points;
  for (int i = 0; i < 600; ++i) {
    const float x = 20.f * share(random);
    const float y = 10.f * share(random);
    points.emplace_back(x, y, 5.f * share(random));
  }
  return points;
}

TEST(MapSearch, FindsTheStoreyOfABuilding) {
  const Points3 building = TwoStoreys();
  const StructurePyramid pyramid = StructurePyramid::InBuilding(building);
  for (const float height_m : {1.1f, 3.8f}) {
    const PlanarPose truth{{7.3f, 4.2f}, 2.3f};
    Points3 seen;
    for (const Eigen::Vector3f& point : building) {
      const Eigen::Vector2f at =
          Eigen::Rotation2Df(-truth.turn_rad) * (point.head<2>() - truth.shift_m);
      const Eigen::Vector3f from_body(at.x(), at.y(), point.z() - height_m);
      if (from_body.norm() < 5.f) seen.push_back(from_body);
    }
    MapSearch search(pyramid, seen, {0.5f, -0.3f, 0.2f}, {});
    ASSERT_TRUE(search.GoOn(kUnlimited));
    ASSERT_FALSE(search.places().empty());
    const ScoredPlace& best = search.places().front();
    EXPECT_LT((best.pose.shift_m - truth.shift_m).norm(), 0.4f);
    EXPECT_NEAR(best.height_m, height_m, 0.3f);
    EXPECT_LT(OffRad(best.pose, truth), 0.05);
    MapSearch elsewhere(pyramid, seen, {0.5f, -0.3f, 0.2f},
                        MapSearch::Around{truth, {{10.f, 10.f}, 0.5f}, height_m + 3.f, 1.f});
    ASSERT_TRUE(elsewhere.GoOn(kUnlimited));
    for (const ScoredPlace& place : elsewhere.places()) {
      EXPECT_NEAR(place.height_m, height_m + 3.f, 1.3f);
    }
  }
}

}  // namespace
}  // namespace lio
