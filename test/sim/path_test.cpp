// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/path.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace lio::sim {
namespace {

Path Block() {
  return Path::Rounded({{0, 0}, {50, 0}, {50, -40}, {-50, -40}, {-50, 0}}, 8.0, true);
}

TEST(Path, ClosedPathEndsWhereItBegins) {
  const Path path = Block();
  const PathPoint begin = path.At(0.0);
  const PathPoint end = path.At(path.length_m());
  EXPECT_LT((begin.position_m - end.position_m).norm(), 1e-9);
  EXPECT_NEAR(end.heading_rad - begin.heading_rad, -2.0 * std::numbers::pi, 1e-12);
  // Four corners of radius 8 shorten the legs by 8 - 2 pi 8 / 4 twice each.
  EXPECT_NEAR(path.length_m(), 280.0 - 8.0 * 8.0 + 2.0 * std::numbers::pi * 8.0, 1e-9);
}

TEST(Path, DistanceIsArcLength) {
  const Path path = Block();
  for (double s = 0.0; s < path.length_m(); s += 0.73) {
    const double step = (path.At(s + 1e-4).position_m - path.At(s).position_m).norm();
    EXPECT_NEAR(step, 1e-4, 1e-9) << "at " << s;
  }
}

TEST(Path, ShiftedStaysAtItsDistance) {
  const Path path = Block();
  const Path lane = path.Shifted(-2.0);  // inside the bends, because the block turns right
  EXPECT_NEAR(path.length_m() - lane.length_m(), 2.0 * std::numbers::pi * 2.0, 1e-9);
  for (double s = 0.0; s < lane.length_m(); s += 3.1) {
    double nearest = 1e9;
    for (double u = 0.0; u < path.length_m(); u += 0.05) {
      nearest = std::min(nearest, (path.At(u).position_m - lane.At(s).position_m).norm());
    }
    EXPECT_NEAR(nearest, 2.0, 1e-3) << "at " << s;
  }
}

TEST(Path, ReversedRunsThroughTheSamePoints) {
  const Path path = Block();
  const Path back = path.Reversed();
  for (double s = 0.0; s <= path.length_m(); s += 7.7) {
    EXPECT_LT((path.At(s).position_m - back.At(path.length_m() - s).position_m).norm(), 1e-9);
    EXPECT_NEAR(std::cos(path.At(s).heading_rad - back.At(path.length_m() - s).heading_rad), -1.0,
                1e-12);
  }
}

TEST(Path, CutAndRepeatedKeepTheWay) {
  const Path path = Block();
  EXPECT_LT((path.Cut(30.0, 90.0).At(25.0).position_m - path.At(55.0).position_m).norm(), 1e-9);
  const Path twice = path.Repeated(2);
  EXPECT_NEAR(twice.length_m(), 2.0 * path.length_m(), 1e-9);
  EXPECT_LT((twice.At(path.length_m() + 33.0).position_m - path.At(33.0).position_m).norm(), 1e-9);
}

TEST(Path, GoesStraightOnBeyondItsEnds) {
  Path path({1.0, 2.0}, 0.0);
  path.AddStraight(10.0);
  EXPECT_LT((path.At(-3.0).position_m - Vector2(-2.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((path.At(14.0).position_m - Vector2(15.0, 2.0)).norm(), 1e-12);
}

TEST(Path, RefusesCornersThatOverlap) {
  EXPECT_THROW((void)Path::Rounded({{0, 0}, {5, 0}, {5, 5}, {0, 5}}, 8.0, false),
               std::invalid_argument);
}

}  // namespace
}  // namespace lio::sim
