// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/cell_beams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace lio {
namespace {

const Eigen::Vector3f kUpwards = Eigen::Vector3f::UnitZ();

SeenBeam BeamAt(std::uint16_t ring, const Eigen::Vector3f& position) {
  return {ring, AxesOf(position), 0.01f * position};
}

int NumUsed(const CellBeams& cell) {
  return static_cast<int>(std::count_if(cell.rings.begin(), cell.rings.end(),
                                        [](const auto& each) { return each.num_points > 0; }));
}

// The mean elevation shift over all rings.
float MeanElevation(const CellBeams& cell) {
  float sum = 0.f;
  float num = 0.f;
  for (const CellBeams::OfRing& each : cell.rings) {
    sum += each.num_points * each.shift.elevation;
    num += each.num_points;
  }
  return sum / num;
}

TEST(CellBeams, HasTheMeansOfWhatWasSeen) {
  CellBeams cell;
  const SeenBeam near = BeamAt(3, {4.f, 3.f, -2.f});
  const SeenBeam far = BeamAt(7, {12.f, -5.f, -2.f});
  cell.Add(near, kUpwards, 10.f);
  cell.Add(far, kUpwards, 20.f);
  cell.Add(far, kUpwards, 30.f);
  EXPECT_EQ(cell.num_points, 3u);
  EXPECT_NEAR(cell.path_m, 20.f, 1e-5f);
  EXPECT_NEAR(cell.correction_m, -0.02f, 1e-6f);
  ASSERT_EQ(NumUsed(cell), 2);
  EXPECT_EQ(cell.rings[0].ring, 3);
  EXPECT_EQ(cell.rings[1].ring, 7);
  EXPECT_EQ(cell.rings[1].num_points, 2);
  // On level ground an angle of elevation lifts a point by its level distance.
  EXPECT_NEAR(cell.rings[0].shift.elevation, 5.f, 1e-5f);
  EXPECT_NEAR(cell.rings[1].shift.elevation, 13.f, 1e-5f);
}

TEST(CellBeams, RingsAreInOrderWhateverTheOrderTheyCameIn) {
  CellBeams cell;
  for (const int ring : {9, 2, 30, 5, 2, 9}) {
    cell.Add(BeamAt(static_cast<std::uint16_t>(ring), {10.f, 0.f, -1.f}), kUpwards, 0.f);
  }
  ASSERT_EQ(NumUsed(cell), 4);
  const std::vector<int> rings = {cell.rings[0].ring, cell.rings[1].ring, cell.rings[2].ring,
                                  cell.rings[3].ring};
  EXPECT_EQ(rings, std::vector<int>({2, 5, 9, 30}));
}

TEST(CellBeams, NeighboursMergeWhereMoreRingsComeAndTheMeanStays) {
  CellBeams cell;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> range_m(5.f, 40.f);
  float sum = 0.f;
  constexpr int kNumPoints = 120;
  for (int i = 0; i < kNumPoints; ++i) {
    const SeenBeam beam = BeamAt(static_cast<std::uint16_t>(i / 6), {range_m(random), 0.f, -1.7f});
    sum += beam.axes.elevation.z();
    cell.Add(beam, kUpwards, 0.f);
  }
  EXPECT_EQ(NumUsed(cell), static_cast<int>(CellBeams::kMaxRings));
  for (std::size_t i = 1; i < CellBeams::kMaxRings; ++i) {
    EXPECT_GT(cell.rings[i].ring, cell.rings[i - 1].ring);
  }
  EXPECT_NEAR(MeanElevation(cell), sum / kNumPoints, 1e-3f);
}

TEST(CellBeams, CountsThatAreFullKeepTheirProportion) {
  CellBeams cell;
  for (int i = 0; i < 1200; ++i) {
    cell.Add(BeamAt(static_cast<std::uint16_t>(i % 3 == 0 ? 4 : 8), {10.f, 0.f, -1.f}), kUpwards,
             0.f);
  }
  const auto few = static_cast<double>(cell.rings[0].num_points);
  const auto many = static_cast<double>(cell.rings[1].num_points);
  EXPECT_NEAR(few / (few + many), 1.0 / 3.0, 0.03);
}

TEST(CellBeams, ARingBeyondTheLastOneIsLeftOut) {
  CellBeams cell;
  cell.Add(BeamAt(kMaxCalibratedRings, {10.f, 0.f, -1.f}), kUpwards, 0.f);
  EXPECT_EQ(cell.num_points, 0u);
}

TEST(GrazingShift, IsNothingAtRightAnglesAndBounded) {
  EXPECT_EQ(GrazingShift(1.f), 0.f);
  EXPECT_EQ(GrazingShift(-1.f), 0.f);
  EXPECT_NEAR(GrazingShift(-0.5f), -0.5f, 1e-6f);
  EXPECT_EQ(GrazingShift(0.f), 0.f);
  EXPECT_NEAR(GrazingShift(1e-4f), 6.7e-4f, 1e-6f);
}

}  // namespace
}  // namespace lio
