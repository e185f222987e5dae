// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/place_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::Points;

Eigen::Matrix2f TurnBy(float angle_rad) {
  return Eigen::Rotation2Df(angle_rad).toRotationMatrix();
}

// Returns posts at random places, as seen from `sensor`.
Points WoodSeenFrom(const PlanarPose& sensor, unsigned seed = 4) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> coordinate(-50.f, 50.f);
  Points points;
  for (int i = 0; i < 80; ++i) {
    const float x = coordinate(random);
    const Eigen::Vector2f place(x, coordinate(random));
    test::AddPost(TurnBy(-sensor.turn_rad) * (place - sensor.shift_m), {0.f, 0.f}, points);
  }
  return points;
}

double AngleBetween(float a_rad, float b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, 2.0 * M_PI));
}

const PlanarRange kFarAround{{12.f, 12.f}, 3.15f};

TEST(PlaceSearch, FindsWhereTheSensorIsAfterItWasBlind) {
  for (const PlanarPose& truth : {PlanarPose{{7.3f, -4.1f}, 0.6f}, PlanarPose{{0.f, 0.f}, 0.f},
                                  PlanarPose{{-9.2f, 10.6f}, -2.9f}}) {
    const auto found = FindPlaces(BirdsEyeView(WoodSeenFrom({})), BirdsEyeView(WoodSeenFrom(truth)),
                                  PlanarPose{}, kFarAround);
    ASSERT_FALSE(found.empty());
    EXPECT_LT((found.front().shift_m - truth.shift_m).norm(), 0.4f) << truth.shift_m.transpose();
    EXPECT_LT(AngleBetween(found.front().turn_rad, truth.turn_rad), 0.015);
  }
}

TEST(PlaceSearch, SeeksAroundWhereItIsTold) {
  const PlanarPose truth{{25.f, 3.f}, 0.2f};
  const PlanarRange range{{3.f, 3.f}, 0.1f};
  const auto found = FindPlaces(BirdsEyeView(WoodSeenFrom({})), BirdsEyeView(WoodSeenFrom(truth)),
                                PlanarPose{{24.f, 2.f}, 0.25f}, range);
  ASSERT_FALSE(found.empty());
  EXPECT_LT((found.front().shift_m - truth.shift_m).norm(), 0.4f);
}

TEST(PlaceSearch, TellsSeveralPlacesThatDiffer) {
  const auto found =
      FindPlaces(BirdsEyeView(WoodSeenFrom({})), BirdsEyeView(WoodSeenFrom({}, 5)), {}, kFarAround);
  ASSERT_GT(found.size(), 1u);
  for (std::size_t i = 1; i < found.size(); ++i) {
    const bool differs = (found[i].shift_m - found[0].shift_m).norm() > 1.f ||
                         AngleBetween(found[i].turn_rad, found[0].turn_rad) > 0.05;
    EXPECT_TRUE(differs);
  }
}

TEST(PlaceSearch, FindsNothingWhereNothingStands) {
  const BirdsEyeView bare(Points{{5.f, 0.f, -1.8f}, {0.f, 5.f, -1.8f}});
  EXPECT_TRUE(FindPlaces(bare, BirdsEyeView(WoodSeenFrom({})), {}, kFarAround).empty());
  EXPECT_TRUE(FindPlaces(BirdsEyeView(WoodSeenFrom({})), bare, {}, kFarAround).empty());
}

}  // namespace
}  // namespace lio
