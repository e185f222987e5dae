// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/velocity_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/standing_things.hpp"

namespace lio {
namespace {

using test::AddPost;
using test::AddRings;
using test::Points;

Points WoodOnTheGround(const Eigen::Vector2f& sensor) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> place(-40.f, 40.f);
  Points points;
  AddRings(points);
  for (int i = 0; i < 80; ++i) {
    const float x = place(random);
    AddPost({x, place(random)}, sensor, points);
  }
  return points;
}

Points Corridor(const Eigen::Vector2f& sensor) {
  Points points;
  AddRings(points);
  for (float x = -30.f; x < 30.f; x += 0.2f) {
    AddPost({sensor.x() + x, 5.f}, sensor, points);
    AddPost({sensor.x() + x, -5.f}, sensor, points);
  }
  return points;
}

// Returns three scans, 0.1 s apart, of a sensor with that velocity.
template <class Place>
VelocitySearch Drive(const Place& points_at, const Eigen::Vector2f& v_mps) {
  VelocitySearch search;
  for (int i = 0; i < 3; ++i) {
    const float t_s = 0.1f * static_cast<float>(i);
    search.Add(Timestamp{i * 100'000'000}, points_at(t_s * v_mps));
  }
  return search;
}

TEST(VelocitySearch, FindsFastMotionAmongThingsThatStand) {
  for (const Eigen::Vector2f& v_mps :
       {Eigen::Vector2f(28.f, -7.f), Eigen::Vector2f(-39.f, 2.f), Eigen::Vector2f(0.2f, 0.1f)}) {
    const auto found = Drive(WoodOnTheGround, v_mps).Find().v_mps;
    ASSERT_TRUE(found);
    EXPECT_LT((*found - v_mps).norm(), 1.0f) << found->transpose() << " for " << v_mps.transpose();
  }
}

// Posts stand every 2 m: two scans fit at many velocities, and traffic beside moves along.
TEST(VelocitySearch, TellsVelocitiesApartByPairsOfDifferentSpacing) {
  const auto motorway = [](const Eigen::Vector2f& sensor) {
    Points points;
    AddRings(points);
    for (int i = -30; i < 30; ++i) {  // no two gaps between the posts of a real rail are the same
      const float x = 2.f * static_cast<float>(i) + 0.3f * std::sin(static_cast<float>(i * i));
      AddPost({x, 6.f}, sensor, points);
    }
    for (int i = 0; i < 12; ++i) {
      AddPost({9.f * static_cast<float>(i) - 50.f, i % 2 == 0 ? 9.f : -8.f}, sensor, points);
    }
    for (int i = 0; i < 8; ++i)
      AddPost(sensor + Eigen::Vector2f(12.f + 0.5f * static_cast<float>(i), -3.5f), sensor, points);
    return points;
  };
  const auto found = Drive(motorway, {30.f, 0.f}).Find().v_mps;
  ASSERT_TRUE(found);
  EXPECT_LT((*found - Eigen::Vector2f(30.f, 0.f)).norm(), 1.5f) << found->transpose();
}

// Adds a tower of 9 m, as the beams of a sensor at `sensor` see it.
void AddTower(const Eigen::Vector2f& place, const Eigen::Vector2f& sensor, Points& points) {
  const Eigen::Vector2f seen = place - sensor;
  for (int i = 0; i < 30; ++i) {
    points.emplace_back(seen.x(), seen.y(), -1.8f + 0.3f * static_cast<float>(i));
  }
}

// Forty vehicles go along, two thirds of what is seen.
Points RoadFullOfTraffic(const Eigen::Vector2f& sensor, int num_towers) {
  Points points;
  AddRings(points);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<float> along(-40.f, 40.f);
  for (int i = 0; i < 40; ++i) {
    AddPost(sensor + Eigen::Vector2f(along(random), i % 2 == 0 ? 4.f : -4.f), sensor, points);
  }
  for (int i = 0; i < num_towers; ++i) {
    AddTower({along(random), i % 2 == 0 ? 14.f : -14.f}, sensor, points);
  }
  return points;
}

TEST(VelocitySearch, WhatIsHigherThanAnyVehicleGoesBeforeTrafficThatGoesAlong) {
  const auto road = [](const Eigen::Vector2f& sensor) { return RoadFullOfTraffic(sensor, 25); };
  const SeenVelocity seen = Drive(road, {9.f, 0.f}).Find();
  ASSERT_TRUE(seen.v_mps);
  EXPECT_LT((*seen.v_mps - Eigen::Vector2f(9.f, 0.f)).norm(), 1.5f) << seen.v_mps->transpose();
  ASSERT_TRUE(seen.by_buildings);
  EXPECT_GT(seen.by_buildings->min_mps, 5.0);
  EXPECT_LT(seen.by_buildings->max_mps, 13.0);
}

TEST(VelocitySearch, AFewTowersTellNothingOfTheirOwn) {
  const auto road = [](const Eigen::Vector2f& sensor) { return RoadFullOfTraffic(sensor, 5); };
  const SeenVelocity seen = Drive(road, {9.f, 0.f}).Find();
  ASSERT_TRUE(seen.v_mps);
  EXPECT_LT(seen.v_mps->norm(), 1.5f) << "that of the traffic";
  EXPECT_FALSE(seen.by_buildings);
}

// The first scan sees too few towers, so that two of three would have to tell the velocity.
TEST(VelocitySearch, TowersCountWhereEveryScanSeesEnough) {
  VelocitySearch search;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2f sensor(0.9f * static_cast<float>(i), 0.f);
    search.Add(Timestamp{i * 100'000'000}, RoadFullOfTraffic(sensor, i == 0 ? 5 : 25));
  }
  const SeenVelocity seen = search.Find();
  EXPECT_FALSE(seen.is_of_buildings);
  EXPECT_FALSE(seen.by_buildings);
}

TEST(VelocitySearch, SaysNothingWhereTheWayLooksTheSameAllAlong) {
  EXPECT_FALSE(Drive(Corridor, {15.f, 0.f}).Find().v_mps);
}

TEST(VelocitySearch, SaysNothingOfBareGroundOrASingleScan) {
  Points points;
  AddRings(points);
  EXPECT_FALSE(Drive([&](const Eigen::Vector2f&) { return points; }, {5.f, 0.f}).Find().v_mps);
  VelocitySearch search;
  search.Add(Timestamp{0}, WoodOnTheGround({0.f, 0.f}));
  EXPECT_FALSE(search.Find().v_mps);
}

}  // namespace
}  // namespace lio
