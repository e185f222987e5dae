// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/drive.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace lio::sim {
namespace {

struct BentStreet {
  Path path = Path::Rounded({{0, 0}, {120, 0}, {120, 80}, {240, 80}}, 12.0, false);
  DriveLimits limits;
};

TEST(Drive, KeepsToItsLimits) {
  const BentStreet c;
  const Drive drive(c.path, c.limits, {{60.0, 3.0}}, 2.5);
  const double h = 0.2;
  for (double t = h; t + h < drive.duration_s(); t += 0.05) {
    const double here = drive.DistanceAt(t);
    const double speed = (drive.DistanceAt(t + h) - drive.DistanceAt(t - h)) / (2.0 * h);
    const double accel = (drive.DistanceAt(t + h) - 2.0 * here + drive.DistanceAt(t - h)) / (h * h);
    EXPECT_LE(speed, c.limits.speed_mps + 1e-6);
    EXPECT_LE(accel, c.limits.accel_mps2 + 0.02);
    EXPECT_GE(accel, -c.limits.brake_mps2 - 0.02);
    // The profile's grid of 0.25 m blurs the begin of a bend by the speed gained within a cell.
    const double lateral = speed * speed * std::abs(c.path.At(here).curvature_per_m);
    EXPECT_LE(lateral, 1.15 * c.limits.lateral_mps2) << "at " << here;
  }
}

TEST(Drive, RestsAtTheStartAtStopsAndAtTheEnd) {
  const BentStreet c;
  const Drive drive(c.path, c.limits, {{60.0, 3.0}}, 2.5);
  EXPECT_EQ(drive.DistanceAt(2.4), 0.0);
  int num_at_stop = 0;
  for (double t = 0.0; t < drive.duration_s(); t += 0.02) {
    const double here = drive.DistanceAt(t);
    const bool stands = drive.DistanceAt(t + 0.02) - here < 1e-9;
    num_at_stop += stands && std::abs(here - 60.0) < 0.13 ? 1 : 0;  // half a cell of the profile
  }
  EXPECT_NEAR(0.02 * num_at_stop, 3.0, 0.1);
  EXPECT_EQ(drive.DistanceAt(drive.duration_s() + 100.0), c.path.length_m());
}

TEST(Drive, RefusesLimitsThatAreNotPositive) {
  BentStreet c;
  c.limits.brake_mps2 = 0.0;
  EXPECT_THROW(Drive(c.path, c.limits, {}, 1.0), std::invalid_argument);
}

TEST(FollowDrive, LeansOutwardAndDivesOnBraking) {
  const BentStreet c;
  const Drive drive(c.path, c.limits, {}, 2.5);
  const HeightFunction flat = [](const Vector2&, double) { return 0.0; };
  const double h = 0.2;
  const auto knots = FollowDrive(c.path, drive, flat, {}, h, drive.duration_s());
  double most_left_turn = 0.0;
  double most_braking = 0.0;
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    const PathPoint p = c.path.At(drive.DistanceAt(h * static_cast<double>(i)));
    if (p.curvature_per_m > 0.0) most_left_turn = std::max(most_left_turn, knots[i].roll_rad);
    most_braking = std::max(most_braking, knots[i].pitch_rad);
  }
  EXPECT_NEAR(most_left_turn, 0.004 * 2.0, 0.002);  // left side up
  EXPECT_NEAR(most_braking, 0.004 * 2.0, 0.002);    // nose down
}

TEST(FollowDrive, StandsOnTheSlopeOfTheGround) {
  const BentStreet c;
  const Drive drive(c.path, c.limits, {}, 2.5);
  const HeightFunction slope = [](const Vector2& p, double) { return 0.1 * p.x() + 0.05 * p.y(); };
  const auto knots = FollowDrive(c.path, drive, slope, {}, 0.2, 5.0);
  EXPECT_NEAR(knots[0].pitch_rad, -std::atan(0.1), 1e-9);
  EXPECT_NEAR(knots[0].roll_rad, std::atan(0.05), 1e-9);
}

}  // namespace
}  // namespace lio::sim
