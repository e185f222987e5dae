// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "scan/loam_ring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace lio {
namespace {

using Label = LoamRing::Label;
constexpr double kDegree = std::numbers::pi / 180.0;

// Returns a level ring from `from_deg` on, with 0.4 degrees per step; `range` is a function of the
// azimuth in radians.
class RingOf {
 public:
  RingOf(double from_deg, double to_deg, const std::function<double(double azimuth_rad)>& range) {
    for (double deg = from_deg; deg < to_deg; deg += 0.4) Add(deg * kDegree, range(deg * kDegree));
  }
  void Add(double azimuth_rad, double range_m) {
    LidarPoint point;
    point.x_m = static_cast<float>(range_m * std::cos(azimuth_rad));
    point.y_m = static_cast<float>(range_m * std::sin(azimuth_rad));
    points_.push_back(point);
  }
  void Process(LoamRing& ring) const {
    std::vector<std::uint32_t> indices(points_.size());
    std::iota(indices.begin(), indices.end(), 0u);
    ring.Process(points_, indices);
  }
  std::vector<Label> Labels(const LoamFeatureOptions& options = {}) const {
    LoamRing ring(options);
    Process(ring);
    return LabelsOf(ring);
  }
  static std::vector<Label> LabelsOf(const LoamRing& ring) {
    std::vector<Label> labels;
    for (std::size_t i = 0; i < ring.size(); ++i) labels.push_back(ring.label(i));
    return labels;
  }
  std::size_t size() const { return points_.size(); }

 private:
  std::vector<LidarPoint> points_;
};

std::ptrdiff_t Count(const std::vector<Label>& labels, Label label) {
  return std::count(labels.begin(), labels.end(), label);
}

// Walls face the sensor at 5 m, and two walls form one square corner.
double Wall(double azimuth_rad) {
  return 5.0 / std::cos(azimuth_rad);
}
double Corner(double azimuth_rad) {
  return 5.0 / std::max(std::cos(azimuth_rad), std::sin(azimuth_rad));
}

TEST(LoamRing, AWallHasFlatPointsInEverySectorAndNoEdges) {
  const std::vector<Label> labels = RingOf(-40, 40, Wall).Labels();
  EXPECT_EQ(Count(labels, Label::kFlat), 6 * 4);
  EXPECT_EQ(Count(labels, Label::kFlat) + Count(labels, Label::kPlain),
            static_cast<std::ptrdiff_t>(labels.size()));
}

TEST(LoamRing, OptionsSayHowManyArePicked) {
  LoamFeatureOptions options;
  options.num_sectors = 3;
  options.num_flat = 2;
  EXPECT_EQ(Count(RingOf(-40, 40, Wall).Labels(options), Label::kFlat), 3 * 2);
}

TEST(LoamRing, TheSharpestPointOfACornerIsTheCorner) {
  const RingOf ring(5, 85, Corner);
  const std::vector<Label> labels = ring.Labels();
  const auto corner = static_cast<std::size_t>(40.0 / 0.4);  // at 45 degrees
  std::vector<std::size_t> sharp;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == Label::kSharp || labels[i] == Label::kLessSharp) sharp.push_back(i);
  }
  ASSERT_FALSE(sharp.empty());
  for (const std::size_t i : sharp) {
    EXPECT_NEAR(static_cast<double>(i), static_cast<double>(corner), 6.0);
  }
  EXPECT_TRUE(std::any_of(sharp.begin(), sharp.end(), [&](std::size_t i) {
    return labels[i] == Label::kSharp && std::max(i, corner) - std::min(i, corner) <= 1;
  }));
}

TEST(LoamRing, PicksOfOneSurfaceAreFivePointsApart) {
  const std::vector<Label> labels = RingOf(-40, 40, Wall).Labels();
  std::size_t last = 0;
  bool is_first = true;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != Label::kFlat) continue;
    EXPECT_TRUE(is_first || i - last > LoamRing::kHalfWindow) << last << " " << i;
    last = i;
    is_first = false;
  }
}

// A board of ten degrees is 3 m in front of a wall: six points of the wall on either side may lie
// in its shadow.
TEST(LoamRing, TheFarSideOfAJumpIsOccluded) {
  const auto range = [](double azimuth_rad) {
    return std::abs(azimuth_rad) < 5 * kDegree ? 5.0 : 8.0;
  };
  const RingOf ring(-30, 30, range);
  const std::vector<Label> labels = ring.Labels();
  EXPECT_EQ(Count(labels, Label::kOccluded), 12);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double deg = -30.0 + 0.4 * static_cast<double>(i);
    if (labels[i] != Label::kOccluded) continue;
    EXPECT_GE(std::abs(deg), 5.0 - 1e-6) << "the board itself is seen";
    EXPECT_LE(std::abs(deg), 5.0 + 6 * 0.4 + 1e-6);
  }
}

TEST(LoamRing, SmallJumpsAreNoShadow) {
  const auto range = [](double azimuth_rad) { return azimuth_rad < 0 ? 5.0 : 5.25; };
  EXPECT_EQ(Count(RingOf(-30, 30, range).Labels(), Label::kOccluded), 0);
  LoamFeatureOptions options;
  options.min_occlusion_m = 0.2;
  EXPECT_EQ(Count(RingOf(-30, 30, range).Labels(options), Label::kOccluded), 6);
}

// An occlusion cannot be told when returns are missing between the two surfaces.
TEST(LoamRing, BeamsFarApartDoNotShadowEachOther) {
  const auto range = [](double azimuth_rad) { return azimuth_rad < 0 ? 5.0 : 8.0; };
  for (const double gap_deg : {5.0, 7.0}) {
    RingOf ring(-30, 0, range);
    for (double deg = gap_deg; deg < 30; deg += 0.4) ring.Add(deg * kDegree, 8.0);
    EXPECT_EQ(Count(ring.Labels(), Label::kOccluded), gap_deg < 6.0 ? 6 : 0) << gap_deg;
  }
}

// Along a wall 1 m to the left, beams are at grazing incidence for tan(azimuth) < tan(10 deg).
TEST(LoamRing, GrazedSurfacesAreToldByTheAngleOfTheBeam) {
  const RingOf ring(4, 60, [](double azimuth_rad) { return 1.0 / std::sin(azimuth_rad); });
  const std::vector<Label> labels = ring.Labels();
  for (std::size_t i = 2; i + 2 < labels.size(); ++i) {
    const double deg = 4.0 + 0.4 * static_cast<double>(i);
    if (std::abs(deg - 10.0) < 0.5) continue;
    EXPECT_EQ(labels[i] == Label::kGrazed, deg < 10.0) << deg;
  }
}

TEST(LoamRing, FivePointsAtEachEndHaveNoFeatures) {
  LoamRing ring{LoamFeatureOptions{}};
  RingOf(-40, 40, Wall).Process(ring);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const bool is_inside = i >= 5 && i < ring.size() - 5;
    EXPECT_EQ(ring.IsInside(i), is_inside);
    if (!is_inside) {
      EXPECT_EQ(ring.label(i), Label::kPlain);
    }
  }
}

TEST(LoamRing, RingsOfTenPointsAreTooShort) {
  EXPECT_EQ(Count(RingOf(0, 3.9, Wall).Labels(), Label::kPlain), 10);
  EXPECT_TRUE(RingOf(0, 0, Wall).Labels().empty());
}

TEST(LoamRing, WhatWasBeforeDoesNotMatter) {
  LoamRing ring{LoamFeatureOptions{}};
  RingOf(5, 85, Corner).Process(ring);
  const RingOf wall(-40, 40, Wall);
  wall.Process(ring);
  EXPECT_EQ(RingOf::LabelsOf(ring), wall.Labels());
}

}  // namespace
}  // namespace lio
