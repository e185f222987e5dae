// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/pose_event.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

constexpr double kGate = 22.46;
constexpr double kStd_m = 0.1;
const CovarianceInflation kMost{9.0, 9.0};

// An estimate that is sure of its pose to ten centimetres and a tenth of a radian, but not of its
// velocity.
Estimate Sure() {
  Estimate estimate;
  estimate.cov.diagonal().setConstant(kStd_m * kStd_m);
  return estimate;
}

// A pose so far along x, as sure as the estimate: its NIS is half the square of the distance in
// standard deviations.
PoseEvent PoseAlongX(double x_m) {
  PoseEvent event;
  event.measurement.T_map_imu.translation.x() = x_m;
  event.measurement.cov = kStd_m * kStd_m * Matrix6::Identity();
  return event;
}

TEST(PoseEvent, APoseWithinTheGateIsFused) {
  Estimate estimate = Sure();
  CovarianceInflation inflation;
  const UpdateResult update = FusePoseEvent(PoseAlongX(0.2), kGate, kMost, inflation, estimate);
  EXPECT_TRUE(update.fused);
  EXPECT_NEAR(update.nis, 2.0, 1e-9);
  EXPECT_NEAR(estimate.state.T_map_imu.translation.x(), 0.1, 1e-9);
}

TEST(PoseEvent, APoseBeyondTheGateChangesTheInflationAlone) {
  Estimate estimate = Sure();
  const Estimate before = estimate;
  CovarianceInflation inflation;
  const UpdateResult update = FusePoseEvent(PoseAlongX(1.0), kGate, kMost, inflation, estimate);
  EXPECT_FALSE(update.fused);
  EXPECT_EQ(estimate.cov, before.cov);
  EXPECT_EQ(estimate.state.T_map_imu.translation, Vector3::Zero());
  EXPECT_GT(inflation.translation, 1.0);
  EXPECT_EQ(inflation.rotation, 1.0);
}

TEST(PoseEvent, InflationWeighsAPoseLess) {
  Estimate estimate = Sure();
  CovarianceInflation inflation{3.0, 1.0};
  const UpdateResult update = FusePoseEvent(PoseAlongX(0.2), kGate, kMost, inflation, estimate);
  EXPECT_NEAR(update.nis, 1.0, 1e-9);  // 0.04 / (0.01 + 0.03)
  EXPECT_NEAR(estimate.state.T_map_imu.translation.x(), 0.05, 1e-9);
}

TEST(PoseEvent, InflationStaysWithinItsBounds) {
  Estimate estimate = Sure();
  CovarianceInflation inflation;
  for (int i = 0; i < 100; ++i) {
    (void)FusePoseEvent(PoseAlongX(1.0), 0.0, {2.0, 2.0}, inflation, estimate);
  }
  EXPECT_EQ(inflation.translation, 2.0);
  for (int i = 0; i < 100; ++i) {
    (void)FusePoseEvent(PoseAlongX(0.0), 0.0, {2.0, 2.0}, inflation, estimate);
  }
  EXPECT_EQ(inflation.translation, 1.0);
}

TEST(PoseEvent, AForcedPoseFarOffIsAMotionThatNobodySaw) {
  Estimate estimate = Sure();
  CovarianceInflation inflation;
  PoseEvent event = PoseAlongX(20.0);
  event.force = true;
  EXPECT_TRUE(FusePoseEvent(event, kGate, kMost, inflation, estimate).fused);
  EXPECT_NEAR(estimate.state.T_map_imu.translation.x(), 20.0, 0.1);
  EXPECT_NEAR(estimate.state.T_world_imu.translation.x(), 20.0, 0.1);
  EXPECT_GT(estimate.cov(kVel, kVel), 100.0);
}

TEST(PoseEvent, AForcedPoseIsWrongWhereSoMuchMotionCannotHaveBeenUnseen) {
  Estimate estimate = Sure();
  const Estimate before = estimate;
  CovarianceInflation inflation;
  PoseEvent event = PoseAlongX(20.0);
  event.force = true;
  event.max_unseen = {19.0, 0.1};
  EXPECT_FALSE(FusePoseEvent(event, kGate, kMost, inflation, estimate).fused);
  EXPECT_EQ(estimate.cov, before.cov);
  EXPECT_EQ(estimate.state.T_map_imu.translation, Vector3::Zero());
  event.max_unseen.translation_m = 19.9;  // and some centimetres of registration's error
  EXPECT_TRUE(FusePoseEvent(event, kGate, kMost, inflation, estimate).fused);
}

TEST(PoseEvent, AForcedTurnIsWrongWhereSoMuchTurnCannotHaveBeenUnseen) {
  Estimate estimate = Sure();
  CovarianceInflation inflation;
  PoseEvent event = PoseAlongX(0.0);
  event.measurement.T_map_imu.rotation = ExpSo3(Vector3(0.0, 0.0, 1.5));
  event.force = true;
  event.max_unseen = {1.0, 1.4};
  EXPECT_FALSE(FusePoseEvent(event, kGate, kMost, inflation, estimate).fused);
  event.max_unseen.rotation_rad = 1.5;
  EXPECT_TRUE(FusePoseEvent(event, kGate, kMost, inflation, estimate).fused);
}

TEST(PoseEvent, APoseThatReplacesTheMotionIsWhereTheBodyIs) {
  Estimate estimate = Sure();
  CovarianceInflation inflation;
  PoseEvent event = PoseAlongX(500.0);
  event.motion = PredictedMotion::kReplaced;
  const UpdateResult update = FusePoseEvent(event, kGate, kMost, inflation, estimate);
  EXPECT_TRUE(update.fused);
  EXPECT_NEAR(update.nis, 0.0, 1e-9);
  EXPECT_NEAR(estimate.state.T_map_imu.translation.x(), 500.0, 1e-9);
}

TEST(PoseEvent, AClockThatWasSetTakesTheMotionBackAndLeavesTheVelocity) {
  Estimate estimate = Sure();
  CovarianceInflation inflation;
  PoseEvent event = PoseAlongX(3.0);
  event.motion = PredictedMotion::kTakenBack;
  EXPECT_TRUE(FusePoseEvent(event, kGate, kMost, inflation, estimate).fused);
  EXPECT_NEAR(estimate.state.T_map_imu.translation.x(), 3.0, 0.02);
  EXPECT_NEAR(estimate.cov(kVel, kVel), kStd_m * kStd_m, 1e-9);
}

}  // namespace
}  // namespace lio
