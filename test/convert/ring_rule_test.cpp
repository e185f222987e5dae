// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/ring_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lio {
namespace {

constexpr int kNumRings = 8;

// Returns rings two degrees apart with 30 points each; `number` gives the source's number of each
// ring, 0 being the lowest.
CloudPoints Points(auto&& number) {
  CloudPoints points;
  for (int k = 0; k < 30; ++k) {
    for (int ring = 0; ring < kNumRings; ++ring) {
      const double elevation = (ring * 2.0 - 7.0) * std::numbers::pi / 180.0;
      points.x_m.push_back(static_cast<float>(10.0 * std::cos(elevation)));
      points.y_m.push_back(0.1f * static_cast<float>(k));
      points.z_m.push_back(static_cast<float>(10.0 * std::sin(elevation)));
      points.ring.push_back(number(ring));
    }
  }
  return points;
}

std::vector<std::uint16_t> ExpectedRings() {
  std::vector<std::uint16_t> rings;
  for (int i = 0; i < 30 * kNumRings; ++i) {
    rings.push_back(static_cast<std::uint16_t>(i % kNumRings));
  }
  return rings;
}

RingRule Decide(const CloudPoints& points, std::uint32_t height = 1, std::uint32_t width = 240,
                const std::optional<BeamTable>& table = {}) {
  RingObserver observer;
  observer.Add(points, height, width);
  return observer.Decide(table);
}

TEST(RingRule, CountsFromTheLowestBeam) {
  const int shuffled[] = {3, 0, 7, 1, 5, 2, 6, 4};
  for (const auto& points : {Points([](int ring) { return ring; }),
                             Points([](int ring) { return kNumRings - 1 - ring; }),
                             Points([&](int ring) { return shuffled[ring]; })}) {
    const RingRule rule = Decide(points);
    EXPECT_EQ(rule.source, RingRule::Source::kField);
    EXPECT_EQ(AssignRings(rule, points), ExpectedRings()) << rule.description;
  }
}

TEST(RingRule, ComesFromRowsOrColumnsOfOrganisedClouds) {
  CloudPoints points = Points([](int ring) { return ring; });
  points.ring.clear();
  for (std::uint32_t i = 0; i < 240; ++i) {
    points.row.push_back(kNumRings - 1 - i % kNumRings);  // row 0 is the highest beam
    points.column.push_back(i / kNumRings);
  }
  const RingRule by_row = Decide(points, kNumRings, 30);
  EXPECT_EQ(by_row.source, RingRule::Source::kRow);
  EXPECT_EQ(AssignRings(by_row, points), ExpectedRings());
  std::swap(points.row, points.column);
  const RingRule by_column = Decide(points, 30, kNumRings);
  EXPECT_EQ(by_column.source, RingRule::Source::kColumn);
  EXPECT_EQ(AssignRings(by_column, points), ExpectedRings());
}

TEST(RingRule, ComesFromElevationByTheModel) {
  BeamTable table;
  table.model = "test8";
  for (int ring = 0; ring < kNumRings; ++ring) {
    table.elevation_rad.push_back((ring * 2.0 - 7.0) * std::numbers::pi / 180.0);
  }
  CloudPoints points = Points([](int ring) { return ring; });
  points.ring.clear();
  const RingRule rule = Decide(points, 1, 240, table);
  EXPECT_EQ(rule.source, RingRule::Source::kModel);
  EXPECT_EQ(AssignRings(rule, points), ExpectedRings());
}

TEST(RingRule, IsNoneWhenNothingTells) {
  CloudPoints points = Points([](int ring) { return ring; });
  points.ring.clear();
  const RingRule rule = Decide(points);
  EXPECT_EQ(rule.source, RingRule::Source::kNone);
  EXPECT_TRUE(AssignRings(rule, points).empty());
}

TEST(RingRule, IgnoresFieldsThatAreNoRings) {
  const CloudPoints points = Points([](int ring) { return ring * 100'000 - 5; });
  EXPECT_EQ(Decide(points).source, RingRule::Source::kNone);
}

TEST(RingRule, SurvivesLaterRingsItNeverSaw) {
  CloudPoints points = Points([](int ring) { return ring; });
  const RingRule rule = Decide(points);
  points.ring[0] = 12;
  points.ring[1] = -4;
  points.ring[2] = 2'000'000'000;
  const auto rings = AssignRings(rule, points);
  EXPECT_EQ(rings[0], 12);
  EXPECT_EQ(rings[1], 0);
  EXPECT_EQ(rings[2], 1023);
}

}  // namespace
}  // namespace lio
