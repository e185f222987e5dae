// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/imu_convention.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace lio {
namespace {

TEST(ImuConvention, QuarterTurnsAreAllDifferentRotationsAndTheFirstIsNone) {
  const auto turns = QuarterTurns();
  EXPECT_EQ(turns[0], Matrix3::Identity());
  for (std::size_t i = 0; i < turns.size(); ++i) {
    EXPECT_EQ(turns[i] * turns[i].transpose(), Matrix3::Identity());
    EXPECT_EQ(turns[i].determinant(), 1.0);
    EXPECT_EQ(std::count(turns.begin(), turns.end(), turns[i]), 1) << turns[i];
  }
}

TEST(ImuConvention, UnitsAndAxesAreUnderstood) {
  ImuConvention convention;
  convention.is_in_g = true;
  convention.is_in_deg = true;
  convention.R_imu_sent = Vector3(1, -1, -1).asDiagonal();
  const ImuSample sent{{5}, Vector3(180.0, 90.0, 0.0), Vector3(0.5, 0.0, -1.0)};
  const ImuSample sample = ToSi(convention, sent);
  EXPECT_EQ(sample.stamp, sent.stamp);
  const double pi = std::numbers::pi;
  EXPECT_LT((sample.w_imu_radps - Vector3(pi, -0.5 * pi, 0.0)).norm(), 1e-12);
  EXPECT_LT((sample.f_imu_mps2 - Vector3(0.5 * 9.80665, 0.0, 9.80665)).norm(), 1e-12);
}

TEST(ImuConvention, AsSentUndoesUnderstand) {
  for (const Matrix3& R : QuarterTurns()) {
    const ImuConvention convention{true, true, R};
    const ImuSample sent{{7}, Vector3(10.0, -20.0, 30.0), Vector3(0.1, 0.2, 0.9)};
    const ImuSample back = FromSi(convention, ToSi(convention, sent));
    EXPECT_LT((back.w_imu_radps - sent.w_imu_radps).norm(), 1e-12);
    EXPECT_LT((back.f_imu_mps2 - sent.f_imu_mps2).norm(), 1e-12);
  }
}

TEST(ImuConvention, OptionsNameUnitsBothWays) {
  for (const ImuUnits units : {ImuUnits::kSi, ImuUnits::kG, ImuUnits::kDeg, ImuUnits::kGAndDeg}) {
    EXPECT_EQ(UnitsOf(ConventionOf(units)), units);
  }
  EXPECT_EQ(UnitsOf(ConventionOf(ImuUnits::kAutomatic)), ImuUnits::kSi);
}

TEST(ImuConvention, DescriptionNamesUnitsAndTurnedAxes) {
  EXPECT_EQ(Describe(ImuConvention{}), "accelerometer in m/s^2, gyro in rad/s");
  const ImuConvention z_down{true, true, Vector3(1, -1, -1).asDiagonal()};
  EXPECT_EQ(Describe(z_down),
            "accelerometer in g, gyro in deg/s, its x -y -z are the rig's x y z (z down)");
}

}  // namespace
}  // namespace lio
