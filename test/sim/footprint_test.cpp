// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/footprint.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio::sim {
namespace {

Hit Wall(float range_m) {
  Hit hit;
  hit.range_m = range_m;
  hit.material = Material::kPlaster;
  hit.object = Hit::kFixed;
  return hit;
}

Rim EdgeOnTheLeft(const Hit& beyond) {
  Rim rim;
  rim.hits[0] = beyond;
  rim.is_beyond_edge[0] = true;
  return rim;
}

TEST(Footprint, AChordCutsASegmentOff) {
  EXPECT_DOUBLE_EQ(ShareBeyondChord(0.0), 0.5);
  EXPECT_DOUBLE_EQ(ShareBeyondChord(1.0), 0.0);
  EXPECT_NEAR(ShareBeyondChord(0.5), (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / M_PI, 1e-12);
}

TEST(Footprint, WithoutAnEdgeTheCentreIsReturned) {
  const Echo echo = EchoOfFootprint(Wall(10.0f), Rim(), {8.0f, 1.0}, 1);
  EXPECT_EQ(echo.range_m, 10.0);
  EXPECT_EQ(echo.strength, 1.0);
  EXPECT_EQ(echo.kind, EchoKind::kSurface);
}

TEST(Footprint, NearSurfacesMergeNearTheStrongerOne) {
  for (std::uint64_t key = 0; key < 100; ++key) {
    const Echo echo = EchoOfFootprint(Wall(10.0f), EdgeOnTheLeft(Wall(10.5f)), {3.0f, 0.0}, key);
    EXPECT_GE(echo.range_m, 10.0);
    EXPECT_LT(echo.range_m, 10.25);  // at most half of the light falls beyond the edge
    EXPECT_EQ(echo.kind == EchoKind::kInBetween, echo.range_m - 10.0 > 0.05);
  }
}

TEST(Footprint, FarSurfacesGiveAnEchoInBetweenAsOftenAsTold) {
  int num_between = 0;
  for (std::uint64_t key = 0; key < 1000; ++key) {
    const Echo echo =
        EchoOfFootprint(Wall(10.0f), EdgeOnTheLeft(Wall(14.0f)), {8.0f, 0.6}, 1000 * key);
    const bool is_between = echo.range_m > 10.0 && echo.range_m < 14.0;
    num_between += is_between ? 1 : 0;
    EXPECT_TRUE(is_between || echo.kind == EchoKind::kSurface);
  }
  EXPECT_NEAR(num_between, 600, 50);
}

TEST(Footprint, BeyondItsReachOneOfTheSurfacesIsReturned) {
  for (std::uint64_t key = 0; key < 100; ++key) {
    const Echo echo = EchoOfFootprint(Wall(20.0f), EdgeOnTheLeft(Wall(10.0f)), {8.0f, 1.0}, key);
    EXPECT_TRUE(echo.range_m == 10.0 || echo.range_m == 20.0);
  }
}

TEST(Footprint, AThingBesideTheBeamIsSeenWeakly) {
  const Echo echo = EchoOfFootprint(Hit(), EdgeOnTheLeft(Wall(10.0f)), {8.0f, 1.0}, 3);
  EXPECT_EQ(echo.range_m, 10.0);
  EXPECT_GT(echo.strength, 0.0);
  EXPECT_LT(echo.strength, 0.5);
  EXPECT_EQ(EchoOfFootprint(Hit(), EdgeOnTheLeft(Hit()), {}, 3).surface.object, Hit::kNothing);
}

}  // namespace
}  // namespace lio::sim
