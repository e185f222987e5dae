// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/velocity_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lio {
namespace {

using Points = std::vector<Eigen::Vector3f>;

// Rings on the ground, the same wherever the sensor is.
void AddRings(Points& points) {
  for (const float radius : {4.f, 5.f, 6.5f, 9.f, 14.f, 25.f}) {
    for (int i = 0; i < 360; ++i) {
      const float angle = static_cast<float>(i) * 0.0174533f;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -1.8f);
    }
  }
}

// A post, as the beams of a sensor at `sensor` see it.
void AddPost(const Eigen::Vector2f& place, const Eigen::Vector2f& sensor, Points& points) {
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector2f seen = place - sensor;
    points.emplace_back(seen.x(), seen.y(), -1.8f + 0.3f * static_cast<float>(i));
  }
}

Points Wood(const Eigen::Vector2f& sensor) {
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

// Three scans, 0.1 s apart, of a sensor with that velocity.
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
    const auto found = Drive(Wood, v_mps).Find();
    ASSERT_TRUE(found);
    EXPECT_LT((*found - v_mps).norm(), 1.0f) << found->transpose() << " for " << v_mps.transpose();
  }
}

// Posts every 2 m: two scans fit at many velocities, and traffic beside goes along.
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
  search.Add(Timestamp{0}, Wood({0.f, 0.f}));
  EXPECT_FALSE(search.Find());
}

TEST(UprightView, DoesNotCountGround) {
  Points points;
  AddRings(points);
  EXPECT_TRUE(UprightView(points).places().empty());
  AddPost({7.f, 3.f}, {0.f, 0.f}, points);
  const UprightView view(points);
  ASSERT_EQ(view.places().size(), 1u);
  EXPECT_TRUE(view.IsNear({7.1f, 2.9f}));
  EXPECT_FALSE(view.IsNear({8.f, 3.f}));
}

}  // namespace
}  // namespace lio
