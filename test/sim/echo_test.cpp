// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/echo.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio::sim {
namespace {

TEST(Echo, MattSurfacesFallOffWithSlant) {
  const MaterialTraits matt{"matt", 0.4, 0.0, {}};
  EXPECT_DOUBLE_EQ(Backscatter(matt, 1.0), 0.4);
  EXPECT_DOUBLE_EQ(Backscatter(matt, 0.25), 0.2);
}

TEST(Echo, PolishedSurfacesShineWhenTheyFaceTheBeam) {
  const MaterialTraits polished{"polished", 0.1, 0.5, {}};
  EXPECT_NEAR(Backscatter(polished, 1.0), 1.1, 1e-9);
  EXPECT_NEAR(Backscatter(polished, 0.9), 0.1 * std::sqrt(0.9), 1e-9);
}

TEST(Echo, IntensityIsVelodynesScale) {
  EXPECT_EQ(IntensityOf(0.4), 40);
  EXPECT_EQ(IntensityOf(3.0), 220);
  EXPECT_EQ(IntensityOf(60.0), 255);
}

TEST(Echo, StrongEchoesLookNearer) {
  const RangeWalk walk{0.004, 0.05};
  EXPECT_NEAR(RangeWalkOf(walk, 0.3), 0.0, 1e-12);
  EXPECT_NEAR(RangeWalkOf(walk, 0.6), -0.004, 1e-12);
  EXPECT_NEAR(RangeWalkOf(walk, 0.05) - RangeWalkOf(walk, 0.8), 0.016, 1e-9);
  EXPECT_NEAR(RangeWalkOf(walk, 3.0), -0.05, 1e-12);
  EXPECT_EQ(RangeWalkOf(RangeWalk(), 0.05), 0.0);
}

}  // namespace
}  // namespace lio::sim
