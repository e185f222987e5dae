// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// ImuConventionMonitor finds out of forces which unit they have, and whether gravity is in them.
#include <gtest/gtest.h>

#include "pipeline/watched_imu.hpp"

namespace lio {
namespace {

constexpr double kGravity_mps2 = 9.80665;

TEST(ImuConventionMonitor, TheForceAtRestTellsItsUnit) {
  const Watched drive(kSi);
  const auto metric = drive.monitor.JudgeForce(Vector3(0, 0, kGravity_mps2));
  EXPECT_EQ(metric.force, ForceAtRest::kMetric);
  EXPECT_FALSE(metric.convention.is_in_g);
  const auto in_g = drive.monitor.JudgeForce(Vector3(0, 0, 1.0));
  EXPECT_EQ(in_g.force, ForceAtRest::kInG);
  EXPECT_TRUE(in_g.convention.is_in_g);
  EXPECT_NE(in_g.evidence.find("reads 1.00"), std::string::npos) << in_g.evidence;
}

TEST(ImuConventionMonitor, TheForceAtRestIsJudgedAsItWasSent) {
  Watched drive(kSi);
  drive.imu.SetConvention(kG);
  const auto in_g = drive.monitor.JudgeForce(Vector3(0, 0, kGravity_mps2));
  EXPECT_EQ(in_g.force, ForceAtRest::kInG);
  EXPECT_TRUE(in_g.convention.is_in_g);
  const auto metric = drive.monitor.JudgeForce(Vector3(0, 0, kGravity_mps2 * kGravity_mps2));
  EXPECT_EQ(metric.force, ForceAtRest::kMetric);
  EXPECT_FALSE(metric.convention.is_in_g);
}

TEST(ImuConventionMonitor, AForceAtRestThatTellsNothingLeavesTheConvention) {
  Watched drive(kSi);
  drive.imu.SetConvention({false, true});
  const auto without = drive.monitor.JudgeForce(Vector3(0.05, 0, 0.1));
  EXPECT_EQ(without.force, ForceAtRest::kWithoutGravity);
  EXPECT_EQ(without.convention, kDeg);
  const auto unclear = drive.monitor.JudgeForce(Vector3(0, 0, 4.0));
  EXPECT_EQ(unclear.force, ForceAtRest::kUnclear);
  EXPECT_EQ(unclear.convention, kDeg);
}

TEST(ImuConventionMonitor, AMeanForceOfMoreThanHalfOfGravityHasItIn) {
  const Watched drive(kSi);
  EXPECT_EQ(drive.monitor.GravityInMotion(Vector3(0, 0, 5.0)), true);
  EXPECT_EQ(drive.monitor.GravityInMotion(Vector3(0, 0, 4.8)), std::nullopt);
}

TEST(ImuConventionMonitor, ADriveShowsThatGravityWasRemoved) {
  Watched drive(kSi);
  drive.g_world = Vector3::Zero();
  drive.AddSteps(kManySteps);
  (void)drive.Judge();
  EXPECT_EQ(drive.monitor.GravityInMotion(Vector3(0, 0, 0.5)), false);
  EXPECT_EQ(drive.monitor.GravityInMotion(Vector3(0, 0, 9.8)), true) << "the force itself tells";
}

}  // namespace
}  // namespace lio
