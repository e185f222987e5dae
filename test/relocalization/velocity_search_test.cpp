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
    const auto found = Drive(WoodOnTheGround, v_mps).Find();
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
  const auto found = Drive(motorway, {30.f, 0.f}).Find();
  ASSERT_TRUE(found);
  EXPECT_LT((*found - Eigen::Vector2f(30.f, 0.f)).norm(), 1.5f) << found->transpose();
}

TEST(VelocitySearch, SaysNothingWhereTheWayLooksTheSameAllAlong) {
  EXPECT_FALSE(Drive(Corridor, {15.f, 0.f}).Find());
}

TEST(VelocitySearch, SaysNothingOfBareGroundOrASingleScan) {
  Points points;
  AddRings(points);
  EXPECT_FALSE(Drive([&](const Eigen::Vector2f&) { return points; }, {5.f, 0.f}).Find());
  VelocitySearch search;
  search.Add(Timestamp{0}, WoodOnTheGround({0.f, 0.f}));
  EXPECT_FALSE(search.Find());
}

}  // namespace
}  // namespace lio
