// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/grazing_incidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lio {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

// A beam that comes down onto a floor at this angle, of any length.
Eigen::Vector3f DownAt(float degrees) {
  const float angle = degrees * static_cast<float>(M_PI) / 180.f;
  return 7.f * Eigen::Vector3f(std::cos(angle), 0.f, -std::sin(angle));
}

TEST(GrazingIncidence, IsBelowThreeAndAHalfDegrees) {
  EXPECT_TRUE(IsGrazing(kUp, DownAt(3.3f)));
  EXPECT_FALSE(IsGrazing(kUp, DownAt(3.6f)));
  EXPECT_TRUE(IsGrazing(-kUp, DownAt(3.3f))) << "whichever way the normal points";
  EXPECT_FALSE(IsGrazing(-kUp, DownAt(3.6f)));
}

TEST(GrazingIncidence, AViewOfNothingIsGrazing) {
  EXPECT_TRUE(IsGrazing(kUp, Eigen::Vector3f::Zero()));
  EXPECT_TRUE(IsGrazing(kUp, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN())));
}

TEST(GrazingIncidence, ASurfaceIsSeenFromBehindAgainstItsNormal) {
  EXPECT_FALSE(IsFromBehind(kUp, DownAt(45.f)));
  EXPECT_TRUE(IsFromBehind(kUp, -DownAt(45.f))) << "from below";
  EXPECT_FALSE(IsFromBehind(kUp, -DownAt(3.3f))) << "at grazing incidence nobody knows";
  EXPECT_TRUE(IsFromBehind(kUp, -DownAt(3.6f)));
}

}  // namespace
}  // namespace lio
