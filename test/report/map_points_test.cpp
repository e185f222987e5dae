// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "report/map_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace lio {
namespace {

std::string Base64Of(const std::string& text) {
  return Base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

// These are the examples of RFC 4648, chapter 10.
TEST(Base64, AgreesWithTheStandard) {
  EXPECT_EQ(Base64Of(""), "");
  EXPECT_EQ(Base64Of("f"), "Zg==");
  EXPECT_EQ(Base64Of("fo"), "Zm8=");
  EXPECT_EQ(Base64Of("foo"), "Zm9v");
  EXPECT_EQ(Base64Of("foobar"), "Zm9vYmFy");
}

TEST(MapPoints, OfACellTheHighestIsLeft) {
  const std::vector<Eigen::Vector3f> points = {
      {0.05f, 0.05f, 0.0f}, {0.05f, 0.05f, 3.0f}, {0.05f, 0.05f, 1.0f}, {5.05f, 0.05f, 0.0f}};
  const auto json = MapPointsJson(points);
  EXPECT_EQ(json["count"], 2);
  EXPECT_FLOAT_EQ(json["origin"][2], 0.0f);
  EXPECT_NEAR(json["step_m"], 1e-3, 1e-9);
  // The first point is 0, 0, 3000 steps from the corner, the second 5000, 0, 0.
  EXPECT_EQ(json["xyz"],
            Base64(std::vector<std::uint8_t>{0, 0, 0, 0, 0xb8, 0x0b, 0x88, 0x13, 0, 0, 0, 0}));
}

TEST(MapPoints, LargeMapsAreThinnedToTheMost) {
  std::vector<Eigen::Vector3f> points;
  for (int x = 0; x < 400; ++x) {
    for (int y = 0; y < 400; ++y) {
      points.emplace_back(0.5f * static_cast<float>(x), 0.5f * static_cast<float>(y), 0.0f);
    }
  }
  const auto json = MapPointsJson(points);
  EXPECT_LE(json["count"], kMaxMapPoints);
  EXPECT_GT(json["count"], kMaxMapPoints / 4);
  EXPECT_GT(json["cell_m"], 0.5);
}

TEST(MapPoints, WithoutFinitePointsThereIsNoMap) {
  EXPECT_TRUE(MapPointsJson({}).is_null());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(MapPointsJson(std::vector<Eigen::Vector3f>{{nan, 0, 0}, {0, 1e30f, 0}}).is_null());
}

}  // namespace
}  // namespace lio
