// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/place_width.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace lio {
namespace {

// Returns points in so many cells of a metre, a hundred in each.
std::vector<Eigen::Vector3f> PointsIn(int num_cells) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < num_cells; ++i) {
    const auto x = static_cast<float>(i % 20);
    const auto y = static_cast<float>(i / 20);
    for (int k = 0; k < 100; ++k) {
      points.emplace_back(x - 9.8f + 0.005f * static_cast<float>(k), y + 0.3f, -0.5f);
    }
  }
  return points;
}

TEST(PlaceWidth, FirstScanDecides) {
  PlaceWidth width;
  EXPECT_TRUE(width.is_unknown());
  EXPECT_FALSE(width.is_narrow());
  width.Add(PointsIn(149), 1.0);
  EXPECT_FALSE(width.is_unknown());
  EXPECT_TRUE(width.is_narrow());
  PlaceWidth wide;
  wide.Add(PointsIn(151), 1.0);
  EXPECT_FALSE(wide.is_narrow());
}

TEST(PlaceWidth, CellsAreCountedInEdges) {
  PlaceWidth width;
  width.Add(PointsIn(200), 4.0);  // 6 by 3 cells
  EXPECT_TRUE(width.is_narrow());
}

TEST(PlaceWidth, ItTurnsWideOnlyWhereTheMeanIsClearlyWide) {
  PlaceWidth width;
  width.Add(PointsIn(30), 1.0);
  for (int i = 0; i < 100; ++i) width.Add(PointsIn(200), 1.0);
  EXPECT_TRUE(width.is_narrow());
  for (int i = 0; i < 100; ++i) width.Add(PointsIn(240), 1.0);
  EXPECT_FALSE(width.is_narrow());
  for (int i = 0; i < 100; ++i) width.Add(PointsIn(200), 1.0);
  EXPECT_FALSE(width.is_narrow());
}

TEST(PlaceWidth, AGlanceAtAWallMakesNoPlaceNarrow) {
  PlaceWidth width;
  width.Add(PointsIn(300), 1.0);
  for (int i = 0; i < 3; ++i) width.Add(PointsIn(5), 1.0);
  EXPECT_FALSE(width.is_narrow());
  for (int i = 0; i < 20; ++i) width.Add(PointsIn(5), 1.0);
  EXPECT_TRUE(width.is_narrow());
}

TEST(PlaceWidth, PointsThatAreNoNumbersOrBeyondAllPlacesDoNotCount) {
  std::vector<Eigen::Vector3f> points = PointsIn(149);
  for (int i = 0; i < 10; ++i) {
    points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.f, static_cast<float>(i));
    points.emplace_back(1e30f, 0.f, static_cast<float>(i));
  }
  PlaceWidth width;
  width.Add(points, 1.0);
  EXPECT_TRUE(width.is_narrow());
}

TEST(PlaceWidth, AScanOfFewPointsTellsNothing) {
  PlaceWidth width;
  width.Add({}, 1.0);
  width.Add(PointsIn(2), 1.0);
  EXPECT_TRUE(width.is_unknown());
}

}  // namespace
}  // namespace lio
