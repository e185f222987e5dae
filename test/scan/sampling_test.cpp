// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "scan/sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace lio {
namespace {

LidarPoint Point(std::uint32_t t_offset_ns, std::uint16_t ring, float x = 0, float y = 0,
                 float z = 0) {
  LidarPoint point;
  point.t_offset_ns = t_offset_ns, point.ring = ring;
  point.x_m = x, point.y_m = y, point.z_m = z;
  return point;
}

TEST(Sampling, OrderIsByTimeThenRingThenPlace) {
  const std::vector<LidarPoint> ordered = {Point(1, 9, 9, 9, 9), Point(2, 0, 9, 9, 9),
                                           Point(2, 1, 0, 9, 9), Point(2, 1, 1, 0, 9),
                                           Point(2, 1, 1, 1, 0), Point(2, 1, 1, 1, 1)};
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    for (std::size_t j = 0; j < ordered.size(); ++j) {
      EXPECT_EQ(Precedes(ordered[i], ordered[j]), i < j) << i << " " << j;
    }
  }
}

TEST(Sampling, SmallSweepsAreUsedWhole) {
  EXPECT_EQ(SampleShare(0), 65536u);
  EXPECT_EQ(SampleShare(kMaxSampled), 65536u);
  EXPECT_LT(SampleShare(kMaxSampled + 1000), 65536u);
}

// About kMaxSampled points are used of sweeps as drivers send them.
template <class MakePoint>
void ExpectShareKept(std::size_t num_points, const MakePoint& make) {
  const std::uint32_t share = SampleShare(num_points);
  std::size_t num_used = 0;
  for (std::size_t i = 0; i < num_points; ++i) num_used += Sample(make(i)) < share;
  EXPECT_NEAR(static_cast<double>(num_used), static_cast<double>(kMaxSampled),
              0.03 * static_cast<double>(kMaxSampled));
}

TEST(Sampling, TheShareIsKeptWithTimesAndWithoutAnything) {
  constexpr std::size_t kNum = 130'000;
  ExpectShareKept(kNum, [](std::size_t i) {  // times and rings
    return Point(static_cast<std::uint32_t>(i / 64) * 48'000, static_cast<std::uint16_t>(i % 64));
  });
  for (std::uint16_t ring = 0; ring < 4; ++ring) {  // rings alone: of each as much
    ExpectShareKept(kNum,
                    [&](std::size_t i) { return Point(0, ring, 0.001f * static_cast<float>(i)); });
  }
  ExpectShareKept(kNum, [](std::size_t i) {  // neither
    return Point(0, 0, 0.001f * static_cast<float>(i));
  });
}

// The choice does not depend on the position when a cloud has times, so that a moved cloud is
// sampled alike.
TEST(Sampling, PlaceCountsOnlyWhereNoTimeIsTold) {
  EXPECT_EQ(Sample(Point(5000, 3, 1)), Sample(Point(5000, 3, 2)));
  EXPECT_NE(Sample(Point(0, 0, 1)), Sample(Point(0, 0, 2)));
  EXPECT_NE(Sample(Point(0, 3, 1)), Sample(Point(0, 3, 2)));
}

}  // namespace
}  // namespace lio
