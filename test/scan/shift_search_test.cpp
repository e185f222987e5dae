// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/shift_search.hpp"

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

TEST(FindShift, FindsFastMotionAmongThingsThatStand) {
  const UprightView before(Wood({0.f, 0.f}));
  for (const Eigen::Vector2f& shift :
       {Eigen::Vector2f(2.8f, -0.7f), Eigen::Vector2f(-4.9f, 1.2f), Eigen::Vector2f(0.05f, 0.1f)}) {
    const auto found = FindShift(before, UprightView(Wood(shift)));
    ASSERT_TRUE(found);
    EXPECT_LT((*found - shift).norm(), 0.3f) << found->transpose() << " for " << shift.transpose();
  }
}

TEST(FindShift, SaysNothingWhereTheWayLooksTheSameAllAlong) {
  const UprightView before(Corridor({0.f, 0.f}));
  EXPECT_FALSE(FindShift(before, UprightView(Corridor({1.5f, 0.f}))));
}

TEST(FindShift, SaysNothingOnBareGround) {
  Points points;
  AddRings(points);
  EXPECT_FALSE(FindShift(UprightView(points), UprightView(points)));
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
