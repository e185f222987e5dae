// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/lidar_guess.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace lio {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<BeamTable> Known() {
  return {LoadBeamTable("vlp16"), LoadBeamTable("hdl32e")};
}

LidarPoint RingPoint(double elevation_rad, int ring) {
  LidarPoint point;
  point.x_m = static_cast<float>(10.0 * std::cos(elevation_rad));
  point.z_m = static_cast<float>(10.0 * std::sin(elevation_rad));
  point.ring = static_cast<std::uint16_t>(ring);
  return point;
}

TEST(GuessLidar, ALidarIsKnownByItsBeams) {
  std::vector<double> elevations = LoadBeamTable("vlp16").elevation_rad;
  for (double& elevation : elevations) elevation += 0.002;
  const LidarGuess guess = GuessLidar(elevations, Known());
  EXPECT_EQ(guess.model, "vlp16");
  EXPECT_THAT(guess.reason, HasSubstr("16 rings, all within 0.11 deg"));
}

TEST(GuessLidar, OtherBeamsAreNoKnownModelEvenIfTheirNumberIs) {
  std::vector<double> elevations = LoadBeamTable("vlp16").elevation_rad;
  for (double& elevation : elevations) elevation *= 0.7;
  const LidarGuess guess = GuessLidar(elevations, Known());
  EXPECT_EQ(guess.model, "generic");
  EXPECT_EQ(guess.reason, "16 rings at elevations of no known model");
}

TEST(GuessLidar, WithoutRingsTheLidarIsGeneric) {
  EXPECT_EQ(GuessLidar({}, Known()).model, "generic");
}

TEST(RingElevations, TheMedianOfARingIsNotMovedByStrayPoints) {
  RingElevations elevations;
  for (int i = 0; i < 20; ++i) elevations.Add(RingPoint(-0.1, 0));
  elevations.Add(RingPoint(0.5, 0));
  elevations.Add(RingPoint(0.1, 1));
  const std::vector<double> medians = elevations.Medians();
  ASSERT_EQ(medians.size(), 2u);
  EXPECT_NEAR(medians[0], -0.1, 1e-6);
  EXPECT_NEAR(medians[1], 0.1, 1e-6);
}

TEST(RingElevations, OneRingAndMissingRingsGiveNothing) {
  RingElevations elevations;
  elevations.Add(RingPoint(0.0, 0));
  EXPECT_THAT(elevations.Medians(), IsEmpty());
  elevations.Add(RingPoint(0.1, 2));
  EXPECT_THAT(elevations.Medians(), IsEmpty());
}

}  // namespace
}  // namespace lio
