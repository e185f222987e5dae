// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/mixed_pixels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace lio {
namespace {

constexpr double kStep_rad = 0.2 * std::numbers::pi / 180.0;
constexpr std::uint32_t kStep_ns = 50'000;

// A sweep of two rings over 20 degrees, with ranges by azimuth; the second ring sees the same.
Sweep TwoRingSweep(const std::function<double(double)>& range_m) {
  Sweep sweep;
  for (int column = -50; column <= 50; ++column) {
    const double azimuth = kStep_rad * column;
    for (std::uint16_t ring = 0; ring < 2; ++ring) {
      LidarPoint point;
      const double range = range_m(azimuth);
      const double height = 0.02 * ring;
      point.x_m = static_cast<float>(range * std::cos(azimuth));
      point.y_m = static_cast<float>(range * std::sin(azimuth));
      point.z_m = static_cast<float>(range * height);
      point.t_offset_ns = static_cast<std::uint32_t>(column + 50) * kStep_ns + 1000u * ring;
      point.ring = ring;
      sweep.points.push_back(point);
    }
  }
  return sweep;
}

int NumMixed(const Sweep& sweep) {
  MixedPixelFinder finder;
  finder.Load(sweep);
  int num = 0;
  for (std::uint32_t i = 0; i < sweep.points.size(); ++i) num += finder.IsMixed(i) ? 1 : 0;
  return num;
}

// Returns a near surface before a far one, with one return between them at the edge.
double AcrossEdge(double azimuth) {
  if (std::abs(azimuth) < 0.5 * kStep_rad) return 12.7;
  return azimuth < 0.0 ? 10.0 : 16.0;
}

TEST(MixedPixels, AReturnBetweenTwoSurfacesIsOne) {
  const Sweep sweep = TwoRingSweep(AcrossEdge);
  MixedPixelFinder finder;
  finder.Load(sweep);
  for (std::uint32_t i = 0; i < sweep.points.size(); ++i) {
    const bool is_between = sweep.points[i].x_m > 12.0f && sweep.points[i].x_m < 13.0f;
    EXPECT_EQ(finder.IsMixed(i), is_between) << i;
  }
}

TEST(MixedPixels, ACleanEdgeHasNone) {
  EXPECT_EQ(NumMixed(TwoRingSweep([](double azimuth) { return azimuth < 0.0 ? 10.0 : 16.0; })), 0);
}

TEST(MixedPixels, AWallAtGrazingIncidenceHasNone) {
  // The wall y = 1 m: ranges grow by metres from beam to beam far along it.
  const auto wall = [](double azimuth) {
    return azimuth > 0.02 ? 1.0 / std::sin(azimuth) : 100.0 + 0.0 * azimuth;
  };
  EXPECT_EQ(NumMixed(TwoRingSweep(wall)), 0);
}

TEST(MixedPixels, APoleInFrontOfAWallStays) {
  const auto pole = [](double azimuth) { return std::abs(azimuth) < 0.5 * kStep_rad ? 8.0 : 20.0; };
  EXPECT_EQ(NumMixed(TwoRingSweep(pole)), 0);
}

TEST(MixedPixels, NoiseMakesNone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  EXPECT_EQ(NumMixed(TwoRingSweep([&](double) { return 15.0 + noise(random); })), 0);
}

TEST(MixedPixels, NeighboursFarOffAreNone) {
  Sweep sweep = TwoRingSweep(AcrossEdge);
  std::erase_if(sweep.points, [](const LidarPoint& point) {
    const double azimuth = std::abs(std::atan2(point.y_m, point.x_m));
    return azimuth > 0.5 * kStep_rad && azimuth < 6.0 * kStep_rad;
  });
  EXPECT_EQ(NumMixed(sweep), 0) << "what lies beside the return is not known";
}

TEST(MixedPixels, TheOrderOfThePointsDoesNotMatter) {
  Sweep sweep = TwoRingSweep(AcrossEdge);
  std::mt19937_64 random(5);
  std::shuffle(sweep.points.begin(), sweep.points.end(), random);
  MixedPixelFinder finder;
  finder.Load(sweep);
  for (std::uint32_t i = 0; i < sweep.points.size(); ++i) {
    EXPECT_EQ(finder.IsMixed(i), sweep.points[i].x_m > 12.0f && sweep.points[i].x_m < 13.0f) << i;
  }
}

// Packets are stamped by a host that is now and then busy: the next one seems to overlap this one.
TEST(MixedPixels, JitterOfTheStampsDoesNotChangeTheOrder) {
  Sweep sweep = TwoRingSweep(AcrossEdge);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    if (i % 20 < 10) sweep.points[i].t_offset_ns += 120'000;  // every other packet is late
  }
  EXPECT_EQ(NumMixed(sweep), 2);
}

// A wall 5 m off, seen at up to 70 deg from its normal, with one return 7 cm behind it.
TEST(MixedPixels, APointIsSoFarFromThePlaneOfItsNeighbours) {
  const Sweep sweep = TwoRingSweep([](double azimuth) {
    const double range_m = 5.0 / std::cos(azimuth + 1.0);
    return std::abs(azimuth) < 0.5 * kStep_rad ? range_m + 0.07 : range_m;
  });
  MixedPixelFinder finder;
  finder.Load(sweep);
  EXPECT_NEAR(finder.OffsetFromPlane(100).value(), 0.07, 0.005);
  EXPECT_NEAR(finder.OffsetFromPlane(60).value(), 0.0, 0.005);
  EXPECT_FALSE(finder.OffsetFromPlane(0)) << "the first of its ring";
}

TEST(MixedPixels, WithoutRingsNothingIsKnown) {
  Sweep sweep = TwoRingSweep(AcrossEdge);
  for (LidarPoint& point : sweep.points) point.ring = 0;
  EXPECT_EQ(NumMixed(sweep), 0);
}

TEST(MixedPixels, PointsThatAreNoNumbersDoNoHarm) {
  Sweep sweep = TwoRingSweep(AcrossEdge);
  for (std::size_t i = 0; i < sweep.points.size(); i += 5) {
    sweep.points[i].x_m = std::numeric_limits<float>::quiet_NaN();
  }
  EXPECT_LE(NumMixed(sweep), 2);
  EXPECT_EQ(NumMixed(Sweep{}), 0);
}

}  // namespace
}  // namespace lio
