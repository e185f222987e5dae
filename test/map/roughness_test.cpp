// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/roughness.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

TEST(Roughness, GroundLooksHigherTheFlatterItIsSeen) {
  const Roughness grass(0.02f, 0.2f);
  EXPECT_NEAR(grass.HeightAt(0.2f), 0.f, 1e-5f);
  EXPECT_NEAR(grass.HeightAt(0.2f / std::exp(1.f)), 0.02f, 1e-4f);
  EXPECT_NEAR(grass.HeightAt(0.2f * std::exp(1.f)), -0.02f, 1e-4f);
}

TEST(Roughness, SmoothGroundLooksTheSameFromEverywhere) {
  EXPECT_TRUE(Roughness().is_smooth());
  EXPECT_EQ(Roughness().HeightAt(0.1f), 0.f);
  EXPECT_EQ(Roughness(0.f, 0.3f).HeightAt(0.9f), 0.f);
}

TEST(Roughness, IsFiniteAtAnyAngle) {
  for (const float sine : {0.f, 1e-9f, 1.f, 2.f}) {
    EXPECT_LT(std::abs(Roughness(0.05f, 0.f).HeightAt(sine)), 0.25f);
    EXPECT_LT(std::abs(Roughness(0.05f, 1.f).HeightAt(sine)), 0.25f);
  }
}

TEST(Roughness, IsSmallEnoughForTheCacheLineOfAPatch) {
  EXPECT_EQ(sizeof(Roughness), 4u);
}

}  // namespace
}  // namespace lio
